/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The two files of an FMU that tell what was measured on it: its passport and its page.
 */
#ifndef PAPERS_H
#define PAPERS_H

#include "bake/passport.h"

#define GM_PASSPORT "extra/gearmap/passport.json"
#define GM_DOCUMENTATION "documentation/index.html"

typedef struct gm_papers {
    gm_buffer passport, page; /* failed: no memory */
} gm_papers;

/** Of the component that the summary tells of; both are the caller's to clear. */
gm_papers gm_papers_write(const gm_map *map, const gm_bake_summary *summary,
                          const gm_passport *passport);

#endif
