/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the two halves of the field reader share: sections (description_fields.c)
 * and single values (description_values.c).
 */
#ifndef DESCRIPTION_VALUES_H
#define DESCRIPTION_VALUES_H

#include "model/description_yaml.h"
#include "model/gm_description.h"
#include "model/schema.h"

enum { GM_ELEMENT_SIZE = 192 };

typedef struct gm_field_reader {
    const char *file;
    const gm_section *root; /* whose collections references name */
    char *base;             /* structure of the root */
    gm_error *error;
} gm_field_reader;

/* A section of the file and where it goes. */
typedef struct gm_place {
    const gm_section *section;
    const gm_yaml *node; /* NULL: absent, defaults only */
    char *base;
    int line;
    char element[GM_ELEMENT_SIZE];
} gm_place;

/* One value of it. */
typedef struct gm_slot {
    const gm_place *in;
    const gm_field *field;
    const gm_yaml *node;
    char *target;
} gm_slot;

/** Where the int that counts the slot's entries stands: in the structure whose field it
 *  is, which for an inline section begins inside another. */
static inline char *gm_slot_count(const gm_slot *s)
{
    return s->target - s->field->offset + s->field->count_offset;
}

/** Read a value that is neither a group nor items. GM_ERR_FORMAT with what it must be and
 *  what was found, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_slot_read(const gm_field_reader *r, const gm_slot *s);

/** That failure for any field; hint is added at the end, such as "; did you mean ...?".
 */
gm_status gm_slot_wrong(const gm_field_reader *r, const gm_slot *s, const char *hint);

#endif
