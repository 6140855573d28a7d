/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The processes of a batch. Each child reduces one variant and tells its parent through a
 * pipe how far it is and what it came to; messages are smaller than what a pipe takes in
 * one piece. A variant gets one core, the last ones share what is left: sweeps scale less
 * than perfectly, and while one compiles another computes.
 */
#include "batch.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "progress.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LOOK_EVERY = 200 }; /* ms */

typedef enum message_kind { MESSAGE_STAGE, MESSAGE_DONE, MESSAGE_FAILED } message_kind;

typedef struct message {
    message_kind kind;
    char stage[16];
    double part; /* of the stage, 0 to 1; < 0: not known */
    gm_variant_outcome outcome;
} message;

/* A running child. */
typedef struct worker {
    pid_t process; /* 0: free */
    int pipe, threads;
    gm_variant *variant;
    message last;
    bool ended; /* it has told its outcome */
} worker;

typedef struct run {
    gm_batch *batch;
    const gm_reduce_settings *common;
    worker *workers; /* [batch->cores] */
    gm_progress progress;
    double started;
    int before; /* variants that were kept */
    bool stopping;
} run;

/* ---- the child ---- */

/* Without a parent nobody wants the result: the write then ends the process. */
static void tell(int pipe, const message *m)
{
    if (write(pipe, m, sizeof *m) != (ssize_t)sizeof *m)
        _exit(1);
}

static void tell_stage(void *user, const char *stage, double part)
{
    message m = {.kind = MESSAGE_STAGE, .part = part};
    (void)snprintf(m.stage, sizeof m.stage, "%s", stage);
    tell(*(const int *)user, &m);
}

static int count_missed(const gm_sweep_summary *summary)
{
    int missed = 0;
    for (int i = 0; i < GM_SYMBOLS; i++)
        missed += summary->missed[i].tables;
    return missed;
}

static gm_status reduce(const gm_reduce_settings *settings, gm_variant_outcome *outcome,
                        gm_error *error)
{
    gm_reduction r;
    gm_status status = gm_reduce(settings, &r, error);
    if (status == GM_OK) {
        *outcome = (gm_variant_outcome){
            .points = r.sweep.summary.points + r.sweep.summary.resumed,
            .elapsed = r.elapsed,
            .max_error = r.verify.result.max_relative[GM_VERIFY_SINGLE],
            .rms_error = r.verify.result.rms_relative[GM_VERIFY_SINGLE],
            .missed = count_missed(&r.sweep.summary),
            .skipped = r.sweep.summary.n_skipped + r.verify.result.n_skipped};
        status = gm_sha256_file(settings->output, outcome->fmu_sha256, error);
    }
    gm_reduction_clear(&r);
    return status;
}

/* What a single reduction would write on the standard error is in the table. */
static void work(const run *r, const gm_variant *v, int threads, int pipe)
{
    char fmu[GM_PATH_SIZE], map[GM_PATH_SIZE];
    message m = {.kind = MESSAGE_DONE};
    gm_error error = {GM_OK, ""};
    gm_reduce_settings settings = *r->common;
    int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0)
        (void)dup2(nowhere, STDERR_FILENO);
    gm_progress_tell(tell_stage, &pipe);
    settings.description = v->description;
    settings.output = fmu;
    settings.map = map;
    settings.sweep.threads = threads;
    gm_status status = gm_batch_path(r->batch, v, ".fmu", fmu, &error);
    if (status == GM_OK)
        status = gm_batch_path(r->batch, v, ".map", map, &error);
    if (status == GM_OK)
        status = reduce(&settings, &m.outcome, &error);
    if (status != GM_OK) {
        m.kind = MESSAGE_FAILED;
        (void)snprintf(m.outcome.message, sizeof m.outcome.message, "%s",
                       error.message[0] ? error.message : gm_status_text(status));
    }
    tell(pipe, &m);
}

/* ---- the parent ---- */

