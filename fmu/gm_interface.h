/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The interface of one gearset: which variables of the list it has, and what they are
 * for. By default torques come in at every flange and angle, speed and acceleration go
 * out. At a flange whose motion is prescribed (gm_reduced_map.prescribed) they change
 * places, as in the Modelica Standard Library's GeneralAngleToTorqueAdaptor: phi, w and a
 * are inputs, tau is an output, and there is no start value w_start. Everywhere tau is
 * the torque that acts on the gearset.
 *
 * A prescribed path acts through its spring, so fidelity starts at lash there.
 */
#ifndef GM_INTERFACE_H
#define GM_INTERFACE_H

#include "gm_reduced.h"
#include "gm_variables.h"

/* Flanges are numbered as in gm_reduced_map.prescribed: paths, then the output. */
enum { GM_OUTPUT_FLANGE = GM_MAX_PATHS, GM_FLANGES = GM_MAX_PATHS + 1 };

/** Find value reference vr; false when this gearset has no such variable. */
bool gm_interface_find(const gm_reduced_map *map, unsigned vr, gm_reference *reference);

/** Whether the variable is one that changes its place where motion is prescribed (phi, w,
 *  a, tau), and belongs to such a flange. */
bool gm_interface_is_swapped(const gm_reduced_map *map, gm_reference reference);

/** Causality and `initial` of a variable in this gearset, and its smallest value. */
gm_causality gm_interface_causality(const gm_reduced_map *map, gm_reference reference);
gm_initial gm_interface_initial(const gm_reduced_map *map, gm_reference reference);
gm_real gm_interface_min(const gm_reduced_map *map, gm_reference reference);

#endif
