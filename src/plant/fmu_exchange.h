/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The Model Exchange part of a modelDescription.xml, and what its reading shares with the
 * rest of the file.
 */
#ifndef FMU_EXCHANGE_H
#define FMU_EXCHANGE_H

#include "plant/fmu_description.h"

#include <stdbool.h>

typedef struct _xmlNode xmlNode; /* of libxml2 */

/** States with their rates and dependencies, indicators, capabilities; nothing when the
 *  FMU has no Model Exchange. GM_ERR_FORMAT, GM_ERR_MEMORY; what was made stays in *d. */
GM_NODISCARD gm_status gm_fmu_exchange_read(xmlNode *root, const char *archive,
                                            fmu_description *d, gm_error *error);

/** First child element of that name, or NULL. */
xmlNode *gm_fmu_child(const xmlNode *parent, const char *name);

/** Copy of an attribute's value; NULL when it is missing or there is no memory. */
char *gm_fmu_attribute(xmlNode *node, const char *name);

/** The same, told apart: GM_OK with *value NULL when it is missing, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_fmu_optional(xmlNode *node, const char *name,
                                       const char *archive, char **value,
                                       gm_error *error);

/** An attribute as a number; `otherwise` when it is missing, no number, or node NULL. */
double gm_fmu_number(xmlNode *node, const char *name, double otherwise);

/** A whole number that fits an unsigned. */
bool gm_fmu_read_reference(const char *text, unsigned *reference);

/** Letters, digits and _ only: the identifier becomes part of a path. */
bool gm_fmu_is_identifier(const char *text);

#endif
