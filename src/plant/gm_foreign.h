/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The model that a rig file names, opened: an FMU unpacked into a temporary folder with
 * its variables resolved, or a plug-in. Nothing of an FMU runs here; its library is
 * loaded by the runs, in processes of their own.
 */
#ifndef GM_FOREIGN_H
#define GM_FOREIGN_H

#include "plant/gm_continuous.h"
#include "plant/gm_rig_file.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_foreign gm_foreign;

/** The file must outlive it. GM_ERR_FORMAT: the FMU is malformed, or a variable is
 *  missing or has an unknown unit; errors of gm_plugin_rig_open. */
GM_NODISCARD gm_status gm_foreign_open(const gm_rig_file *file, gm_foreign **foreign,
                                       gm_error *error);
/** Removes the temporary folder. */
void gm_foreign_close(gm_foreign *foreign);

/** The model as a rig, or NULL where it is in Model Exchange and needs a solver. */
const gm_rig *gm_foreign_rig(const gm_foreign *foreign);
const gm_continuous *gm_foreign_continuous(const gm_foreign *foreign);

#ifdef __cplusplus
}
#endif
#endif
