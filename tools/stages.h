/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The stages of a reduction, as several commands run them: sweep, bake, verify. Each
 * tells what it did in a small result that prints as text and as JSON.
 */
#ifndef STAGES_H
#define STAGES_H

#include "bake/gm_bake.h"
#include "gearset_file.h"
#include "json.h"
#include "options.h"
#include "plant/gm_fmu.h"
#include "results.h"
#include "sweep/gm_sweep.h"
#include "sweep/gm_verify.h"

/** Options of a sweep as given; NAN or GM_OPTION_UNSET: not given. */
typedef struct gm_sweep_settings {
    double speed_step, torque_step; /* rad/s, N.m */
    double speed_max, torque_max;   /* rad/s, N.m */
    gm_option_error tolerance;      /* both zero: not given */
    int monotone; /* set by the command: how the map will be read, for the tolerance */
    gm_option_list oil; /* K; one: the temperature, more: an oil axis; none: the
                           description's */
    int threads;
    const char *losses, *inertia; /* NULL: automatic */
    double dwell, ramp_time;      /* s */
} gm_sweep_settings;

typedef struct gm_sweep_stage {
    gm_map *map; /* owned */
    gm_sweep_summary summary;
    const char *path; /* NULL: in memory */
    gm_option_error tolerance;
    gm_experiment_choice how;
    double inertia_uncertainty; /* relative */
} gm_sweep_stage;

typedef struct gm_bake_stage {
    gm_bake_summary summary;
    double elapsed; /* s */
} gm_bake_stage;

typedef struct gm_verify_stage {
    gm_verify_result result; /* owned */
    double elapsed;          /* s */
    int n_oil;               /* an oil axis, K */
    double oil[GM_MAP_MAX_OIL];
} gm_verify_stage;

/** The experiments that these settings choose. GM_ERR_ARGUMENT: there is none of this
 *  name. */
GM_NODISCARD gm_status gm_stage_choose(const gm_sweep_settings *settings,
                                       gm_experiment_choice *how, gm_error *error);

/** Sweep with a progress bar; path NULL: the map stays in memory. When a signal stopped
 *  it, GM_ERR_INTERRUPTED with a sentence that says what is kept. */
GM_NODISCARD gm_status gm_stage_sweep(const gm_gearset_file *file,
                                      const gm_sweep_settings *settings, const char *path,
                                      gm_sweep_stage *stage, gm_error *error);
void gm_stage_sweep_clear(gm_sweep_stage *stage);

/** How to bake, as given. */
typedef struct gm_bake_settings {
    const char *compiler;      /* NULL: the one that is found */
    const char *interpolation; /* its name */
    const char *speed_in;      /* flanges whose speed is an input; NULL: none */
} gm_bake_settings;

/** True when there is an interpolation of this name; else a sentence on the standard
 *  error. */
bool gm_stage_knows_interpolation(const char *name);

/** Whether it is the one by monotone cubics. */
bool gm_stage_is_monotone(const char *name);

/** Bake map into path, with results for the passport (there may be none). */
GM_NODISCARD gm_status gm_stage_bake(const gm_map *map, const gm_results *results,
                                     const gm_bake_settings *settings, const char *path,
                                     gm_bake_stage *stage, gm_error *error);

/** GUID that baking the map so gives. */
GM_NODISCARD gm_status gm_stage_guid(const gm_map *map, const gm_bake_settings *settings,
                                     char guid[64], gm_error *error);

/** Oil temperature of the description to begin with [K]; NAN: its own. */
double gm_stage_temperature(const gm_sweep_settings *settings);

/** Compare the FMU with the gearset; one with an oil axis at random temperatures between
 *  its ends, unless alone is 1. */
GM_NODISCARD gm_status gm_stage_verify(const gm_gearset_file *file, gm_fmu *fmu,
                                       int alone, int points, int seed,
                                       gm_verify_stage *stage, gm_error *error);
void gm_stage_verify_clear(gm_verify_stage *stage);

/** Compare the map of a sweep with the plant, by the reduced gearset in this program, and
 *  write the errors into the map's file. */
GM_NODISCARD gm_status gm_stage_measure(const gm_gearset_file *file,
                                        const gm_sweep_stage *sweep, int monotone,
                                        int points, int seed, gm_verify_stage *stage,
                                        gm_error *error);

/** Say on the standard error at which points a simulated model failed, and why. */
void gm_stage_warn_skips(const gm_sweep_stage *stage);
/** The same of a verification: how many points were left out, and the first of them. */
void gm_stage_warn_left_out(const gm_verify_stage *stage);

/** Say on the standard error which tables missed the tolerance of the sweep and where,
 *  and which kinds of points lie outside of it as measured. */
void gm_stage_warn(const gm_sweep_stage *sweep, const gm_verify_stage *verify);

/** Write the errors and the result of a verification (NULL: none) into the
 *  map's file. */
GM_NODISCARD gm_status gm_stage_keep(const gm_verify_stage *stage, const gm_map *map,
                                     const char *result, const char *map_path,
                                     gm_error *error);

/** What a kind of points (gm_verify_group) is called for people. */
const char *gm_stage_group_title(int group);

/** The tolerance of the sweep and the tables that missed it, when there is one. */
void gm_stage_missed_json(const gm_sweep_stage *stage, gm_json *json);

