/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/foreign_units.h"

#include <stddef.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct known_unit {
    const char *name;
    rig_quantity of;
    double factor, offset;
} known_unit;

static const known_unit known_units[] = {
    {"rad/s", RIG_SPEED, 1.0, 0.0},
    {"rad.s-1", RIG_SPEED, 1.0, 0.0},
    {"rad/sec", RIG_SPEED, 1.0, 0.0},
    {"rpm", RIG_SPEED, PI / 30.0, 0.0},
    {"1/min", RIG_SPEED, PI / 30.0, 0.0},
    {"r/min", RIG_SPEED, PI / 30.0, 0.0},
    {"rev/min", RIG_SPEED, PI / 30.0, 0.0},
    {"deg/s", RIG_SPEED, PI / 180.0, 0.0},
    {"krpm", RIG_SPEED, PI / 0.03, 0.0},
    {"Hz", RIG_SPEED, 2.0 * PI, 0.0},
    {"rev/s", RIG_SPEED, 2.0 * PI, 0.0},
    {"N.m", RIG_TORQUE, 1.0, 0.0},
    {"Nm", RIG_TORQUE, 1.0, 0.0},
    {"N*m", RIG_TORQUE, 1.0, 0.0},
    {"N m", RIG_TORQUE, 1.0, 0.0},
    {"J/rad", RIG_TORQUE, 1.0, 0.0},
    {"kN.m", RIG_TORQUE, 1e3, 0.0},
    {"kNm", RIG_TORQUE, 1e3, 0.0},
    {"N.mm", RIG_TORQUE, 1e-3, 0.0},
    {"Nmm", RIG_TORQUE, 1e-3, 0.0},
    {"mN.m", RIG_TORQUE, 1e-3, 0.0},
    {"mNm", RIG_TORQUE, 1e-3, 0.0},
    {"lbf.ft", RIG_TORQUE, 1.3558179483314004, 0.0},
    {"K", RIG_TEMPERATURE, 1.0, 0.0},
    {"degC", RIG_TEMPERATURE, 1.0, 273.15},
    {"C", RIG_TEMPERATURE, 1.0, 273.15},
    {"degF", RIG_TEMPERATURE, 5.0 / 9.0, 255.3722222222222},
    {"rad", RIG_ANGLE, 1.0, 0.0},
    {"deg", RIG_ANGLE, PI / 180.0, 0.0},
    {"rev", RIG_ANGLE, 2.0 * PI, 0.0},
    {"1", RIG_NONE, 1.0, 0.0},
};

static const known_unit *find_known(const char *name)
{
    for (size_t i = 0; i < sizeof known_units / sizeof known_units[0]; i++)
        if (strcmp(known_units[i].name, name) == 0)
            return &known_units[i];
    return NULL;
}

int gm_foreign_unit(const fmu_description *d, const char *name, double *factor,
                    double *offset)
{
    const fmu_unit *declared = gm_fmu_description_unit(d, name);
    const known_unit *known = declared ? NULL : find_known(name);
    if (!declared && !known)
        return 0;
    *factor = declared ? declared->factor : known->factor;
    *offset = declared ? declared->offset : known->offset;
    return 1;
}

static rig_quantity by_exponents(const fmu_unit *u)
{
    if (u->others)
        return RIG_NONE;
    if (u->kg == 1 && u->m == 2 && u->s == -2 && u->kelvin == 0)
        return RIG_TORQUE;
    if (u->kg != 0 || u->m != 0)
        return RIG_NONE;
    if (u->s == -1 && u->kelvin == 0)
        return RIG_SPEED;
    if (u->s == 0 && u->kelvin == 1 && u->rad == 0)
        return RIG_TEMPERATURE;
    return u->s == 0 && u->kelvin == 0 && u->rad == 1 ? RIG_ANGLE : RIG_NONE;
}

rig_quantity gm_foreign_quantity(const fmu_description *d, const char *name)
{
    const fmu_unit *declared = gm_fmu_description_unit(d, name);
    rig_quantity found = declared ? by_exponents(declared) : RIG_NONE;
    const known_unit *known = find_known(name);
    return found == RIG_NONE && known ? known->of : found;
}
