/* SPDX-License-Identifier: BSD-2-Clause
 *
 * model.png of an FMU: the efficiency of every gear over speed (to the right) and torque
 * (up, as the square root, since low torque is where efficiency changes) of its input
 * flange, driving forward; one field per gear.
 */
#ifndef PICTURE_H
#define PICTURE_H

#include "bake/buffer.h"
#include "map/gm_map.h"

/** Efficiencies at the two ends of the scale; what lies outside takes the colour of the
 *  end. */
#define GM_PICTURE_LOW 0.90
#define GM_PICTURE_HIGH 0.99

/** Append the PNG file. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_picture_write(const gm_map *map, const gm_reduced_map *reduced,
                                        gm_buffer *buffer, gm_error *error);

/** Efficiency of gear g of path p at w [rad/s] and torque tau [N.m] > 0 at its flange,
 *  driving in its own forward direction of the output, the other path at rest in neutral;
 *  at most 1, at least 0. */
double gm_picture_efficiency(const gm_reduced_map *reduced, int p, int g, double w,
                             double tau);

/** Colour of an efficiency, 0 .. 255 each: red, green, blue. */
void gm_picture_colour(double efficiency, unsigned char rgb[3]);

#endif
