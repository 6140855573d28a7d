/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/speed_in.h"

#include <stdio.h>
#include <string.h>

static bool is_name(const char *name, const char *text, size_t length)
{
    return strlen(name) == length && memcmp(name, text, length) == 0;
}

/* Number of the flange of this name: path or GM_MAX_PATHS; -1 after an error. */
static int find_flange(const gm_map *map, const char *text, size_t length,
                       gm_error *error)
{
    char known[2 * GM_MAP_TEXT + 16] = "";
    for (int p = 0; p < map->n_paths; p++) {
        if (is_name(map->paths[p].name, text, length))
            return p;
        const size_t used = strlen(known);
        (void)snprintf(known + used, sizeof known - used, "%s, ", map->paths[p].name);
    }
    if (is_name("output", text, length))
        return GM_MAX_PATHS;
    (void)gm_fail(error, GM_ERR_ARGUMENT,
                  "there is no flange \"%.*s\" whose speed could be an input (only "
                  "%soutput)",
                  length < 60 ? (int)length : 60, text, known);
    return -1;
}

/* A path that is engaged without a spring has no motion of its own. */
static gm_status check_springs(const gm_map *map, const gm_reduced_map *reduced, int p,
                               gm_error *error)
{
    for (int g = 0; g < reduced->path[p].n_gears; g++)
        if (!(reduced->path[p].gears[g].stiffness > 0))
            return gm_fail(error, GM_ERR_ARGUMENT,
                           "the speed of %s can be no input: its gear %d has no "
                           "stiffness in the map and would turn rigidly with the output",
                           map->paths[p].name, reduced->path[p].gears[g].number);
    return GM_OK;
}

static gm_status take_flange(const gm_map *map, const char *text, size_t length,
                             gm_reduced_map *reduced, gm_speed_in *made, gm_error *error)
{
    const int k = find_flange(map, text, length, error);
    if (k < 0)
        return GM_ERR_ARGUMENT;
    if (made->flange[k])
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "the flange %.*s is named twice among those whose speed is an "
                       "input",
                       (int)length, text);
    made->flange[k] = true;
    return k < GM_MAX_PATHS ? check_springs(map, reduced, k, error) : GM_OK;
}

gm_status gm_speed_in_read(const gm_map *map, const char *names, gm_reduced_map *reduced,
                           gm_speed_in *speed_in, gm_error *error)
{
    gm_speed_in made = {{false}};
    gm_status status = GM_OK;
    for (const char *at = names; at && status == GM_OK;) {
        const size_t length = strcspn(at, ",");
        status = take_flange(map, at, length, reduced, &made, error);
        at = at[length] ? at + length + 1 : NULL;
    }
    if (status != GM_OK)
        return status;
    for (int k = 0; k <= GM_MAX_PATHS; k++)
        reduced->prescribed[k] = made.flange[k];
    *speed_in = made;
    return GM_OK;
}
