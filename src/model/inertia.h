/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Mass and moment of inertia of solids of revolution.
 */
#ifndef INERTIA_H
#define INERTIA_H

/** J = pi/32 rho b (d^4 - d_i^4) [kg.m2] of a hollow cylinder; lengths in m. */
double gm_cylinder_inertia(double rho, double b, double d, double d_i);

/** m = pi/4 rho b (d^2 - d_i^2) [kg]. */
double gm_cylinder_mass(double rho, double b, double d, double d_i);

#endif
