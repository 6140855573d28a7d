/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a command shows while it runs, and how a stage is stopped.
 *
 *   auto   a bar on a terminal: what runs, how much is done, rate, time left, worst error
 *          so far; nothing at all where the standard error is no terminal
 *   json   lines of JSON on the standard error, for programs: docs/progress.md
 *   none   nothing
 *
 * SIGINT and SIGTERM ask a sweep to stop at its next report; the other stages end first
 * and clean up behind them. A second signal ends the program at once (a sweep's journal
 * survives that too).
 */
#ifndef PROGRESS_H
#define PROGRESS_H

#include "json.h"
#include "sweep/gm_sweep.h"

#include <stdbool.h>

typedef struct gm_progress {
    const char *stage, *name; /* what runs, and on what; name may be NULL */
    double started, shown_at; /* s of a steady clock; shown_at < 0: never */
    double worst;             /* error of a sweep, NAN: none */
    int width;                /* of what stands on the terminal's line */
} gm_progress;

/** Choose how progress is shown, for the whole program: "auto", "json" or "none". False:
 *  there is no such way; then a sentence stands on the standard error. */
bool gm_progress_choose(const char *mode);

/** Show nothing, but call this with every stage that begins (part < 0) and with the part
 *  that is done of it. */
typedef void (*gm_progress_listener)(void *user, const char *stage, double part);
void gm_progress_tell(gm_progress_listener listener, void *user);

/** Where lines of JSON are wanted: one of this event, with members of its own. */
void gm_progress_line(const gm_progress *progress, const char *event,
                      void (*members)(const void *data, gm_json *json), const void *data);

/** From here to gm_progress_end signals stop the stage instead of the program. The texts
 *  have to stay until the end. */
void gm_progress_begin(gm_progress *progress, const char *stage, const char *name);

/** Show the part that is done, 0 to 1, and words. */
void gm_progress_show(gm_progress *progress, double part, const char *words);

/** A gm_sweep_report; user is the gm_progress. */
int gm_progress_report(void *user, const gm_sweep_progress *state);

/** The words about a sweep: points, rate, time left, worst error. */
void gm_progress_words(const gm_sweep_progress *state, char *words, int size);

/** A time as people say it: "12 s", "3 min 05 s", "2 h 10 min". */
void gm_progress_time(double seconds, char *text, int size);

/** Clear the bar, give signals their default effect back. */
void gm_progress_end(gm_progress *progress);

/** True when a signal has asked to stop since gm_progress_begin. */
bool gm_progress_interrupted(void);

/* The option, for commands whose arguments have the field `const char *progress`. */
// clang-format off
#define GM_PROGRESS_OPTION(T)                                                            \
    {.kind = GM_OPTION_TEXT, .name = "progress", .value = "WAY", .fallback = "auto",     \
     .offset = offsetof(T, progress),                                                    \
     .help = "what is shown on the standard error meanwhile: auto, a bar if it is a "    \
             "terminal; json, a line of JSON now and then; none"}
// clang-format on

#endif
