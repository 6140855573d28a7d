/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Pictures as PNG files (W3C PNG specification, third edition): 8 bits of palette index a
 * pixel, in stored blocks of deflate (RFC 1950, 1951). Archives compress them anyway, and
 * no library for pictures is needed.
 */
#ifndef PNG_H
#define PNG_H

#include "bake/buffer.h"

typedef struct gm_picture {
    int width, height;
    unsigned char *pixel;         /* [height][width] indices into the palette */
    int n_colours;                /* 1 .. 256 */
    unsigned char colour[256][3]; /* red, green, blue */
    int clear;                    /* index that is transparent */
} gm_picture;

/** Append the file. Memory failures are in buffer->failed. */
void gm_png_write(const gm_picture *picture, gm_buffer *buffer);

#endif
