/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Strict text to number. strtod alone accepts "30 mm", "nan", "0x1p3" and, depending
 * on the locale, "3,5"; none of these may pass as a number in a file or on the command
 * line.
 */
#ifndef TEXT_H
#define TEXT_H

#include <stdbool.h>
#include <stddef.h>

/** True when the whole of text is a finite decimal number (such as -1.5e3). */
bool gm_text_to_double(const char *text, double *value);

/** True when the whole of text is a decimal integer that fits an int. */
bool gm_text_to_int(const char *text, int *value);

/** Like gm_text_to_double, but the number may carry the given unit ("150" or "150rpm"
 *  or "150 rpm" for unit "rpm"). */
bool gm_text_to_quantity(const char *text, const char *unit, double *value);

/** Bytes of the UTF-8 character at s (RFC 3629: no overlong forms, no surrogates), of
 *  which `left` bytes may be read; 0 when it is none. */
size_t gm_text_utf8_length(const char *s, size_t left);

/** Index of the candidate that is nearest to word by edit distance and near enough to be
 *  meant (at most a third of its length away), or -1. For "did you mean …?". */
int gm_text_nearest(const char *word, const char *const *candidates, int n);

#endif
