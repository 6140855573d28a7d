/* SPDX-License-Identifier: BSD-2-Clause */
#include "baked.h"

#include "bake/example_map.h"
#include "bake/gm_bake.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

void baked_write(const char *path)
{
    const gm_bake_options options = {.share = GM_BINARY_DIR "/share/gearmap"};
    gm_map *map = example_map(2);
    gm_error error;
    if (gm_bake_fmu2(map, &options, path, NULL, &error) != GM_OK)
        fail_msg("%s", error.message);
    gm_map_destroy(map);
}

static char folder[64], fmu[96];

int baked_make(void **state)
{
    strcpy(folder, "/tmp/gearmap-test-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(fmu, sizeof fmu, "%s/good.fmu", folder);
    baked_write(fmu);
    *state = fmu;
    return 0;
}

int baked_remove(void **state)
{
    (void)state;
    (void)unlink(fmu);
    (void)rmdir(folder);
    return 0;
}
