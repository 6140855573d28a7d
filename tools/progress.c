/* SPDX-License-Identifier: BSD-2-Clause */
#include "progress.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#define BAR 12
#define LINE_SIZE 512
#define SHOWN_EVERY 0.1 /* s; a line of JSON comes half as often */

/* How progress is shown: a matter of the process, set once before any stage. */
static enum { MODE_AUTO, MODE_JSON, MODE_NONE } mode;
static gm_progress_listener listener;
static void *listener_user;

/* The one thing that a signal handler may touch. */
static volatile sig_atomic_t stop_requested;

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

bool gm_progress_choose(const char *word)
{
    static const char *const words[] = {"auto", "json", "none"};
    for (int i = 0; i < 3; i++)
        if (strcmp(word, words[i]) == 0) {
            mode = i == 0 ? MODE_AUTO : i == 1 ? MODE_JSON : MODE_NONE;
            return true;
        }
    fprintf(stderr, "gearmap: there is no progress '%s' (only auto, json, none)\n", word);
    return false;
}

void gm_progress_tell(gm_progress_listener told, void *user)
{
    mode = MODE_NONE;
    listener = told;
    listener_user = user;
}

/* ---- signals ---- */

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

bool gm_progress_interrupted(void)
{
    return stop_requested != 0;
}

/* ---- the terminal ---- */

static bool has_bar(void)
{
    return mode == MODE_AUTO && isatty(STDERR_FILENO);
}

/* Columns of the terminal; a line beyond them would not be overwritten. */
static int columns(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1)
        return size.ws_col;
    return 80;
}

/* Columns that a text takes: bytes that begin a character. */
static int width_of(const char *text)
{
    int width = 0;
    for (; *text; text++)
        width += ((unsigned char)*text & 0xc0) != 0x80;
    return width;
}

/* Cut a text to so many columns, at a whole character. */
static void cut(char *text, int width)
{
    int at = 0;
    for (; *text; text++) {
        at += ((unsigned char)*text & 0xc0) != 0x80;
        if (at > width) {
            *text = '\0';
            return;
        }
    }
}

static void draw(gm_progress *p, char *line)
{
    cut(line, columns() - 1);
    int width = width_of(line);
    fprintf(stderr, "\r%s%*s", line, p->width > width ? p->width - width : 0, "");
    fflush(stderr);
    p->width = width;
}

/* ---- lines for machines ---- */

/* A line is written whole, so that lines of several programs into one pipe do not mix. */
typedef struct json_line {
    char *text;
    size_t size;
    FILE *out; /* NULL without memory: no line then */
    gm_json json;
} json_line;

static bool begin_line(json_line *l, const gm_progress *p, const char *event)
{
    *l = (json_line){.text = NULL};
    l->out = open_memstream(&l->text, &l->size);
    if (!l->out)
        return false;
    gm_json_start_line(&l->json, l->out);
    gm_json_text(&l->json, "event", event);
    gm_json_text(&l->json, "stage", p->stage);
    gm_json_text(&l->json, "name", p->name);
    gm_json_number(&l->json, "elapsed_s", now() - p->started);
    return true;
}

static void end_line(json_line *l)
{
    gm_json_finish(&l->json);
    if (fclose(l->out) == 0)
        (void)fwrite(l->text, 1, l->size, stderr);
    free(l->text); /* the C library's own */
}

static void write_event(const gm_progress *p, const char *event)
{
    json_line l;
    if (mode == MODE_JSON && begin_line(&l, p, event))
        end_line(&l);
}

void gm_progress_line(const gm_progress *p, const char *event,
                      void (*members)(const void *data, gm_json *json), const void *data)
{
    json_line l;
    if (mode != MODE_JSON || !begin_line(&l, p, event))
        return;
    members(data, &l.json);
    end_line(&l);
}

/* ---- stages ---- */

static void draw_stage(gm_progress *p)
{
    char line[LINE_SIZE];
    (void)snprintf(line, sizeof line, "%s %s ...", p->stage, p->name ? p->name : "");
    draw(p, line);
}

void gm_progress_begin(gm_progress *p, const char *stage, const char *name)
{
    *p = (gm_progress){stage, name, now(), -1.0, (double)NAN, 0};
    stop_requested = 0;
    set_handlers(request_stop);
    if (has_bar())
        draw_stage(p);
    write_event(p, "begin");
    if (listener)
        listener(listener_user, stage, -1.0);
}

void gm_progress_end(gm_progress *p)
{
    set_handlers(SIG_DFL);
    if (p->width > 0)
        fprintf(stderr, "\r%*s\r", p->width, "");
    p->width = 0;
    write_event(p, "end");
}

