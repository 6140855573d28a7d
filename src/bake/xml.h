/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Writing modelDescription.xml: elements and attributes over libxml2's writer. A failure
 * (out of memory) is remembered and told once at the end.
 */
#ifndef XML_H
#define XML_H

#include "bake/variables.h"

typedef struct xml {
    void *writer; /* xmlTextWriter */
    bool failed;  /* one of its calls did */
    const gm_map *map;
    gm_speed_in speed_in;
    int first_gear[GM_MAX_PATHS]; /* at the start: neutral, or the only gear of a path
                                     that has no neutral */
    int n;
    scalar all[2 * N_VARIABLES]; /* [n] */
} xml;

/** Begin an element; end the innermost one. */
void gm_xml_start(xml *x, const char *element);
void gm_xml_end(xml *x);

/** Attribute of the innermost element. */
void gm_xml_text(xml *x, const char *name, const char *value);

/** The same for a text of the map, which may hold what XML cannot. */
void gm_xml_foreign_text(xml *x, const char *name, const char *value);

void gm_xml_integer(xml *x, const char *name, long value);

/** The shortest of 15, 16 or 17 digits that reads back as the same number. */
void gm_xml_number(xml *x, const char *name, double value);

#endif
