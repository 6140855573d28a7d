/* SPDX-License-Identifier: BSD-2-Clause
 *
 * documentation/index.html of an FMU: what it is, how to use it, its variables, its
 * range, how accurate it is and how it was made. One page that needs nothing but the
 * picture beside modelDescription.xml.
 */
#ifndef DOCUMENTATION_H
#define DOCUMENTATION_H

#include "bake/passport.h"

typedef struct gm_document {
    const gm_map *map;
    const char *guid;
    int monotone; /* interpolation */
    gm_speed_in speed_in;
    const gm_passport *passport;
} gm_document;

/** Append the whole page. Memory failures are in buffer->failed. */
void gm_documentation_write(const gm_document *document, gm_buffer *buffer);

#endif
