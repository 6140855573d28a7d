/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inputs of the toys: constant torques and speed slopes that may change once.
 */
#ifndef TOY_DRIVE_H
#define TOY_DRIVE_H

#include "solve/gm_driven.h"

typedef struct toy_drive {
    double change; /* s; infinite: never */
    gm_drive_point before, after;
    double slope[2]; /* torque at flange f: torque + slope * t */
    int present;     /* 1: after the change */
} toy_drive;

gm_drive toy_drive_calls(toy_drive *d);

#endif
