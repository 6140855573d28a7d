/* SPDX-License-Identifier: BSD-2-Clause
 *
 * One component in motion, as the files of its adapter share it.
 */
#ifndef FMU_MOTION_H
#define FMU_MOTION_H

#include "plant/fmu_parts.h"
#include "plant/gm_fmu_motion.h"

enum { N_VIEW = 3 };

struct gm_fmu_plant {
    char *path;
    gm_fmu_fidelity fidelity;
    int n_paths;
    int directional;
};

typedef struct gm_fmu_motion {
    const gm_fmu_plant *plant;
    gm_fmu *fmu;
    int n, n_events;
    unsigned tau[GM_MAX_FLANGES], acceleration[GM_MAX_FLANGES];
    unsigned gear[GM_MAX_INPUT_PATHS], state[GM_MAX_INPUT_PATHS];
    unsigned energy[N_VIEW]; /* loss power, kinetic and elastic energy */
    int speed[GM_MAX_FLANGES];
    gm_motion_input input; /* as the FMU knows it */
    double *x;             /* [n], likewise; x[0] not a number: not known */
    int indicators_known;  /* those in indicator belong to input and x */
    double *column;        /* [n] */
    double *indicator;     /* [n_events] */
    int *above;            /* [n_events] side of each indicator in the present mode */
    fmi2ValueReference *state_reference, *rate_reference; /* [n] */
} gm_fmu_motion;

/** "output", "input" or "odd", "even". */
const char *gm_fmu_flange_name(int n_paths, int flange);

/** gm_fmu_find of "<flange>.<name>". */
GM_NODISCARD gm_status gm_fmu_find_at(const gm_fmu *fmu, const char *flange,
                                      const char *name, unsigned *reference,
                                      gm_error *error);

/** Hand torques and states over. Non-zero: the FMU refuses them. */
int gm_fmu_motion_put(gm_fmu_motion *motion, const gm_motion_input *input,
                      const double *x);

/** The calls of gm_dynamics_class that have to do with derivatives. */
int gm_fmu_motion_rates(void *motion, const gm_motion_input *input, const double *x,
                        double *dx);
int gm_fmu_motion_entries(const void *motion);
void gm_fmu_motion_pattern(const void *motion, int *column_start, int *row);
int gm_fmu_motion_jacobian(void *motion, const gm_motion_input *input, const double *x,
                           double *value);
int gm_fmu_motion_torque_column(void *motion, const gm_motion_input *input,
                                const double *x, int flange, double *column);

#endif
