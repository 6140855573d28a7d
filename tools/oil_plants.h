/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset at several oil temperatures: a plant for each.
 */
#ifndef OIL_PLANTS_H
#define OIL_PLANTS_H

#include "gearset_file.h"

typedef struct gm_oil_plants {
    int n;
    const gm_plant **plant; /* [n] */
    gm_gearset_file *files; /* [n]; of descriptions without the description itself */
} gm_oil_plants;

/** The gearset of *file at n temperatures [K]. *file must outlive them.
 *  GM_ERR_MODEL: a rig file names no variable for the temperature; or what
 *  gm_gearset_file_open_any answers. On failure nothing is held. */
GM_NODISCARD gm_status gm_oil_plants_open(const gm_gearset_file *file, int n,
                                          const double *temperature,
                                          gm_oil_plants *plants, gm_error *error);
/** The same at temperatures held out: random ones in equal parts of each of the n - 1
 *  intervals of an axis [K]. */
GM_NODISCARD gm_status gm_oil_plants_hold_out(const gm_gearset_file *file, int n,
                                              const double *axis, int seed,
                                              gm_oil_plants *plants, gm_error *error);
/** Plants one by one, at temperatures that are not known beforehand. */
typedef struct gm_oil_plant_list {
    const gm_gearset_file *file;
    int n;
    gm_oil_plants *plants; /* [n], each of one */
} gm_oil_plant_list;

/** For gm_oil_source.at; self is a gm_oil_plant_list that begins with file alone. */
gm_status gm_oil_plant_at(void *self, double temperature, const gm_plant **plant,
                          gm_error *error);
void gm_oil_plant_list_clear(gm_oil_plant_list *list);

void gm_oil_plants_close(gm_oil_plants *plants);

#endif
