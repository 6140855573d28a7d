/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A fork with a pair of connected sockets. The child closes every other file of its
 * parent, has no standard output to disturb, and ends with the socket: when the parent
 * goes, or by an alarm a while after the parent has lost patience.
 */
#include "plant/child.h"

#include "base/alloc.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST_FILES = 4096 };

struct gm_child {
    gm_child_work work;
    double time_limit;
    pid_t pid; /* 0: there is none */
    int socket;
    void *request; /* [sizeof begins a message] */
};

/* What goes back, before the reply itself. */
typedef struct answer {
    gm_status status;
    gm_error error;
} answer;

/* ---- in the child ---- */

static int read_all(int file, void *bytes, size_t size)
{
    char *at = bytes;
    while (size > 0) {
        ssize_t n = read(file, at, size);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return 0;
        at += n;
        size -= (size_t)n;
    }
    return 1;
}

static int write_all(int file, const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        ssize_t n = send(file, at, size, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return 0;
        at += n;
        size -= (size_t)n;
    }
    return 1;
}

static void leave_parent(int socket)
{
    struct rlimit none = {0, 0};
    int nothing = open("/dev/null", O_RDWR);
    for (int file = 0; file <= 2 && nothing >= 0; file++)
        (void)dup2(nothing, file);
    for (int file = 3; file < MOST_FILES; file++)
        if (file != socket)
            (void)close(file);
    (void)setrlimit(RLIMIT_CORE, &none);
    static const int deadly[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t i = 0; i < sizeof deadly / sizeof deadly[0]; i++)
        (void)signal(deadly[i], SIG_DFL); /* whatever a sanitizer made of them */
    (void)signal(SIGINT, SIG_IGN);
    (void)signal(SIGTERM, SIG_DFL);
    (void)signal(SIGALRM, SIG_DFL);
}

static void serve_all(const gm_child *c, int socket)
{
    void *state = NULL, *reply = gm_calloc(1, c->work.reply_size);
    answer answered = {GM_OK, {GM_OK, ""}};
    unsigned patience = (unsigned)(2.0 * c->time_limit) + 2;
    int begun = 0;
    while (reply && read_all(socket, c->request, c->work.request_size)) {
        (void)alarm(patience);
        answered = (answer){GM_OK, {GM_OK, ""}};
        memset(reply, 0, c->work.reply_size);
        if (!begun)
            answered.status = c->work.create(c->work.context, &state, &answered.error);
        begun |= answered.status == GM_OK;
        if (begun)
            answered.status = c->work.serve(state, c->request, reply, &answered.error);
        (void)alarm(0);
        if (!write_all(socket, &answered, sizeof answered) ||
            !write_all(socket, reply, c->work.reply_size))
            break;
    }
    (void)alarm(patience);
    if (begun)
        c->work.destroy(state);
}

/* ---- in the parent ---- */

gm_status gm_child_create(const gm_child_work *work, double time_limit, gm_child **child,
                          gm_error *error)
{
    gm_child *c = gm_calloc(1, sizeof *c);
    if (c)
        c->request = gm_calloc(1, work->request_size);
    if (!c || !c->request) {
        gm_free(c);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    c->work = *work;
    c->time_limit = time_limit;
    *child = c;
    return GM_OK;
}

/* End the process; returns how it had ended. */
static int stop(gm_child *c, int kill_it)
{
    int how = 0;
    if (c->pid == 0)
        return 0;
    if (kill_it)
        (void)kill(c->pid, SIGKILL);
    (void)close(c->socket);
    while (waitpid(c->pid, &how, 0) < 0 && errno == EINTR)
        continue;
    c->pid = 0;
    return how;
}

void gm_child_destroy(gm_child *child)
{
    if (!child)
        return;
    (void)stop(child, 0);
    gm_free(child->request);
    gm_free(child);
}

/* One at a time: no other child may inherit the child's end of a socket. */
static pthread_mutex_t beginning = PTHREAD_MUTEX_INITIALIZER;

static gm_status begin(gm_child *c, gm_error *error)
{
    int ends[2];
    pid_t pid;
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
        return gm_fail(error, GM_ERR_TOOL, "no process can be started: %s",
                       strerror(errno));
    pid = fork();
    if (pid == 0) {
        leave_parent(ends[1]);
        serve_all(c, ends[1]);
        _exit(0);
    }
    (void)close(ends[1]);
    if (pid < 0) {
        (void)close(ends[0]);
        return gm_fail(error, GM_ERR_TOOL, "no process can be started: %s",
                       strerror(errno));
    }
    c->pid = pid;
    c->socket = ends[0];
    return GM_OK;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef enum outcome { ANSWERED, SILENT, GONE } outcome;

/* Read until the deadline. */
static outcome receive(const gm_child *c, void *bytes, size_t size, double deadline)
{
    char *at = bytes;
    while (size > 0) {
        double left = deadline - now();
        struct pollfd wait = {.fd = c->socket, .events = POLLIN};
        int ready = left > 0.0 ? poll(&wait, 1, 1 + (int)(1e3 * left)) : 0;
        if (ready == 0)
            return SILENT;
        ssize_t n = ready > 0 ? read(c->socket, at, size) : -1;
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return GONE;
        at += n;
        size -= (size_t)n;
    }
    return ANSWERED;
}

static gm_status say_gone(int how, gm_error *error)
{
    if (WIFSIGNALED(how))
        return gm_fail(error, GM_ERR_TOOL, "the model crashed (%s)",
                       strsignal(WTERMSIG(how)));
    return gm_fail(error, GM_ERR_TOOL, "the model ended its process with exit code %d",
                   WIFEXITED(how) ? WEXITSTATUS(how) : -1);
}

gm_status gm_child_call(gm_child *child, const void *request, void *reply,
                        gm_error *error)
{
    answer answered;
    double deadline = now() + child->time_limit;
    gm_status status = GM_OK;
    if (child->pid == 0) {
        (void)pthread_mutex_lock(&beginning);
        status = begin(child, error);
        (void)pthread_mutex_unlock(&beginning);
    }
    if (status != GM_OK)
        return status;
    outcome got =
        write_all(child->socket, request, child->work.request_size) ? ANSWERED : GONE;
    if (got == ANSWERED)
        got = receive(child, &answered, sizeof answered, deadline);
    if (got == ANSWERED)
        got = receive(child, reply, child->work.reply_size, deadline);
    if (got == GONE)
        return say_gone(stop(child, 1), error);
    if (got == SILENT) {
        (void)stop(child, 1);
        return gm_fail(error, GM_ERR_TOOL,
                       "the model did not answer within %g s and was ended",
                       child->time_limit);
    }
    if (answered.status != GM_OK && error)
        *error = answered.error;
    return answered.status;
}
