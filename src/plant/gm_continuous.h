/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A model on the test rig whose motion somebody else integrates (Model Exchange): rates
 * of its states at constant commands, events, and what is seen. solve makes a rig of it.
 */
#ifndef GM_CONTINUOUS_H
#define GM_CONTINUOUS_H

#include "plant/gm_rig.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Calls that return int: 0 done, > 0 not at this x (a smaller step is taken), < 0 the
 *  model failed for good; gm_continuous_class.why then has its words. */
typedef struct gm_continuous_class {
    gm_status (*create)(const void *self, void **model, gm_error *error);
    void (*destroy)(void *model);
    int (*n_states)(const void *model);
    int (*n_events)(const void *model);
    /* Begin at t = 0: x[n_states], and the usual size of each state. */
    gm_status (*start)(void *model, const gm_rig_command *command, double *x,
                       double *nominal, gm_error *error);
    /* Commands change at t and x; events that follow are over, x may have jumped. */
    gm_status (*command)(void *model, const gm_rig_command *command, double t, double *x,
                         gm_error *error);
    int (*rates)(void *model, double t, const double *x, double *dx);
    int (*events)(void *model, double t, const double *x, double *g);
    /* A step of the solver is complete. *event: an event is due here. */
    gm_status (*completed)(void *model, double t, const double *x, int *event,
                           gm_error *error);
    /* An event at t: bring it to its end; x may have jumped. */
    gm_status (*event)(void *model, double t, double *x, gm_error *error);
    gm_status (*view)(void *model, double t, const double *x, gm_rig_view *view,
                      gm_error *error);
    const char *(*why)(const void *model);
    /* d rates / d x in compressed columns: column_start[n_states + 1], row[entries],
       value[entries]. NULL: the solver takes differences. */
    int (*entries)(const void *model);
    void (*pattern)(const void *model, int *column_start, int *row);
    int (*jacobian)(void *model, double t, const double *x, double *value);
} gm_continuous_class;

typedef struct gm_continuous {
    const gm_continuous_class *is;
    const void *self;
    int n_paths;
    gm_rig_drive drive[GM_MAX_FLANGES];
    double step; /* s, as in gm_rig */
} gm_continuous;

#ifdef __cplusplus
}
#endif
#endif
