/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An opened foreign FMU as its files share it.
 */
#ifndef FOREIGN_PARTS_H
#define FOREIGN_PARTS_H

#include "plant/fmi_instance.h"
#include "plant/fmu_archive.h"
#include "plant/gm_foreign.h"
#include "plant/gm_plugin_rig.h"

/** A variable of the FMU with its conversion: SI = sign (factor value + offset). */
typedef struct foreign_variable {
    const fmu_variable *is; /* NULL: not mapped */
    double factor, offset, sign;
} foreign_variable;

typedef struct foreign_flange {
    foreign_variable torque, speed, angle;
} foreign_flange;

typedef struct foreign_parameter {
    const fmu_variable *is;
    double value;
} foreign_parameter;

struct gm_foreign {
    const gm_rig_file *file;
    gm_plugin_rig *plugin; /* NULL: it is an FMU */
    const char **names;    /* of the plug-in's parameters */
    double *values;
    char folder[FMU_FOLDER_SIZE]; /* empty while nothing is unpacked */
    fmu_description description;
    fmi_mode mode;
    foreign_flange flange[GM_MAX_FLANGES];
    foreign_variable gear[GM_MAX_INPUT_PATHS], oil;
    foreign_parameter *parameters; /* [file->n_parameters] */
    gm_rig rig;                    /* Co-Simulation; both point back here */
    gm_continuous continuous;      /* Model Exchange */
};

/** Resolve all variables of the rig file. GM_ERR_FORMAT. */
GM_NODISCARD gm_status gm_foreign_map(gm_foreign *foreign, gm_error *error);

/** What both interfaces share: parameters before the start, all inputs, what is seen. */
GM_NODISCARD gm_status gm_foreign_begin(const gm_foreign *foreign, fmi_instance *it,
                                        const gm_rig_command *command, gm_error *error);
/** angle: of flanges that take speed, rad. */
GM_NODISCARD gm_status gm_foreign_put(const gm_foreign *foreign, fmi_instance *it,
                                      const gm_rig_command *command, const double *angle,
                                      gm_error *error);
GM_NODISCARD gm_status gm_foreign_view(const gm_foreign *foreign, fmi_instance *it,
                                       const gm_rig_command *command, gm_rig_view *view,
                                       gm_error *error);

extern const gm_rig_class gm_foreign_rig_class;
extern const gm_continuous_class gm_foreign_continuous_class;

#endif
