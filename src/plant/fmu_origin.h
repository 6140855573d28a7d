/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The annotation that components of this program have in their modelDescription.xml: what
 * they were made from, how far they go, and their gears.
 */
#ifndef FMU_ORIGIN_H
#define FMU_ORIGIN_H

#include "plant/fmu_description.h"

typedef struct _xmlNode xmlNode; /* of libxml2 */

/** Read it where it is; all unknown in an FMU of another program. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_fmu_origin_read(xmlNode *root, const char *archive,
                                          fmu_description *d, gm_error *error);

#endif
