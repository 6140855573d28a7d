/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Streams of the C library under names that are the library's own.
 */
#ifndef STANDARD_STREAMS_H
#define STANDARD_STREAMS_H

#include <stdio.h>

/** Set when the library is loaded. */
extern FILE *gm_stream_stdin, *gm_stream_stdout, *gm_stream_stderr;

#endif
