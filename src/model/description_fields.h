/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From the tree of a file to the fields of a structure, led by a schema.
 */
#ifndef DESCRIPTION_FIELDS_H
#define DESCRIPTION_FIELDS_H

#include "model/description_yaml.h"
#include "model/schema.h"

/** Fill the structure at base, that of the schema's root, from the tree; it is zeroed
 *  but for what no field names. file: for messages. What is allocated belongs to it, also
 *  after an error. GM_ERR_FORMAT with a sentence, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_fields_read(const char *file, const gm_section *root,
                                      const gm_yaml *tree, void *base, gm_error *error);

#endif
