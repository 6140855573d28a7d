/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From the tree of a file to the fields of a description, led by the schema.
 */
#ifndef DESCRIPTION_FIELDS_H
#define DESCRIPTION_FIELDS_H

#include "model/description_yaml.h"
#include "model/gm_description.h"

/** Fill *d (zeroed but for its file name) from the tree. What is allocated belongs to *d,
 *  also after an error. GM_ERR_FORMAT with a sentence, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_description_fields(gm_description *d, const gm_yaml *tree,
                                             gm_error *error);

#endif
