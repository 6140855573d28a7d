/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The stage that drives one vehicle over one cycle, with the detailed gearset and with
 * the component in each of its fidelities, and compares.
 */
#ifndef CYCLE_STAGE_H
#define CYCLE_STAGE_H

#include "gearset_file.h"
#include "json.h"
#include "plant/gm_fmu_motion.h"
#include "vehicle/gm_compare.h"

enum { GM_CYCLE_RUNS = 4 }; /* two fidelities, in two ways */
#define GM_CYCLE_BOTH "both"
#define GM_CYCLE_TOLERANCE 1e-6

typedef struct gm_cycle_settings {
    const char *cycle;         /* name of a built-in one, or of a file *.csv */
    const char *vehicle;       /* file; NULL: the reference */
    const char *fidelity;      /* "rigid", "lash" or "both" */
    double tolerance;          /* relative error of a step */
    double communication_step; /* s: in Co-Simulation, too; NAN: not */
    const char *trace;         /* file of the drives over time; NULL: none */
} gm_cycle_settings;

/** One drive with the component. */
typedef struct gm_cycle_run {
    gm_fmu_fidelity fidelity;
    double communication_step; /* s, of Co-Simulation; NAN: Model Exchange */
    double recommended_step;   /* s, the shortest of all gears; NAN: Model Exchange */
    gm_record *record;
    gm_comparison comparison;
} gm_cycle_run;

typedef struct gm_cycle_stage {
    gm_cycle *cycle;
    gm_gear_plan *plan;
    int n_paths;
    const char *path_name[GM_MAX_INPUT_PATHS];
    char vehicle_sha256[65]; /* of its file; empty: the reference */
    double tolerance;
    gm_record *detailed;
    int n_runs;
    gm_cycle_run run[GM_CYCLE_RUNS];
} gm_cycle_stage;

/** Are cycle and vehicle there and in order? Errors of reading them. */
GM_NODISCARD gm_status gm_stage_cycle_check(const gm_cycle_settings *settings,
                                            gm_error *error);

/** Drive and compare, with a progress bar. On failure nothing is held. */
GM_NODISCARD gm_status gm_stage_cycle(const gm_gearset_file *file, const char *fmu,
                                      const gm_cycle_settings *settings,
                                      gm_cycle_stage *stage, gm_error *error);
void gm_stage_cycle_clear(gm_cycle_stage *stage);

/** Members of the stage's JSON object. */
void gm_cycle_stage_json(const gm_cycle_stage *stage, gm_json *json);

/** Lines for people: a small table, or everything. */
void gm_cycle_stage_print_table(const gm_cycle_stage *stage, FILE *out);
void gm_cycle_stage_print(const gm_cycle_stage *stage, FILE *out);

/** Write all drives over time as comma-separated values; the file is there complete or
 *  not at all. GM_ERR_IO. */
GM_NODISCARD gm_status gm_cycle_stage_trace(const gm_cycle_stage *stage, const char *path,
                                            gm_error *error);

/** "rigid" or "lash". */
const char *gm_fidelity_name(gm_fmu_fidelity fidelity);

enum { GM_RUN_NAME = 32 };
/** What people call a run: "lash", or in Co-Simulation "lash (CS, 1 ms)". */
void gm_cycle_run_name(const gm_cycle_run *run, char name[GM_RUN_NAME]);

#endif
