/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How the tables of the description file are written, and the sections that one table
 * names in another. For schema*.c only.
 *
 * A new field is one line of a table and one member of the structure in gm_description.h.
 * Ranges are wide: they catch a wrong unit or a slip of the keyboard; whether parts fit
 * together is looked at in check.c.
 */
#ifndef SCHEMA_FIELDS_H
#define SCHEMA_FIELDS_H

#include "model/schema.h"

/* Shorthand. AT: offset of a member of the section's structure, OWNER. */
#define AT(member) .offset = offsetof(OWNER, member)
#define NUMBER(name, lo, hi) .key = name, .type = GM_FIELD_NUMBER, .low = lo, .high = hi
#define INTEGER(name, lo, hi) .key = name, .type = GM_FIELD_INTEGER, .low = lo, .high = hi
#define ABOVE .open = GM_OPEN_LOW
#define DEFAULT(text) .need = GM_NEED_DEFAULT, .fallback = text
#define OPTIONAL .need = GM_NEED_NOTHING
#define ONLY(key, word) .only_key = key, .only_word = word
#define END                                                                              \
    {                                                                                    \
        .key = NULL                                                                      \
    }

extern const gm_section gm_schema_limit, gm_schema_oil;                 /* schema_oil.c */
extern const gm_section gm_schema_shaft, gm_schema_seal, gm_schema_gap; /* _shafts.c */
extern const gm_section gm_schema_jet;                                  /* _gears.c */
extern const gm_section gm_schema_bearing_data, gm_schema_bearing;      /* _bearings.c */
extern const gm_section gm_schema_gear, gm_schema_mesh;                 /* _gears.c */
extern const gm_section gm_schema_flanks, gm_schema_dogs;               /* _flanks.c */
extern const gm_section gm_schema_synchroniser, gm_schema_clutch;       /* _paths.c */
extern const gm_section gm_schema_path;

#endif
