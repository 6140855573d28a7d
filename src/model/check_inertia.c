/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inertia as the reduced gearset knows it: J_out turns with the output, J_p with path p
 * in neutral, and every gear adds its own part. That is always so for layshafts. A
 * planetary set between two free shafts has parts that turn with both; then neutral is
 * not two independent shafts, and a gearset is refused.
 */
#include "model/check.h"
#include "model/gearset.h"

#include <math.h>

#define ROUNDING 1e-9 /* relative */

static const char *flange_name(const gm_description *d, int flange)
{
    return flange == 0 ? "the output" : d->paths[flange - 1].id.name;
}

/* In words: gears (1, 0). */
static gm_status coupled(const gm_description *d, const int *gear, int a, int b, double J,
                         gm_error *error)
{
    const gm_path_part *path = &d->paths[(b > 0 ? b : a) - 1];
    return gm_part_fail(d, "path", &path->id, error,
                        "with gears (%d, %d) the inertia of parts between them couples "
                        "%s and %s by %.3g kg.m2; they must turn freely: lock a part in "
                        "neutral (gear 0)",
                        gear[0], gear[1], flange_name(d, a), flange_name(d, b), J);
}

static gm_status check_coupling(const gm_gearset *gearset,
                                const gm_configuration_rows *rows, const int *gear,
                                gm_error *error)
{
    for (int i = 0; i < rows->n_independent; i++)
        for (int k = 0; k < i; k++) {
            double J = gm_coupled_inertia(gearset, rows, i, k);
            double size = gm_coupled_inertia(gearset, rows, i, i) *
                          gm_coupled_inertia(gearset, rows, k, k);
            if (fabs(J) > ROUNDING * sqrt(size))
                return coupled(gearset->description, gear, rows->flange[k],
                               rows->flange[i], J, error);
        }
    return GM_OK;
}

/* A neutral path's own inertia does not depend on the other path's gear. */
static gm_status check_neutral(const gm_gearset *gearset,
                               const gm_configuration_rows *rows, const int *gear,
                               const gm_kinematics *rest, gm_error *error)
{
    const gm_description *d = gearset->description;
    for (int i = 1; i < rows->n_independent; i++) {
        int p = rows->flange[i] - 1;
        double J = gm_coupled_inertia(gearset, rows, i, i);
        if (fabs(J - rest->inertia[p]) > ROUNDING * rest->inertia[p])
            return gm_part_fail(d, "path", &d->paths[p].id, error,
                                "in neutral its inertia must not depend on the other "
                                "path; found %.6g kg.m2, with gears (%d, %d) %.6g kg.m2",
                                rest->inertia[p], gear[0], gear[1], J);
    }
    return GM_OK;
}

static gm_status check_configuration(const gm_gearset *gearset, const int *gear,
                                     const gm_kinematics *rest, gm_error *error)
{
    gm_configuration_rows rows;
    gm_status status = gm_configuration_rows_make(gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    status = check_coupling(gearset, &rows, gear, error);
    if (status == GM_OK)
        status = check_neutral(gearset, &rows, gear, rest, error);
    gm_configuration_rows_clear(&rows);
    return status;
}

/* What gear `number` of path p adds to J_out + r^2 J_p. */
static gm_status extra_inertia(const gm_gearset *gearset, int p, int number,
                               double *extra, gm_error *error)
{
    int gear[GM_MAX_INPUT_PATHS];
    gm_kinematics k;
    gm_rest_gears(gearset->description, gear);
    gear[p] = number;
    gm_status status = gm_gearset_kinematics(gearset, gear, &k, error);
    if (status == GM_OK)
        *extra = gm_extra_inertia(&k);
    return status;
}

double gm_extra_inertia(const gm_kinematics *k)
{
    double sum = k->inertia_output, size = fabs(k->inertia_total);
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        sum += k->ratio[p] * k->ratio[p] * k->inertia[p];
    double extra = k->inertia_total - sum;
    return fabs(extra) > ROUNDING * size ? extra : 0.0;
}

static gm_status check_sum(const gm_gearset *gearset, const int *gear, gm_error *error)
{
    const gm_description *d = gearset->description;
    double extra[GM_MAX_INPUT_PATHS] = {0.0, 0.0};
    gm_kinematics k;
    gm_status status = gm_gearset_kinematics(gearset, gear, &k, error);
    for (int p = 0; p < 2 && status == GM_OK; p++)
        status = extra_inertia(gearset, p, gear[p], &extra[p], error);
    if (status != GM_OK)
        return status;
    double both = gm_extra_inertia(&k), rest = both - extra[0] - extra[1];
    if (fabs(rest) <= 2.0 * ROUNDING * k.inertia_total)
        return GM_OK;
    return gm_part_fail(d, "path", &d->paths[0].id, error,
                        "gears (%d, %d): what they add to the inertia must be the sum of "
                        "what each adds; found %.6g kg.m2, expected %.6g kg.m2",
                        gear[0], gear[1], both, extra[0] + extra[1]);
}

static gm_status check_pairs(const gm_gearset *gearset, const gm_kinematics *rest,
                             gm_error *error)
{
    const gm_path_part *path = gearset->description->paths;
    gm_status status = GM_OK;
    for (int i = 0; i < path[0].n_gears; i++)
        for (int k = 0; k < path[1].n_gears && status == GM_OK; k++) {
            const int gear[] = {path[0].gears[i].number, path[1].gears[k].number};
            status = check_configuration(gearset, gear, rest, error);
            if (status == GM_OK)
                status = check_sum(gearset, gear, error);
        }
    return status;
}

gm_status gm_gearset_check_inertia(const gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    int gear[GM_MAX_INPUT_PATHS];
    gm_kinematics rest;
    gm_rest_gears(d, gear);
    gm_status status = gm_gearset_kinematics(gearset, gear, &rest, error);
    if (status == GM_OK)
        status = check_configuration(gearset, gear, &rest, error);
    for (int p = 0; p < d->n_paths; p++)
        for (int i = 0; i < d->paths[p].n_gears && status == GM_OK; i++) {
            gm_rest_gears(d, gear);
            gear[p] = d->paths[p].gears[i].number;
            status = check_configuration(gearset, gear, &rest, error);
        }
    if (status == GM_OK && d->n_paths == 2)
        status = check_pairs(gearset, &rest, error);
    return status;
}
