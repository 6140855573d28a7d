/* SPDX-License-Identifier: BSD-2-Clause */
#include "progress.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define BAR 30
#define LINE 100

/* The one thing that a signal handler may touch. */
static volatile sig_atomic_t stop_requested;

static void request_stop(int number)
{
    (void)number;
    stop_requested = 1;
}

static void set_handlers(void (*handler)(int))
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = handler == SIG_DFL ? 0 : (int)SA_RESETHAND;
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
}

void gm_progress_begin(gm_progress *progress)
{
    progress->shown = false;
    stop_requested = 0;
    set_handlers(request_stop);
}

static void clear_line(void)
{
    fprintf(stderr, "\r%*s\r", LINE, "");
}

void gm_progress_end(gm_progress *progress)
{
    set_handlers(SIG_DFL);
    if (progress->shown)
        clear_line();
    progress->shown = false;
}

bool gm_progress_interrupted(void)
{
    return stop_requested != 0;
}

/* Resumed points took no time: rate and time left come from the others. */
static void draw(const gm_sweep_progress *state)
{
    double part = (double)state->points_done / (double)state->points_total;
    long solved = state->points_done - state->points_resumed;
    double rate = state->elapsed > 0.0 ? (double)solved / state->elapsed : 0.0;
    char bar[BAR + 1], left[32] = "";
    memset(bar, '.', BAR);
    memset(bar, '#', (size_t)(part * BAR));
    bar[BAR] = '\0';
    if (rate > 0.0)
        (void)snprintf(left, sizeof left, ", %.0f s left",
                       (double)(state->points_total - state->points_done) / rate);
    fprintf(stderr, "\r[%s] %3.0f %%  %ld of %ld points, %.0f/s%s  ", bar, 100.0 * part,
            state->points_done, state->points_total, rate, left);
    fflush(stderr);
}

int gm_progress_report(void *user, const gm_sweep_progress *state)
{
    gm_progress *progress = user;
    if (state->points_total > 0 && state->points_done <= state->points_total &&
        isatty(STDERR_FILENO)) {
        draw(state);
        progress->shown = true;
    }
    return stop_requested != 0;
}
