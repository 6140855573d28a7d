/* SPDX-License-Identifier: BSD-2-Clause
 *
 * One run of the component: the phase of its life, its clock, and what may be done when.
 * The phases are those of FMI 2.0 and 3.0. A plain struct without pointers;
 * a new member belongs into gm_saved.h too. How verdicts become status codes and messages
 * is the matter of the FMI version.
 */
#ifndef GM_RUN_H
#define GM_RUN_H

#include "gm_states.h"

/** Bits, so that a set of phases is a mask. */
typedef enum gm_phase {
    GM_PHASE_INSTANTIATED = 1,
    GM_PHASE_INITIALISATION = 2,
    GM_PHASE_STEP = 4,        /* a communication point: the last step is complete */
    GM_PHASE_STEP_FAILED = 8, /* the last step was not done */
    GM_PHASE_TERMINATED = 16,
    GM_PHASE_ERROR = 32,
    GM_PHASE_EVENT = 64,      /* exchange: discrete inputs may change */
    GM_PHASE_CONTINUOUS = 128 /* exchange: a solver moves time and states */
} gm_phase;

typedef struct gm_run {
    gm_component component;
    gm_phase phase;
    bool experiment_set; /* start time given */
    bool stop_defined;
    gm_real time, stop_time;          /* s */
    gm_real last_step;                /* s, 0 before the first */
    bool update_due;                  /* exchange: something changed in this event */
    bool map_left;                    /* leaving the map was reported */
    bool gear_reported[GM_MAX_PATHS]; /* the refused command was reported, */
    int reported_gear[GM_MAX_PATHS];  /* and this is which */
} gm_run;

typedef enum gm_verdict {
    GM_VERDICT_OK,
    GM_VERDICT_UNKNOWN,    /* no such value reference */
    GM_VERDICT_TYPE,       /* the variable has another type */
    GM_VERDICT_READ_ONLY,  /* it can never be set */
    GM_VERDICT_PHASE,      /* it cannot be set now */
    GM_VERDICT_NOT_FINITE, /* NaN or infinite */
    GM_VERDICT_RANGE,      /* outside min..max */
    GM_VERDICT_STEP_SIZE,  /* not positive and finite */
    GM_VERDICT_TIME,       /* not the time where the last step ended */
    GM_VERDICT_STOP,       /* beyond the stop time */
    GM_VERDICT_OVERFLOW    /* numbers left the range of double */
} gm_verdict;

/** As after instantiation. The reports of map_left are kept, once per instance, and
 *  whether it is an exchange. */
void gm_run_reset(const gm_reduced_map *map, gm_run *run);

/** Variable of a value reference, if it is carried by `carrier`. */
gm_verdict gm_run_find(const gm_reduced_map *map, unsigned vr, gm_type carrier,
                       gm_reference *reference);

/** Set if variable, phase and value allow it. */
gm_verdict gm_run_set(const gm_reduced_map *map, gm_run *run, gm_reference reference,
                      gm_value value);

/** Get; in initialisation the start is computed anew when a start value changed. */
gm_verdict gm_run_get(const gm_reduced_map *map, gm_run *run, gm_reference reference,
                      gm_value *value);

/** First derivative of a state at this instant; GM_VERDICT_UNKNOWN when the variable is
 *  none. */
gm_verdict gm_run_rate(const gm_reduced_map *map, gm_run *run, gm_reference reference,
                       gm_real *rate);

/** Finish initialisation: the component starts. */
gm_verdict gm_run_start(const gm_reduced_map *map, gm_run *run);

/** Step from time t by h. On GM_VERDICT_OVERFLOW nothing has changed. */
gm_verdict gm_run_step(const gm_reduced_map *map, gm_run *run, gm_real t, gm_real h);

/** Treat the event at hand of an exchange. *jumped: states changed. */
gm_verdict gm_run_update(const gm_reduced_map *map, gm_run *run, bool *jumped);

/** States from the solver outside; NaN and infinity are refused, nothing changes then. */
gm_verdict gm_run_set_states(const gm_reduced_map *map, gm_run *run, const gm_real *x);

/** True when the last step has nothing to report: the usual case, told apart quickly. */
bool gm_run_is_quiet(const gm_run *run);

/** True once for each refused command on path p. */
bool gm_run_gear_refused(gm_run *run, int p);

/** True once, when the map has been left. */
bool gm_run_map_left(gm_run *run);

/** True when the number is neither NaN nor infinite. */
bool gm_number_is_finite(gm_real x);

#endif
