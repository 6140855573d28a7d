/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake_c.h"

#include "commands.h"
#include "files.h"

#include <math.h>
#include <string.h>

#define USUAL_STEP 1e-3 /* s */
#define USUAL_THIN 3e-3

static bool is_one_of(const char *option, const char *given, const char *first,
                      const char *second)
{
    if (!given || strcmp(given, first) == 0 || strcmp(given, second) == 0)
        return true;
    fprintf(stderr, "gearmap: --%s is %s or %s, not '%s'\n", option, first, second,
            given);
    return false;
}

bool gm_bake_c_accepts(const gm_bake_c_settings *s, bool is_c)
{
    if (!is_c && (s->real || s->tables || !isnan(s->step) || !isnan(s->thin))) {
        fprintf(stderr, "gearmap: --real, --tables, --thin and --step go with --format c "
                        "only\n");
        return false;
    }
    return is_one_of("real", s->real, "float", "double") &&
           is_one_of("tables", s->tables, "float", "int16");
}

typedef struct baked {
    gm_bake_c_summary summary;
    const char *folder;
} baked;

static void print_text(const void *result, FILE *out)
{
    const baked *b = result;
    const gm_c_sizes *s = &b->summary.sizes;
    fprintf(out,
            "bake    %s, %d files: %ld kB of tables with %ld of the map's %ld nodes\n"
            "        largest error against the map %.3g %% of the loss torque there\n",
            b->folder, b->summary.files, (s->table_bytes + s->struct_bytes + 1023) / 1024,
            s->nodes, s->map_nodes, 100.0 * s->largest_error);
}

static void print_json(const void *result, gm_json *json)
{
    const baked *b = result;
    const gm_c_sizes *s = &b->summary.sizes;
    gm_json_text(json, "folder", b->folder);
    gm_json_integer(json, "files", b->summary.files);
    gm_json_integer(json, "nodes", s->nodes);
    gm_json_integer(json, "map_nodes", s->map_nodes);
    gm_json_integer(json, "table_bytes", s->table_bytes);
    gm_json_integer(json, "struct_bytes", s->struct_bytes);
    gm_json_number(json, "largest_error_relative", s->largest_error);
}

static const gm_result_form form = {print_text, print_json};

gm_status gm_bake_c_run(const char *path, const char *interpolation,
                        const gm_bake_c_settings *s, const char *folder, int as_json,
                        gm_error *error)
{
    char share[GM_PATH_SIZE];
    gm_map *map = NULL;
    gm_map_error *errors = NULL;
    gm_bake_c_options o = {.share = share};
    baked result = {.folder = folder};
    o.is_float = !s->real || strcmp(s->real, "float") == 0;
    o.is_int16 = s->tables && strcmp(s->tables, "int16") == 0;
    o.interpolation = strcmp(interpolation, "monotone") == 0 ? GM_INTERPOLATION_MONOTONE
                                                             : GM_INTERPOLATION_LINEAR;
    o.step = isnan(s->step) ? USUAL_STEP : s->step;
    o.thin = isnan(s->thin) ? USUAL_THIN : s->thin;
    gm_status status = gm_file_find_share(share, error);
    if (status == GM_OK)
        status = gm_map_read(path, &map, error);
    if (status == GM_OK)
        status = gm_map_get_errors(path, &o.n_errors, &errors, error);
    o.errors = errors;
    if (status == GM_OK)
        status = gm_bake_c(map, &o, folder, &result.summary, error);
    if (status == GM_OK)
        status = gm_command_print(&form, as_json, &result, error);
    gm_map_errors_free(o.n_errors, errors);
    gm_map_destroy(map);
    return status;
}
