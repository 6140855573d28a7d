/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap bake --format c: its options and its result.
 */
#ifndef BAKE_C_H
#define BAKE_C_H

#include "json.h"
#include "options.h"

#include "bake/gm_bake_c.h"

#include <stdbool.h>

/** As given: NULL or NAN where not. */
typedef struct gm_bake_c_settings {
    const char *real, *tables; /* names */
    double step, thin;         /* s, part */
} gm_bake_c_settings;

/** True when the names are known and, for another format than c, nothing is set; else a
 *  sentence on the standard error. */
bool gm_bake_c_accepts(const gm_bake_c_settings *settings, bool is_c);

/** Bake the map at path into a folder and print what was done. */
GM_NODISCARD gm_status gm_bake_c_run(const char *path, const char *interpolation,
                                     const gm_bake_c_settings *settings,
                                     const char *folder, int as_json, gm_error *error);

/* For the option table of a command with a field `gm_bake_c_settings c`. */
#define GM_BAKE_C_OPTION(type, field)                                                    \
    (offsetof(type, c) + offsetof(gm_bake_c_settings, field))
// clang-format off
#define GM_BAKE_C_OPTIONS(type)                                                          \
    {.kind = GM_OPTION_TEXT, .name = "real", .value = "NAME",                            \
     .offset = GM_BAKE_C_OPTION(type, real),                                             \
     .help = "with --format c, type of all numbers: float or double; default: float"},   \
    {.kind = GM_OPTION_TEXT, .name = "tables", .value = "NAME",                          \
     .offset = GM_BAKE_C_OPTION(type, tables),                                           \
     .help = "with --format c, nodes of the tables: float (as the other numbers), or "   \
             "int16 with a scale for each table; default: float"},                       \
    {.kind = GM_OPTION_QUANTITY, .name = "thin", .value = "PART", .unit = "",            \
     .low = 0, .high = 0.1, .offset = GM_BAKE_C_OPTION(type, thin),                      \
     .help = "with --format c, leave out nodes that the others give within this part "   \
             "of the largest loss torque at the same flange; default: 0.003"},           \
    {.kind = GM_OPTION_QUANTITY, .name = "step", .value = "TIME", .unit = "s",           \
     .low = 1e-6, .high = 1, .offset = GM_BAKE_C_OPTION(type, step),                     \
     .help = "with --format c, the step that the controller takes (others can be "       \
             "given at each call); default: 1 ms"}
// clang-format on

#endif
