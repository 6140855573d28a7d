/* SPDX-License-Identifier: BSD-2-Clause */
#include "toy_drive.h"

#include <math.h>

static double enter(void *user, double t, int *jump)
{
    toy_drive *d = user;
    int after = t >= d->change;
    *jump = after && !d->present;
    d->present = after;
    return after ? (double)INFINITY : d->change;
}

static void at(void *user, double t, gm_drive_point *point)
{
    const toy_drive *d = user;
    double since = d->present ? t - d->change : t;
    *point = d->present ? d->after : d->before;
    for (int f = 0; f < 2; f++) {
        point->input.torque[f] += d->slope[f] * t;
        point->speed[f] += point->acceleration[f] * since;
    }
}

gm_drive toy_drive_calls(toy_drive *d)
{
    return (gm_drive){.user = d, .enter = enter, .at = at};
}
