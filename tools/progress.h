/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a sweep shows while it runs, and how a stage is stopped. The bar appears only on a
 * terminal. SIGINT and SIGTERM ask a sweep to stop at its next report; the other stages
 * end first and clean up behind them. A second signal ends the program at once (a sweep's
 * journal survives that too).
 */
#ifndef PROGRESS_H
#define PROGRESS_H

#include "sweep/gm_sweep.h"

#include <stdbool.h>

typedef struct gm_progress {
    bool shown; /* something stands on the line */
} gm_progress;

/** From here to gm_progress_end signals stop the stage instead of the program. */
void gm_progress_begin(gm_progress *progress);

/** Draw a bar for the part that is done, 0 to 1, and words. */
void gm_progress_show(gm_progress *progress, double part, const char *words);

/** A gm_sweep_report; user is the gm_progress. */
int gm_progress_report(void *user, const gm_sweep_progress *state);

/** Clear the bar, give signals their default effect back. */
void gm_progress_end(gm_progress *progress);

/** True when a signal has asked to stop since gm_progress_begin. */
bool gm_progress_interrupted(void);

#endif
