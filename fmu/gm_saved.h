/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A run as it is kept by the host: one plain struct without pointers and without padding,
 * so that its bytes are the state, the same ones for the same state. They are valid in
 * every process that runs this component on a platform with the same byte order.
 *
 * Interpolation caches have no influence on results and are not kept; whether leaving the
 * map was reported belongs to the instance, as it does over a reset. All else is kept:
 * the clock, the phase, inputs with their slopes, parameters, the motion and the
 * accounts, so that what follows is the same to the last bit.
 *
 * In front stand a magic number, the layout's version, a hash of the component's GUID and
 * a sum of the rest: states of other components and damaged ones are told apart. The sum
 * finds accidents; it is no protection against forgery.
 */
#ifndef GM_SAVED_H
#define GM_SAVED_H

#include <stdint.h>

#include "gm_run.h"

typedef struct gm_saved_path {
    gm_real phi, w, twist, rate;
    int32_t mode, gear, gear_reported, reported_gear;
} gm_saved_path;

/* Every member lies at a multiple of its size and the whole is a multiple of 8 bytes:
 * there are no gaps. */
typedef struct gm_saved {
    uint32_t magic, version;
    uint64_t guid, sum;
    gm_real value[GM_VARIABLES][GM_MAX_PATHS]; /* integers too: exact */
    gm_real output_rate, phi_o, w_o, brake, work, loss_energy;
    gm_real time, stop_time, last_step;
    gm_saved_path path[GM_MAX_PATHS];
    int32_t phase, flags, start_pending, outputs_pending;
    int32_t experiment_set, stop_defined;
    int32_t direction[GM_MODE_SHAFTS], slip[GM_MAX_PATHS], outside;
    int32_t exchange, update_due;
} gm_saved;

typedef enum gm_saved_verdict {
    GM_SAVED_OK,
    GM_SAVED_FOREIGN,    /* no saved state, or of another layout or byte order */
    GM_SAVED_OTHER_FMU,  /* of a component with another GUID */
    GM_SAVED_OTHER_TYPE, /* of an exchange, for a run that is none, or vice versa */
    GM_SAVED_DAMAGED     /* the bytes are not those that were saved */
} gm_saved_verdict;

/** Keep the run of the component with this GUID in *saved; every byte is written. */
void gm_saved_make(const char *guid, const gm_run *run, gm_saved *saved);

/** Whether *saved belongs to the component with this GUID, from what stands in front. */
gm_saved_verdict gm_saved_owner(const char *guid, const gm_saved *saved);

/** The same, and whether it is undamaged: what gm_saved_restore may be given. */
gm_saved_verdict gm_saved_check(const char *guid, const gm_saved *saved);

/** Whether the run is of the kind that was kept: an exchange or not. */
gm_saved_verdict gm_saved_fits(const gm_saved *saved, const gm_run *run);

/** The run that was kept, with empty caches; map_left stays. */
void gm_saved_restore(const gm_saved *saved, gm_run *run);

#endif
