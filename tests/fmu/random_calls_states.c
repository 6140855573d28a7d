/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random calls that keep states, restore them, and give damaged ones.
 */
#include "random_calls.h"

#include "gm_saved.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

fmi2Status random_keep(random_run *r, bool *legal)
{
    bool nowhere = random_chance(r, 30);
    *legal = !nowhere;
    fmi2Status status =
        fmi2GetFMUstate(random_handle(r, legal), nowhere ? NULL : &r->saved);
    if (*legal)
        r->kept = r->oracle;
    return status;
}

/* A block that no FMU has made, or one that was and is damaged. */
static void damage(random_run *r, gm_saved *block)
{
    memset(block, (int)random_draw(r, 256), sizeof *block);
    if (r->saved && random_chance(r, 2)) {
        *block = *(gm_saved *)r->saved;
        ((unsigned char *)block)[random_draw(r, sizeof *block)] ^=
            (unsigned char)(1 + random_draw(r, 255));
    }
}

fmi2Status random_restore(random_run *r, bool *legal)
{
    gm_saved block;
    damage(r, &block);
    bool damaged = random_chance(r, 4);
    *legal = r->saved && !damaged;
    fmi2Status status =
        fmi2SetFMUstate(random_handle(r, legal), damaged ? &block : r->saved);
    if (*legal)
        r->oracle = r->kept;
    return status;
}

fmi2Status random_forget(random_run *r, bool *legal)
{
    *legal = true;
    fmi2Status status = fmi2FreeFMUstate(random_handle(r, legal), &r->saved);
    assert_true(!*legal || !r->saved);
    return status;
}

/* Through bytes and back into the same block. */
fmi2Status random_bytes(random_run *r, bool *legal)
{
    fmi2Byte bytes[sizeof(gm_saved) + 8];
    size_t size = 0, place = random_draw(r, 8);
    *legal = r->saved != NULL;
    if (!r->saved)
        return fmi2SerializedFMUstateSize(random_handle(r, legal), r->saved, &size);
    assert_int_equal(fmi2SerializedFMUstateSize(r->c, r->saved, &size), fmi2OK);
    size_t told = random_chance(r, 20) ? random_draw(r, 5000) : size;
    bool broken = random_chance(r, 5);
    fmi2Status status = fmi2SerializeFMUstate(r->c, r->saved, bytes + place, size);
    assert_int_equal(status, fmi2OK);
    bytes[place + random_draw(r, (unsigned)size)] ^=
        (fmi2Byte)(broken ? 1 + random_draw(r, 127) : 0);
    *legal = told == size && !broken;
    return fmi2DeSerializeFMUstate(random_handle(r, legal), bytes + place, told,
                                   &r->saved);
}
