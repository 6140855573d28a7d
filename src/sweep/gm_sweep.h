/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The sweep: every experiment that the reduced gearset needs, on all cores, into a map.
 */
#ifndef GM_SWEEP_H
#define GM_SWEEP_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Zero means: automatic, or the plant's own maximum. */
typedef struct gm_sweep_options {
    double speed_step;  /* uniform speed axis, rad/s */
    double torque_step; /* uniform torque axis, N.m */
    double speed_max;   /* rad/s at the input flange */
    double torque_max;  /* N.m at the input flange */
    /* Axes by error: nodes are added until points held out are within the tolerance,
       which is the larger one of both. Both zero: automatic axes, or the steps. */
    double tolerance_share;  /* of the largest loss of the gear; below 1 */
    double tolerance_torque; /* N.m at the flange where the loss is */
    int monotone; /* how the tables will be read: 0 linearly, 1 by monotone cubics */
    int threads;
    /* An oil axis: the same gearset at n_oil >= 2 temperatures, ascending (that of each
       is in its info), and once between any two of them, from which follows how losses
       go from one to the next; 0: the tables hold for the plant's own temperature. */
    int n_oil;
    const gm_plant *const *at_oil;      /* [n_oil] */
    const gm_plant *const *between_oil; /* [n_oil - 1]; NULL: linear in temperature */
    /* How the plant was made, where that is not its own way: part of what tells one sweep
       from another; NULL: nothing. At most 80 characters. */
    const char *experiments;
} gm_sweep_options;

/** Every point is an operating point that is solved once. With axes by error the total
 *  is what is known so far, and grows. */
typedef struct gm_sweep_progress {
    long points_done, points_total; /* resumed ones included */
    long points_resumed;
    double worst_error; /* at points held out so far, of the largest loss of their table;
                           NAN: none, or axes not by error */
    double elapsed;     /* s */
} gm_sweep_progress;

/** Called from one thread at a time, between points, a few times a second; return
 *  non-zero to stop (the sweep then answers GM_ERR_INTERRUPTED and keeps its journal). */
typedef int (*gm_sweep_report)(void *user, const gm_sweep_progress *progress);

/** Tables of one symbol whose axes could not be made fine enough. */
typedef struct gm_sweep_missed {
    int tables, of;            /* how many missed the tolerance, of all of the symbol */
    gm_table_key key;          /* the one with the largest error */
    int n[GM_MAX_AXES];        /* its nodes */
    double error;              /* of the largest loss */
    double worst[GM_MAX_AXES]; /* where: coordinates of its axes, SI */
} gm_sweep_missed;

typedef struct gm_sweep_summary {
    long points; /* solved now, without resumed ones */
    long resumed;
    double elapsed;                     /* s */
    double largest_ratio_deviation;     /* identified against given ratios, relative */
    gm_sweep_missed missed[GM_SYMBOLS]; /* by symbol, axes by error only */
    double uncertainty; /* N.m, largest of a torque that was measured on a simulated
                           plant; 0: all points were solved */
    int n_skipped;      /* points at which a simulated plant failed twice; their values
                           come from their neighbours */
    struct gm_skipped_point *skipped; /* [n_skipped], owned: sentences with the reason */
} gm_sweep_summary;

/** A point that failed, and why. */
typedef struct gm_skipped_point {
    char words[GM_ERROR_MESSAGE_SIZE];
} gm_skipped_point;

/** Free what a summary holds. */
void gm_sweep_summary_clear(gm_sweep_summary *summary);

/** Run. path: the map's file, or NULL: in memory only. report and summary may be NULL.
 *  On success *map is the caller's. The result does not depend on the number of threads
 *  nor on interruptions; after one, the same call resumes from the journal beside path.
 *  GM_ERR_ARGUMENT: an option is out of range or gives too many nodes.
 *  GM_ERR_MODEL: an identified ratio differs from the given one by more than 1e-3 or in
 *  sign, or the tables would not give a unique solution (|dD/dtau| >= 1).
 *  GM_ERR_SOLVE: a point has no solution; it is named. GM_ERR_IO, GM_ERR_MEMORY.
 *  Only GM_ERR_INTERRUPTED, GM_ERR_IO and GM_ERR_MEMORY leave a journal behind: repeated,
 *  the others would end in the same way. */
GM_NODISCARD gm_status gm_sweep_run(const gm_plant *plant,
                                    const gm_sweep_options *options, const char *path,
                                    gm_sweep_report report, void *user, gm_map **map,
                                    gm_sweep_summary *summary, gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
