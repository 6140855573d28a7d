/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Where losses have kinks and drags jump, so that axes can have nodes there: speeds and
 * torques at which a loaded mesh changes its friction regime, speeds at which the oil
 * films of open clutches begin to shrink, and the ratios of speeds at which a bearing
 * between a path and the output stands still.
 */
#include "model/gearset.h"

#include <math.h>
#include <stddef.h>

static void sort_ascending(int n, double *x)
{
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && x[k] < x[k - 1]; k--) {
            double t = x[k];
            x[k] = x[k - 1];
            x[k - 1] = t;
        }
}

/* Speed or torque of the path at which one mesh has a kink; 0: none. force: base-tangent
 * force for 1 N.m at the path without losses [N]; slide: sum speed v_SigmaC for 1 rad/s
 * of the path [m/s]. */
typedef double (*mesh_kink)(const gm_mesh_law *law, double force, double slide);

/* Every mesh that carries load when path p drives in gear `number`. */
static int find_kinks(const gm_gearset *gearset, int p, int number, mesh_kink kink,
                      int n_max, double *found)
{
    int gear[GM_MAX_INPUT_PATHS];
    gm_configuration_rows rows;
    gm_rest_gears(gearset->description, gear);
    gear[p] = number;
    if (gm_configuration_rows_make(gearset, gear, &rows, NULL) != GM_OK)
        return 0;
    int count = 0, n = rows.n_bodies, input = gm_flange_body(gearset, 1 + p);
    double ratio = rows.speed_of[input * rows.n_independent];
    for (int m = 0; m < gearset->n_meshes && count < n_max; m++) {
        const gm_mesh_element *mesh = &gearset->meshes[m];
        double force = fabs(rows.inverse[m * n + input]) / mesh->contacts;
        double along = 0.0;
        for (int k = 0; k < mesh->roll.n; k++)
            along +=
                mesh->roll.g[k] * rows.speed_of[mesh->roll.body[k] * rows.n_independent];
        along /= ratio * mesh->cos_alpha_wt;
        double x = kink(&mesh->law, force, fabs(along) * mesh->law.sliding_ratio);
        if (force > 1e-6 && x > 0.0)
            found[count++] = x;
    }
    gm_configuration_rows_clear(&rows);
    sort_ascending(count, found);
    return count;
}

static double least_line_load(const gm_mesh_law *law, double force, double slide)
{
    (void)slide;
    return law->minimum_force > 0.0 && force > 0.0 ? law->minimum_force / force : 0.0;
}

static double end_of_boundary_friction(const gm_mesh_law *law, double force, double slide)
{
    (void)law, (void)force;
    return slide > 0.0 ? GM_MESH_MIN_SLIDING_SPEED / slide : 0.0;
}

int gm_gearset_kink_torques(const gm_gearset *gearset, int p, int number, int n_max,
                            double *torque)
{
    return find_kinks(gearset, p, number, least_line_load, n_max, torque);
}

/* Speeds of path p in gear `number` at which films of open clutches begin to shrink. */
static int ends_of_full_films(const gm_gearset *gearset, int p, int number, int n_max,
                              double *found)
{
    int gear[GM_MAX_INPUT_PATHS], count = 0;
    gm_configuration_rows rows;
    gm_rest_gears(gearset->description, gear);
    gear[p] = number;
    if (gm_configuration_rows_make(gearset, gear, &rows, NULL) != GM_OK)
        return 0;
    const double *w = rows.speed_of;
    int n = rows.n_independent;
    double ratio = w[gm_flange_body(gearset, 1 + p) * n];
    for (int i = 0; i < gearset->n_drags && count < n_max; i++) {
        const gm_drag_element *drag = &gearset->drags[i];
        if (drag->law != GM_DRAG_CLUTCH)
            continue;
        double on = drag->on == GM_HOUSING ? 0.0 : w[drag->on * n];
        double slip = fabs((w[drag->body * n] - on) / ratio);
        double full = gm_plates_full_slip(&drag->plates, &gearset->oil);
        if (slip > 1e-9 && isfinite(full)) /* open, and not by rounding */
            found[count++] = full / slip;
    }
    gm_configuration_rows_clear(&rows);
    return count;
}

int gm_gearset_kink_speeds(const gm_gearset *gearset, int p, int number, int n_max,
                           double *speed)
{
    int n = find_kinks(gearset, p, number, end_of_boundary_friction, n_max, speed);
    n += ends_of_full_films(gearset, p, number, n_max - n, speed + n);
    sort_ascending(n, speed);
    return n;
}

/* Add x to the ascending list unless it is there: equal but for rounding. */
static int insert_once(int n, int n_max, double *list, double x)
{
    for (int i = 0; i < n; i++)
        if (fabs(list[i] - x) <= 1e-9 * fabs(x))
            return n;
    if (n == n_max)
        return n;
    list[n] = x;
    sort_ascending(n + 1, list);
    return n + 1;
}

/* The ratio at which bearing b stands still while path and output turn; 0 where its speed
 * does not depend on both, or also on another path. */
static double line_of_bearing(const gm_configuration_rows *rows,
                              const gm_bearing_element *b, int column)
{
    double s[GM_MAX_FLANGES] = {0.0};
    for (int i = 0; i < rows->n_independent; i++) {
        double on =
            b->on == GM_HOUSING ? 0.0 : rows->speed_of[b->on * rows->n_independent + i];
        s[i] = rows->speed_of[b->body * rows->n_independent + i] - on;
        if (i != 0 && i != column && s[i] != 0.0)
            return 0.0;
    }
    return s[column] != 0.0 ? -s[0] / s[column] : 0.0;
}

int gm_gearset_drag_lines(const gm_gearset *gearset, int p, int n_max, double *ratio)
{
    int rest[GM_MAX_INPUT_PATHS];
    gm_configuration_rows rows;
    gm_rest_gears(gearset->description, rest);
    if (gm_configuration_rows_make(gearset, rest, &rows, NULL) != GM_OK)
        return 0;
    int n = 0, column = gm_flange_column(&rows, 1 + p);
    for (int i = 0; i < gearset->n_bearings && column >= 0; i++) {
        const gm_bearing_element *b = &gearset->bearings[i];
        double line = line_of_bearing(&rows, b, column);
        if (b->law.data.friction != GM_FRICTION_NONE && line != 0.0)
            n = insert_once(n, n_max, ratio, line);
    }
    gm_configuration_rows_clear(&rows);
    return n;
}
