/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Mass and moment of inertia of solids of revolution (elementary mechanics).
 */
#include "model/inertia.h"

#include "model/power.h"

double gm_cylinder_inertia(double rho, double b, double d, double d_i)
{
    double outer = d * d * d * d, inner = d_i * d_i * d_i * d_i;
    return GM_PI / 32. * rho * b * (outer - inner);
}

double gm_cylinder_mass(double rho, double b, double d, double d_i)
{
    return GM_PI / 4. * rho * b * (d * d - d_i * d_i);
}