static gm_status start(run *r, worker *w, gm_variant *v, int threads, gm_error *error)
{
    int ends[2];
    if (pipe(ends) != 0)
        return gm_fail(error, GM_ERR_TOOL, "no pipe to a new process: %s",
                       strerror(errno));
    pid_t process = fork();
    if (process == 0) {
        (void)close(ends[0]);
        work(r, v, threads, ends[1]);
        _exit(0);
    }
    (void)close(ends[1]);
    if (process < 0) {
        (void)close(ends[0]);
        return gm_fail(error, GM_ERR_TOOL, "no new process: %s", strerror(errno));
    }
    *w = (worker){.process = process, .pipe = ends[0], .threads = threads, .variant = v};
    v->state = GM_VARIANT_RUNNING;
    return GM_OK;
}

static gm_variant *next_waiting(const gm_batch *batch, int *waiting)
{
    gm_variant *first = NULL;
    *waiting = 0;
    for (int i = 0; i < batch->n; i++)
        if (batch->variants[i].state == GM_VARIANT_WAITING) {
            first = first ? first : &batch->variants[i];
            ++*waiting;
        }
    return first;
}

static gm_status start_more(run *r, gm_error *error)
{
    int idle = r->batch->cores, waiting;
    gm_status status = GM_OK;
    for (int i = 0; i < r->batch->cores; i++)
        idle -= r->workers[i].process ? r->workers[i].threads : 0;
    for (int i = 0; i < r->batch->cores && status == GM_OK && idle > 0; i++) {
        gm_variant *v = next_waiting(r->batch, &waiting);
        if (!v || r->stopping || r->workers[i].process)
            continue;
        int threads = waiting < idle ? idle / waiting : 1;
        status = start(r, &r->workers[i], v, threads, error);
        idle -= threads;
    }
    return status;
}

static void describe_end(int ending, char text[GM_BATCH_MESSAGE])
{
    if (WIFSIGNALED(ending))
        (void)snprintf(text, GM_BATCH_MESSAGE, "its process was ended by signal %d",
                       WTERMSIG(ending));
    else
        (void)snprintf(text, GM_BATCH_MESSAGE, "its process ended with code %d",
                       WEXITSTATUS(ending));
}

static void variant_members(const void *data, gm_json *json)
{
    const gm_variant *v = data;
    gm_json_text(json, "variant", v->name);
    gm_json_text(json, "state", gm_variant_state_name(v->state));
    gm_json_number(json, "variant_elapsed_s", v->outcome.elapsed);
    if (v->state == GM_VARIANT_FAILED)
        gm_json_text(json, "message", v->outcome.message);
}

/* The pipe is empty and closed. */
static gm_status finish(run *r, worker *w, gm_error *error)
{
    int ending = 0;
    gm_variant *v = w->variant;
    (void)close(w->pipe);
    while (waitpid(w->process, &ending, 0) < 0 && errno == EINTR)
        continue;
    w->process = 0;
    if (w->ended) {
        v->outcome = w->last.outcome;
        v->state = w->last.kind == MESSAGE_DONE ? GM_VARIANT_DONE : GM_VARIANT_FAILED;
    } else {
        v->state = GM_VARIANT_FAILED;
        describe_end(ending, v->outcome.message);
    }
    bool stopped = r->stopping || gm_progress_interrupted();
    if (stopped && v->state == GM_VARIANT_FAILED) {
        v->state = GM_VARIANT_WAITING; /* it did not fail by itself */
        return GM_OK;
    }
    gm_progress_line(&r->progress, "variant", variant_members, v);
    return gm_batch_write_table(r->batch, error);
}

static gm_status listen(run *r, worker *w, gm_error *error)
{
    message m;
    ssize_t n = read(w->pipe, &m, sizeof m);
    if (n < 0 && errno == EINTR)
        return GM_OK;
    if (n != (ssize_t)sizeof m)
        return finish(r, w, error);
    w->last = m;
    w->ended = m.kind != MESSAGE_STAGE;
    return GM_OK;
}

static gm_status wait_for_news(run *r, struct pollfd *polls, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < r->batch->cores; i++)
        polls[i] = (struct pollfd){.fd = r->workers[i].process ? r->workers[i].pipe : -1,
                                   .events = POLLIN};
    if (poll(polls, (nfds_t)r->batch->cores, LOOK_EVERY) <= 0)
        return GM_OK; /* time to look around, or a signal */
    for (int i = 0; i < r->batch->cores && status == GM_OK; i++)
        if (polls[i].revents)
            status = listen(r, &r->workers[i], error);
    return status;
}

