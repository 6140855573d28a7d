/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Ratios that a description gives, against those that its gears make. A slip in a tooth
 * number keeps every other rule when the profile shift or the module hides it; the given
 * ratio does not. A gear that holds the input is none.
 */
#include "model/check.h"
#include "model/gearset.h"

#include <math.h>

/* Relative: a ratio is quoted with four digits or more. */
#define TOLERANCE 1e-3

static gm_status check_ratio(const gm_gearset *gearset, int p, const gm_path_gear *given,
                             gm_error *error)
{
    const gm_description *d = gearset->description;
    int gear[GM_MAX_INPUT_PATHS];
    gm_kinematics kinematics;
    gm_rest_gears(d, gear);
    gear[p] = given->number;
    gm_status status = gm_gearset_kinematics(gearset, gear, &kinematics, error);
    if (status != GM_OK)
        return status;
    double made = kinematics.ratio[p];
    gm_label id = d->paths[p].id;
    id.line = given->line;
    if (made == 0.0)
        return gm_part_fail(d, "path", &id, error,
                            "gear %d: what it locks holds the input at rest while the "
                            "output turns",
                            given->number);
    if (isnan(given->ratio) ||
        fabs(made - given->ratio) <= TOLERANCE * fabs(given->ratio))
        return GM_OK;
    if (made * given->ratio < 0.0)
        return gm_part_fail(d, "path", &id, error,
                            "gear %d: given ratio %.6g, the gears make %.6g; the sign "
                            "must be the same",
                            given->number, given->ratio, made);
    return gm_part_fail(d, "path", &id, error,
                        "gear %d: given ratio %.6g, the gears make %.6g; they may differ "
                        "by %g of it",
                        given->number, given->ratio, made, TOLERANCE);
}

gm_status gm_gearset_check_ratios(const gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    gm_status status = GM_OK;
    for (int p = 0; p < d->n_paths; p++)
        for (int i = 0; i < d->paths[p].n_gears && status == GM_OK; i++)
            status = check_ratio(gearset, p, &d->paths[p].gears[i], error);
    return status;
}
