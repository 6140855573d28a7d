/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Work in a process of its own: what crashes or hangs there is an error here. Requests
 * and replies are structures of fixed size.
 */
#ifndef CHILD_H
#define CHILD_H

#include "base/gm_status.h"

#include <stddef.h>

/** What the process does; the calls run in it. */
typedef struct gm_child_work {
    const void *context; /* as it is when the process begins */
    gm_status (*create)(const void *context, void **state, gm_error *error);
    void (*destroy)(void *state);
    gm_status (*serve)(void *state, const void *request, void *reply, gm_error *error);
    size_t request_size, reply_size;
} gm_child_work;

typedef struct gm_child gm_child;

/** time_limit [s]: of one request. The process begins with the first request. The work is
 *  copied, its context must outlive the child. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_child_create(const gm_child_work *work, double time_limit,
                                       gm_child **child, gm_error *error);
void gm_child_destroy(gm_child *child);

/** Have a request served. Errors of the work; GM_ERR_TOOL: the process crashed, or it did
 *  not answer in time and was ended. The next request begins a new one. */
GM_NODISCARD gm_status gm_child_call(gm_child *child, const void *request, void *reply,
                                     gm_error *error);

#endif
