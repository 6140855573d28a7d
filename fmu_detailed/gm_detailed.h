/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset as a component with the variables of a reduced one: torques and
 * gears in; angles, speeds, losses and energies out. Knows nothing of FMI.
 *
 * States: those of the motion, then the angles of the flanges (0 the output, 1 + p path
 * p), the work done by the flanges and the energy lost. What the solver outside cannot
 * see are the modes: they change in gm_detailed_start and gm_detailed_update only, and so
 * does the temperature of the oil, which the gearset is assembled for.
 */
#ifndef GM_DETAILED_H
#define GM_DETAILED_H

#include "gm_variables.h"
#include "model/gm_motion_flanges.h"
#include "model/gm_motion_variables.h"

enum { GM_DETAILED_PATHS = GM_MAX_INPUT_PATHS };

typedef struct gm_detailed {
    /* made once */
    gm_description *description;
    gm_motion_variables variables;
    char guid[GM_MOTION_GUID_SIZE];
    int n_paths, n_motion, n_states, n_events, n_entries;
    int *column_start, *row;  /* pattern of the Jacobian of the motion's rates */
    double *entry;            /* its values */
    double *nominal;          /* [n_states] */
    double *column, *changed; /* scratch: [n_states] */
    /* for one temperature of the oil */
    gm_gearset *gearset;
    gm_motion *motion;
    gm_motion_flanges *flanges;
    /* what may be set, start values too; [id][path] */
    double value[GM_VARIABLES][GM_DETAILED_PATHS];
    bool refused[GM_DETAILED_PATHS];
    bool start_pending; /* something was set since the start */
    /* the motion */
    gm_motion_input input; /* with the gears that are obeyed */
    double *x;             /* [n_states] */
    double jump_loss;      /* J, of the motion, that is in the account already */
    /* of the present x and inputs, where known */
    bool rates_known, signals_known, losses_known;
    double *rates, *signals;
    gm_motion_view view;
    double loss_torque[GM_MAX_FLANGES];
} gm_detailed;

/** From the description file at path. Fails as gm_description_read, gm_gearset_create and
 *  gm_motion_create. Free with gm_detailed_destroy. */
GM_NODISCARD gm_status gm_detailed_create(const char *path, gm_detailed **detailed,
                                          gm_error *error);
void gm_detailed_destroy(gm_detailed *detailed);

/** All variables at their start values; a start is pending. */
void gm_detailed_reset(gm_detailed *detailed);

/** Start value of a variable: that of the list, or of this gearset. */
double gm_detailed_start_value(const gm_detailed *detailed, gm_reference reference);

/** Begin with the commanded gears engaged and the start speeds, if a start is pending.
 *  GM_ERR_MODEL: gears that block each other, no such oil; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_detailed_start(gm_detailed *detailed, gm_error *error);

/** Treat an event: gear commands, locks, temperature. *jumped: states changed. Fails as
 *  gm_detailed_start. */
GM_NODISCARD gm_status gm_detailed_update(gm_detailed *detailed, bool *jumped,
                                          gm_error *error);

/** The gearset for another oil [K], in the modes of the one that was; the parameters of
 *  value[] for the motion. */
GM_NODISCARD gm_status gm_detailed_take_oil(gm_detailed *detailed, double oil,
                                            gm_error *error);
void gm_detailed_take_parameters(gm_detailed *detailed);

/** Whether the modes have to change though no event indicator has been seen to: the oil
 *  has another temperature by now, or a lock's speeds are equal. */
bool gm_detailed_is_due(gm_detailed *detailed);

/** Store a value that has been checked. */
void gm_detailed_set(gm_detailed *detailed, gm_reference reference, double value);
/** States from outside; all finite. */
void gm_detailed_set_states(gm_detailed *detailed, const double *x);

/** Rates of the states in detailed->rates; false when they are not finite. */
bool gm_detailed_evaluate(gm_detailed *detailed);
/** Event indicators z[n_events]. */
void gm_detailed_events(gm_detailed *detailed, double *z);

/** Value of a variable of the flanges, of the list; false when it is not finite. */
bool gm_detailed_get(gm_detailed *detailed, gm_reference reference, double *value);
bool gm_detailed_get_inner(gm_detailed *detailed, int i, double *value);

/** State that a variable of the flanges shows, -1: none; whose rate it is, -1: none. */
int gm_detailed_state_of(const gm_detailed *detailed, gm_reference reference);
int gm_detailed_rate_of(const gm_detailed *detailed, gm_reference reference);

/** Numbers that, with value[] and the states, are all that the component remembers: see
 *  gm_detailed_saved.c. */
int gm_detailed_n_saved(const gm_detailed *detailed);
void gm_detailed_save(const gm_detailed *detailed, double *saved);
/** GM_ERR_ARGUMENT: not saved by this component. */
GM_NODISCARD gm_status gm_detailed_restore(gm_detailed *detailed, const double *saved,
                                           gm_error *error);

#endif
