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

void gm_progress_show(gm_progress *progress, double part, const char *words)
{
    char bar[BAR + 1];
    if (!isatty(STDERR_FILENO) || !(part >= 0.0 && part <= 1.0))
        return;
    memset(bar, '.', BAR);
    memset(bar, '#', (size_t)(part * BAR));
    bar[BAR] = '\0';
    fprintf(stderr, "\r[%s] %3.0f %%  %s  ", bar, 100.0 * part, words);
    fflush(stderr);
    progress->shown = true;
}

/* Resumed points took no time: rate and time left come from the others. */
int gm_progress_report(void *user, const gm_sweep_progress *state)
{
    long solved = state->points_done - state->points_resumed;
    double rate = state->elapsed > 0.0 ? (double)solved / state->elapsed : 0.0;
    double left = (double)(state->points_total - state->points_done);
    char words[96], rest[32] = "";
    if (rate > 0.0)
        (void)snprintf(rest, sizeof rest, ", %.0f s left", left / rate);
    (void)snprintf(words, sizeof words, "%ld of %ld points, %.0f/s%s", state->points_done,
                   state->points_total, rate, rest);
    if (state->points_total > 0)
        gm_progress_show(user, (double)state->points_done / (double)state->points_total,
                         words);
    return stop_requested != 0;
}