/** Members of the stage's JSON object. */
void gm_sweep_stage_json(const gm_sweep_stage *stage, gm_json *json);
void gm_bake_stage_json(const gm_bake_stage *stage, const char *fmu, gm_json *json);
void gm_verify_stage_json(const gm_verify_stage *stage, gm_json *json);

/** Lines for people. */
void gm_sweep_stage_print(const gm_sweep_stage *stage, FILE *out);
void gm_bake_stage_print(const gm_bake_stage *stage, const char *fmu, FILE *out);
void gm_verify_stage_print(const gm_verify_stage *stage, FILE *out);
/** The table of groups alone, without the single gears. */
void gm_verify_stage_print_groups(const gm_verify_stage *stage, FILE *out);

/** Seconds of a steady clock. */
double gm_stage_clock(void);

/* The options of a bake, for the tables of the commands that have a field
 * `gm_bake_settings bake` in their arguments. */
#define GM_BAKE_OPTION(type, field)                                                      \
    (offsetof(type, bake) + offsetof(gm_bake_settings, field))
// clang-format off
#define GM_BAKE_OPTIONS(type)                                                            \
    {.kind = GM_OPTION_TEXT, .name = "interpolation", .value = "NAME",                   \
     .fallback = "linear", .offset = GM_BAKE_OPTION(type, interpolation),                \
     .help = "between the nodes of the tables: linear, or monotone for cubics with "     \
             "continuous gradient"},                                                     \
    GM_COMPILER_OPTION(GM_BAKE_OPTION(type, compiler))
// clang-format on

/* The options of a sweep, for the tables of the commands that have a field
 * `gm_sweep_settings sweep` in their arguments. */
#define GM_SWEEP_OPTION(type, field)                                                     \
    (offsetof(type, sweep) + offsetof(gm_sweep_settings, field))
// clang-format off
#define GM_SWEEP_OPTIONS(type)                                                           \
    {.kind = GM_OPTION_QUANTITY, .name = "speed-step", .value = "SPEED", .unit = "rpm",  \
     .low = 1, .high = 1e5, .offset = GM_SWEEP_OPTION(type, speed_step),                 \
     .help = "uniform speed axis with this step; default: an axis that is dense at "     \
             "low speed"},                                                               \
    {.kind = GM_OPTION_QUANTITY, .name = "torque-step", .value = "TORQUE", .unit = "Nm", \
     .low = 0.1, .high = 1e5, .offset = GM_SWEEP_OPTION(type, torque_step),              \
     .help = "uniform torque axis with this step; default: an axis that is dense at "    \
             "small torque"},                                                            \
    {.kind = GM_OPTION_ERROR, .name = "tolerance", .value = "ERROR",                     \
     .offset = GM_SWEEP_OPTION(type, tolerance),                                         \
     .help = "choose the nodes of every axis by this error at points held out: 0.5% of " \
             "the largest loss of each gear, or 0.1Nm, or 0.5%,0.1Nm: the larger one"},  \
    {.kind = GM_OPTION_QUANTITY, .name = "speed-max", .value = "SPEED", .unit = "rpm",   \
     .low = 10, .high = 1e5, .offset = GM_SWEEP_OPTION(type, speed_max),                 \
     .help = "largest speed at the input; default: the description's"},                  \
    {.kind = GM_OPTION_QUANTITY, .name = "torque-max", .value = "TORQUE", .unit = "Nm",  \
     .low = 1, .high = 1e6, .offset = GM_SWEEP_OPTION(type, torque_max),                 \
     .help = "largest torque at the input; default: the description's"},                 \
    {.kind = GM_OPTION_INTEGER, .name = "threads", .value = "N", .low = 1, .high = 1024, \
     .offset = GM_SWEEP_OPTION(type, threads),                                           \
     .help = "threads to compute with; default: one per core"},                          \
    {.kind = GM_OPTION_TEXT, .name = "losses", .value = "NAME",                          \
     .offset = GM_SWEEP_OPTION(type, losses),                                            \
     .help = "steady: the balance of every point is solved; settle: every point is "     \
             "simulated until nothing changes; ramp: speeds are ramped through it; "     \
             "default: steady, of foreign models what the rig file says"},               \
    {.kind = GM_OPTION_TEXT, .name = "inertia", .value = "NAME",                         \
     .offset = GM_SWEEP_OPTION(type, inertia),                                           \
     .help = "mass-matrix, or ramps of different slope; default: mass-matrix, of "       \
             "foreign models ramps"},                                                    \
    {.kind = GM_OPTION_QUANTITY, .name = "dwell", .value = "TIME", .unit = "s",          \
     .low = 1e-5, .high = 1000, .offset = GM_SWEEP_OPTION(type, dwell),                  \
     .help = "time over which torques and speeds are constant in settle; default: "      \
             "doubled until the model answers like one inertia"},                        \
    {.kind = GM_OPTION_QUANTITY, .name = "ramp-time", .value = "TIME", .unit = "s",      \
     .low = 1e-4, .high = 1000, .offset = GM_SWEEP_OPTION(type, ramp_time),              \
     .help = "time of one ramp; default: what a fifth of the largest torque takes, at "  \
             "least eight dwells"},                                                      \
    GM_OIL_LIST_OPTION(                                                                  \
        GM_SWEEP_OPTION(type, oil),                                                      \
        "oil temperature; several, such as -10degC,20degC,80degC: tables for each, "     \
        "between which losses follow the input oil_temperature; default: the "           \
        "description's")
// clang-format on

#endif
