/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A map keeps the text of the description that it was made from.
 */
#ifndef KEEP_DESCRIPTION_H
#define KEEP_DESCRIPTION_H

#include "model/gm_description.h"

/** Put the text of the description's file into the map's file. When the file has changed
 *  since it was read, it is not what the map was made from: a note on the standard error,
 *  and the map is left without it. GM_ERR_IO, GM_ERR_FORMAT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_keep_description(const gm_description *description,
                                           const char *map, gm_error *error);

#endif
