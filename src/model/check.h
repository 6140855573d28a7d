/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Do the parts of a description fit together? Each rule answers with one sentence: file,
 * line, element, rule and the numbers that disagree.
 */
#ifndef CHECK_H
#define CHECK_H

#include "model/gm_description.h"

/** GM_ERR_MODEL with the first broken rule, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_check_description(const gm_description *description,
                                            gm_error *error);

/* Parts of it, in this order. */
GM_NODISCARD gm_status gm_check_shafts(const gm_description *d, gm_error *error);
GM_NODISCARD gm_status gm_check_gears(const gm_description *d, gm_error *error);
GM_NODISCARD gm_status gm_check_paths(const gm_description *d, gm_error *error);

/* Part of the first one. */
GM_NODISCARD gm_status gm_check_thrust(const gm_description *d, gm_error *error);

/* Parts of the last one. */
GM_NODISCARD gm_status gm_check_locks(const gm_description *d, gm_error *error);
GM_NODISCARD gm_status gm_check_chains(const gm_description *d, gm_error *error);
GM_NODISCARD gm_status gm_check_motion(const gm_description *d, gm_error *error);

/** Whether meshes and what neutral locks connect a body with a flange. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_check_reached(const gm_description *d, int body, int *reached,
                                        gm_error *error);

/** A part on shaft `shaft` that another shaft or the housing holds: two shafts must be
 *  concentric. */
GM_NODISCARD gm_status gm_check_on(const gm_description *d, const char *word,
                                   const gm_label *id, int shaft, int on,
                                   gm_error *error);

/** A wheel's body: of n_shafts + n_wheels, where only idling gears are their own. */
int gm_check_body(const gm_description *d, int wheel);

/** Fail with "file:line: element: sentence". element may be empty; a long path is cut at
 *  its beginning. */
GM_PRINTF(6, 7)
gm_status gm_description_fail(const char *file, int line, const char *element,
                              gm_status status, gm_error *error, const char *format, ...);

/** The same for a named part: "file:line: gear 'g3': sentence", GM_ERR_MODEL. */
GM_PRINTF(5, 6)
gm_status gm_part_fail(const gm_description *d, const char *word, const gm_label *part,
                       gm_error *error, const char *format, ...);

/** The segment at x, or NULL beyond the shaft's ends. */
const gm_segment *gm_shaft_segment(const gm_shaft *shaft, double x);

/** Distance of two shafts' axes [m]. */
double gm_shaft_distance(const gm_description *d, int a, int b);

/** Axes nearer than this count as one [m]. */
#define GM_CONCENTRIC 20e-6

#endif
