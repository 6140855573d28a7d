/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The place of a file that is being made: a file beside it is taken at the beginning, so
 * that an output that cannot be written is refused before the work, and renamed at the
 * end. Also the names that generated things get.
 */
#ifndef PLACE_H
#define PLACE_H

#include "bake/package.h"

#include <sys/types.h>

typedef struct gm_place {
    const char *target;
    char part[4096];
    mode_t rights; /* of a new file */
    bool reserved; /* the part exists */
} gm_place;

/** Take the place of the file target, which has to outlive it. GM_ERR_IO. */
GM_NODISCARD gm_status gm_place_reserve(const char *target, gm_place *place,
                                        gm_error *error);

/** Write the archive and give it its name. GM_ERR_IO. */
GM_NODISCARD gm_status gm_place_put(gm_place *place, const gm_package *package,
                                    gm_error *error);

/** Leave nothing behind where nothing was put. */
void gm_place_release(gm_place *place);

#define GM_IDENTIFIER_SIZE 64
/** A C identifier from any name: letters, digits and underscores. */
void gm_make_identifier(const char *name, char identifier[GM_IDENTIFIER_SIZE]);

/** A letter, digit or underscore of ASCII. */
bool gm_is_word(char c);

#endif
