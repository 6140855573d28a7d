/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/team.h"

#include <stddef.h>
#include <unistd.h>

#define MOST 1024

typedef struct task {
    void (*share)(void *user);
    void *user;
} task;

static void *start(void *given)
{
    const task *t = given;
    t->share(t->user);
    return NULL;
}

int gm_team_all(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > MOST ? MOST : (int)n;
}

void gm_team_run(int threads, void (*share)(void *user), void *user)
{
    pthread_t other[MOST];
    task t = {share, user};
    int n = 0;
    while (n + 1 < threads && n < MOST && pthread_create(&other[n], NULL, start, &t) == 0)
        n++;
    share(user);
    for (int i = 0; i < n; i++)
        (void)pthread_join(other[i], NULL);
}
