/* SPDX-License-Identifier: BSD-2-Clause
 *
 * documentation/index.html of an FMU: what it is, its variables, its range, its origin.
 */
#ifndef DOCUMENTATION_H
#define DOCUMENTATION_H

#include "bake/buffer.h"
#include "map/gm_map.h"

/** Append the whole page. Memory failures are in buffer->failed. */
void gm_documentation_write(const gm_map *map, const char *guid, gm_buffer *buffer);

#endif
