/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The gearset that this component is made for: the only file that reads the generated
 * tables.
 */
#ifndef GM_MODEL_H
#define GM_MODEL_H

#include "gm_reduced.h"

/** The tables; constant. */
const gm_reduced_map *gm_model_map(void);

/** Hash of interface and tables that instantiation must present. */
const char *gm_model_guid(void);

/** Name of path p, 0 <= p < n_paths: "input", or "odd" and "even". */
const char *gm_model_path_name(int p);

#endif
