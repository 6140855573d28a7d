/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Several threads at one task. Who has nothing left to do sleeps: the processor belongs
 * to others that have.
 */
#ifndef TEAM_H
#define TEAM_H

#include <pthread.h>

/** Threads for as many processors as are there. */
int gm_team_all(void);

/** Run share(user) on this thread and on threads - 1 others at once; back when all have
 *  ended. Fewer take part where the system gives no more: shares take what there is to do
 *  from a common list. */
void gm_team_run(int threads, void (*share)(void *user), void *user);

#endif
