/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Units of foreign FMUs: what the modelDescription declares, else spellings that people
 * use. SI value = factor * value + offset.
 */
#ifndef FOREIGN_UNITS_H
#define FOREIGN_UNITS_H

#include "plant/fmu_description.h"

typedef enum rig_quantity {
    RIG_NONE,
    RIG_TORQUE,
    RIG_SPEED,
    RIG_ANGLE,
    RIG_TEMPERATURE
} rig_quantity;

/** 1 and the conversion of a unit that the FMU declares or that is known, else 0. */
int gm_foreign_unit(const fmu_description *d, const char *name, double *factor,
                    double *offset);

/** What has this unit; RIG_NONE: something else, or it is not known. A torque may be an
 *  energy too. */
rig_quantity gm_foreign_quantity(const fmu_description *d, const char *name);

#endif
