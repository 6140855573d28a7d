/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Small planetary gearsets as descriptions: spur gears of module 2 mm, all shafts on one
 * axis, each on two bearings.
 */
#ifndef PLANETARY_FIXTURE_H
#define PLANETARY_FIXTURE_H

#include "model/gm_description.h"

#include <stddef.h>

/** A description that is being written. */
typedef struct planetary_text {
    char *text; /* of size `size` */
    size_t size, used;
    double efficiency; /* of every mesh; 0: temperature dependent */
    int friction;      /* 1: bearings and planets have friction */
    char meshes[4096]; /* that section so far */
} planetary_text;

void planetary_begin(planetary_text *t, char *text, size_t size);

/** The section of shafts; names ended by NULL. */
void planetary_shafts(planetary_text *t, const char *const *names);

/** The gears section begins. */
void planetary_gears(planetary_text *t);

/** A sun, a ring or both with one kind of planets between them; names begin with
 *  `name`. z_ring - z_sun must be even, their sum a multiple of the planets' number. */
typedef struct planetary_set {
    const char *name, *sun, *carrier, *ring;
    int z_sun, z_ring, planets;
    double position; /* mm */
} planetary_set;
void planetary_add_set(planetary_text *t, const planetary_set *set);

/** Any other gear or mesh, as it stands in the file. */
void planetary_add(planetary_text *t, const char *line);
void planetary_add_mesh(planetary_text *t, const char *name, const char *a,
                        const char *b);

/** Meshes and bearings; then the rest: clutches, paths and output. */
void planetary_end(planetary_text *t, const char *const *names, const char *rest);

/** Write to a file and read it; fails the test on an error. */
gm_description *planetary_read(const planetary_text *t, const char *file);

#endif