/* Is it time to show something again? */
static bool is_due(gm_progress *p, double every)
{
    double t = now();
    if (p->shown_at >= 0.0 && t - p->shown_at < every)
        return false;
    p->shown_at = t;
    return true;
}

static void draw_bar(gm_progress *p, double part, const char *words)
{
    char bar[BAR + 1], line[LINE_SIZE];
    memset(bar, '.', BAR);
    memset(bar, '#', (size_t)(part * BAR));
    bar[BAR] = '\0';
    (void)snprintf(line, sizeof line, "%s%s%s [%s] %3.0f %%  %s", p->stage,
                   p->name ? " " : "", p->name ? p->name : "", bar, 100.0 * part, words);
    draw(p, line);
}

void gm_progress_show(gm_progress *p, double part, const char *words)
{
    json_line l;
    if (!(part >= 0.0 && part <= 1.0))
        return;
    if (has_bar() && is_due(p, SHOWN_EVERY))
        draw_bar(p, part, words);
    if (mode != MODE_JSON || !is_due(p, 2.0 * SHOWN_EVERY) ||
        !begin_line(&l, p, "progress"))
        return;
    gm_json_number(&l.json, "part", part);
    gm_json_text(&l.json, "words", words);
    end_line(&l);
}

/* ---- sweeps ---- */

/* Resumed points took no time: rate and time left come from the others. */
static double rate_of(const gm_sweep_progress *s)
{
    long solved = s->points_done - s->points_resumed;
    return s->elapsed > 0.0 ? (double)solved / s->elapsed : 0.0;
}

static double left_of(const gm_sweep_progress *s)
{
    double rate = rate_of(s);
    return rate > 0.0 ? (double)(s->points_total - s->points_done) / rate : (double)NAN;
}

void gm_progress_time(double seconds, char *text, int size)
{
    long s = seconds > 0.0 && seconds < 1e9 ? lround(ceil(seconds)) : 0;
    if (s < 100)
        (void)snprintf(text, (size_t)size, "%ld s", s);
    else if (s < 6000)
        (void)snprintf(text, (size_t)size, "%ld min %02ld s", s / 60, s % 60);
    else
        (void)snprintf(text, (size_t)size, "%ld h %02ld min", s / 3600, s / 60 % 60);
}

/* With axes by error the total is only what is known so far: "+". */
void gm_progress_words(const gm_sweep_progress *s, char *words, int size)
{
    char time[32], left[48] = "", worst[48] = "";
    const char *more = isnan(s->worst_error) ? "" : "+";
    gm_progress_time(left_of(s), time, sizeof time);
    if (!isnan(left_of(s)))
        (void)snprintf(left, sizeof left, ", %s%s left", time, more);
    if (!isnan(s->worst_error))
        (void)snprintf(worst, sizeof worst, ", worst error %.3g %%",
                       100.0 * s->worst_error);
    (void)snprintf(words, (size_t)size, "%ld of %ld%s points, %.0f/s%s%s", s->points_done,
                   s->points_total, more, rate_of(s), left, worst);
}

static void write_sweep_line(const gm_progress *p, const gm_sweep_progress *s)
{
    json_line l;
    if (!begin_line(&l, p, "progress"))
        return;
    gm_json_integer(&l.json, "points_done", s->points_done);
    gm_json_integer(&l.json, "points_total", s->points_total);
    gm_json_integer(&l.json, "points_resumed", s->points_resumed);
    gm_json_number(&l.json, "points_per_s", rate_of(s));
    gm_json_number(&l.json, "left_s", left_of(s));
    gm_json_number(&l.json, "worst_relative", s->worst_error);
    end_line(&l);
}

/* The worst error is that of the last round of refinement that has one. The last report
 * is always told to machines. */
int gm_progress_report(void *user, const gm_sweep_progress *state)
{
    gm_progress *p = user;
    gm_sweep_progress known = *state;
    const gm_sweep_progress *s = &known;
    char words[160];
    if (isnan(known.worst_error))
        known.worst_error = p->worst;
    p->worst = known.worst_error;
    if (s->points_total > 0 && has_bar() && is_due(p, SHOWN_EVERY)) {
        gm_progress_words(s, words, sizeof words);
        draw_bar(p, (double)s->points_done / (double)s->points_total, words);
    }
    if (listener && s->points_total > 0)
        listener(listener_user, p->stage,
                 (double)s->points_done / (double)s->points_total);
    bool last = s->points_done == s->points_total;
    if (mode == MODE_JSON && (is_due(p, 2.0 * SHOWN_EVERY) || last))
        write_sweep_line(p, s);
    return stop_requested != 0;
}