static void stop_children(run *r)
{
    r->stopping = true;
    for (int i = 0; i < r->batch->cores; i++)
        if (r->workers[i].process)
            (void)kill(r->workers[i].process, SIGTERM);
}

/* ---- what is shown ---- */

/* A sweep is most of a reduction's work, the rest a little. */
static double part_of(const worker *w)
{
    if (w->ended)
        return 1.0;
    if (strcmp(w->last.stage, "sweep") == 0)
        return 0.7 * (w->last.part > 0.0 ? w->last.part : 0.0);
    if (strcmp(w->last.stage, "bake") == 0)
        return 0.7;
    return strcmp(w->last.stage, "verify") == 0 ? 0.95 : 0.0;
}

GM_PRINTF(4, 5)
static int append(char *words, int used, int size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(words + used, (size_t)(size - used), format, arguments);
    va_end(arguments);
    return n < size - used ? used + n : size - 1;
}

static void show(run *r)
{
    char words[512], time[32];
    int counts[5] = {0}, used = 0, size = sizeof words;
    double done = 0.0, now = gm_stage_clock() - r->started;
    for (int i = 0; i < r->batch->n; i++)
        counts[r->batch->variants[i].state]++;
    int ended = counts[GM_VARIANT_DONE] + counts[GM_VARIANT_FAILED];
    int all = r->batch->n - r->before;
    done = ended;
    used = append(words, used, size, "%d of %d variants", ended + r->before, r->batch->n);
    if (counts[GM_VARIANT_FAILED] > 0)
        used = append(words, used, size, ", %d failed", counts[GM_VARIANT_FAILED]);
    for (int i = 0; i < r->batch->cores; i++)
        done += r->workers[i].process ? part_of(&r->workers[i]) : 0.0;
    gm_progress_time(now * (all - done) / done, time, sizeof time);
    if (done > 0.1)
        used = append(words, used, size, ", %s left", time);
    for (int i = 0; i < r->batch->cores; i++) {
        const worker *w = &r->workers[i];
        if (w->process)
            used = append(words, used, size, ", %s: %s", w->variant->name, w->last.stage);
        if (w->process && w->last.part >= 0.0 && w->last.stage[0])
            used = append(words, used, size, " %.0f %%", 100.0 * w->last.part);
    }
    gm_progress_show(&r->progress, all > 0 ? done / all : 1.0, words);
}

static bool is_busy(const run *r)
{
    int waiting;
    for (int i = 0; i < r->batch->cores; i++)
        if (r->workers[i].process)
            return true;
    return !r->stopping && next_waiting(r->batch, &waiting) != NULL;
}

static gm_status run_all(run *r, struct pollfd *polls, gm_error *error)
{
    gm_status status = GM_OK, first = GM_OK;
    while (is_busy(r)) {
        status = r->stopping ? GM_OK : start_more(r, error);
        if (status == GM_OK)
            status = wait_for_news(r, polls, first == GM_OK ? error : NULL);
        if (first == GM_OK)
            first = status;
        if (!r->stopping && (status != GM_OK || gm_progress_interrupted()))
            stop_children(r);
        show(r);
    }
    return first;
}

gm_status gm_batch_run(gm_batch *batch, const gm_reduce_settings *common, gm_error *error)
{
    run r = {.batch = batch, .common = common, .started = gm_stage_clock()};
    size_t n = (size_t)batch->cores;
    struct pollfd *polls = gm_calloc(n, sizeof *polls);
    r.workers = gm_calloc(n, sizeof *r.workers);
    gm_status status = GM_OK;
    if (!polls || !r.workers)
        status = gm_fail(error, GM_ERR_MEMORY, "no memory for the processes");
    for (int i = 0; i < batch->n; i++)
        r.before += batch->variants[i].state == GM_VARIANT_KEPT;
    if (status == GM_OK) {
        gm_progress_begin(&r.progress, "batch", NULL);
        status = run_all(&r, polls, error);
        bool interrupted = gm_progress_interrupted();
        gm_progress_end(&r.progress);
        if (status == GM_OK && interrupted)
            status = gm_fail(error, GM_ERR_INTERRUPTED,
                             "interrupted; finished variants and points are kept in %s, "
                             "the same command resumes",
                             batch->folder);
    }
    batch->elapsed = gm_stage_clock() - r.started;
    gm_free(polls);
    gm_free(r.workers);
    return status;
}
