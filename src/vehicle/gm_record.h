/* SPDX-License-Identifier: BSD-2-Clause
 *
 * One drive of a cycle, recorded: the vehicle with one gearset, sampled at equal times.
 */
#ifndef GM_RECORD_H
#define GM_RECORD_H

#include "solve/gm_transient.h"
#include "vehicle/trip.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One sample: what is seen, and the processor time that it took to come here. */
typedef struct gm_sample {
    gm_trip_view view;
    double cpu; /* s */
} gm_sample;

typedef struct gm_record {
    double step; /* s between samples; the first is at 0 */
    int n;
    gm_sample *sample; /* [n] */
    gm_transient_statistics work;
    gm_transient_energy energy;
    double gearset_time; /* s spent in the gearset's rates */
} gm_record;

/** Called after each sample with the share of the cycle that is done; non-zero ends the
 *  drive with GM_ERR_INTERRUPTED. NULL: no one wants to know. */
typedef struct gm_record_progress {
    int (*call)(void *context, double done);
    void *context;
} gm_record_progress;

/** Drive the whole cycle. step [s] > 0. On success *record is the caller's. Errors of the
 *  solver and the plant, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_record_create(const gm_trip_parts *parts,
                                        const gm_transient_options *options, double step,
                                        const gm_record_progress *progress,
                                        gm_record **record, gm_error *error);
void gm_record_destroy(gm_record *record);

/** Energy lost in the gearset from the start to sample i [J]. */
double gm_record_loss(const gm_record *record, int i);

#ifdef __cplusplus
}
#endif
#endif
