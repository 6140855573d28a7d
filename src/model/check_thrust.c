/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Bearings that hold their shaft in one direction only come in pairs (thrust.c).
 */
#include "model/check.h"

#include <math.h>
#include <stddef.h>

/* Locating bearings of a shaft by what they hold: [0] minus_x, [1] both, [2] plus_x. */
typedef struct holders {
    int n[3];
    const gm_bearing *last[3];
} holders;

static holders holders_of(const gm_description *d, int shaft)
{
    holders h = {{0, 0, 0}, {NULL, NULL, NULL}};
    for (int i = 0; i < d->n_bearings; i++) {
        const gm_bearing *b = &d->bearings[i];
        if (b->shaft != shaft || !b->locating)
            continue;
        h.n[1 + b->thrust]++;
        h.last[1 + b->thrust] = b;
    }
    return h;
}

static gm_status check_induced(const gm_description *d, const gm_bearing *b,
                               gm_error *error)
{
    if (b->data.type == GM_BEARING_TAPERED_ROLLER && isnan(b->data.Y) &&
        isnan(b->induced))
        return gm_part_fail(d, "bearing", &b->id, error,
                            "thrust of a tapered roller bearing needs axial_factor or "
                            "induced_axial_factor");
    return GM_OK;
}

static gm_status check_pair(const gm_description *d, int shaft, gm_error *error)
{
    holders h = holders_of(d, shaft);
    const gm_label *id = &d->shafts[shaft].id;
    if (h.n[0] + h.n[2] == 0)
        return GM_OK;
    if (h.n[0] != 1 || h.n[2] != 1 || h.n[1] != 0)
        return gm_part_fail(d, "shaft", id, error,
                            "bearings with thrust come as one plus_x and one minus_x "
                            "without other locating ones; found %d, %d and %d others",
                            h.n[2], h.n[0], h.n[1]);
    if (h.last[0]->on != h.last[2]->on)
        return gm_part_fail(d, "shaft", id, error,
                            "bearings '%s' and '%s' hold it as a pair: the same part "
                            "must hold both",
                            h.last[2]->id.name, h.last[0]->id.name);
    gm_status status = check_induced(d, h.last[2], error);
    return status == GM_OK ? check_induced(d, h.last[0], error) : status;
}

gm_status gm_check_thrust(const gm_description *d, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < d->n_shafts && status == GM_OK; i++)
        status = check_pair(d, i, error);
    return status;
}
