/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A growing text. A failed allocation is remembered, so that a writer of many lines
 * checks once, at its end. Numbers do not depend on the locale.
 */
#ifndef BUFFER_H
#define BUFFER_H

#include "base/gm_status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct gm_buffer {
    char *data; /* [size] and a terminating zero; NULL while empty */
    size_t size, room;
    bool failed; /* memory ran out: the text is not complete */
} gm_buffer;

#define GM_NUMBER_TEXT 40

/** Append n bytes. */
void gm_buffer_bytes(gm_buffer *buffer, const void *bytes, size_t n);

/** Append a text; at most 1000 characters. Real numbers go through gm_buffer_number. */
GM_PRINTF(2, 3)
void gm_buffer_text(gm_buffer *buffer, const char *format, ...);

/** Append a number so that reading it gives the same bits (%.17g). */
void gm_buffer_number(gm_buffer *buffer, double value);

/** Free the text. */
void gm_buffer_clear(gm_buffer *buffer);

/** The number as gm_buffer_number writes it, with `digits` digits; returns text. */
const char *gm_number_text(double value, int digits, char text[GM_NUMBER_TEXT]);

#endif
