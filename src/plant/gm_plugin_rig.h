/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A compiled model (gm_plugin.h) as a rig.
 */
#ifndef GM_PLUGIN_RIG_H
#define GM_PLUGIN_RIG_H

#include "plant/gm_rig.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_plugin_rig gm_plugin_rig;

/** What the model is told beside its inputs. The texts must outlive the rig. */
typedef struct gm_plugin_settings {
    double oil_temperature; /* K */
    int n_parameters;
    const char *const *names; /* [n_parameters] */
    const double *values;
    double step; /* s; 0: the model's, or 1 ms */
} gm_plugin_settings;

/** Load the library at path. GM_ERR_TOOL: it cannot be loaded; GM_ERR_FORMAT: it is no
 *  plug-in of this version, or describes itself wrongly. */
GM_NODISCARD gm_status gm_plugin_rig_open(const char *path,
                                          const gm_plugin_settings *settings,
                                          gm_plugin_rig **plugin, gm_error *error);
void gm_plugin_rig_close(gm_plugin_rig *plugin);

/** The plug-in must outlive the rig. */
const gm_rig *gm_plugin_rig_interface(const gm_plugin_rig *plugin);

#ifdef __cplusplus
}
#endif
#endif
