/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Mesh stiffness by ISO 6336-1:2006 clause 9, method B (the standard's N, mm, um):
 *
 *   q' = 0.04723 + 0.15551/z_n1 + 0.25791/z_n2 - 0.00635 x_1 - 0.11654 x_1/z_n1
 *        - 0.00193 x_2 - 0.24188 x_2/z_n2 + 0.00529 x_1^2 + 0.00182 x_2^2
 *   c' = C_M C_R C_B cos(beta) / q',  C_M = 0.8, C_R = 1 (solid), C_B = 1 (standard rack)
 *   c' is multiplied by (F_t K_A / b / 100)^0.25 where F_t K_A / b < 100 N/mm
 *   c_gamma_alpha = c' (0.75 eps_alpha + 0.25),  c_gamma_beta = 0.85 c_gamma_alpha
 *   z_n = z / (cos^2 beta_b cos beta); infinite for a ring
 *
 * Valid for steel, eps_alpha 1.2 to 2 and x_1 >= x_2 with index 1 for the pinion.
 * The line of action is that of the transverse plane; the stiffness of a row along it is
 * c_gamma_alpha b.
 */
#include "model/stiffness.h"

#include <math.h>
#include <stdlib.h>

static const double standard_unit = 1e9;      /* N/(mm um) in N/m2 */
static const double average_single = 14.0;    /* N/(mm um) */
static const double average_mesh = 20.0;      /* N/(mm um) */
static const double full_line_load = 100.0e3; /* N/m */

static double equivalent_teeth(const gm_pair *pair, int i)
{
    double cos_b = cos(pair->beta_b);
    return pair->z[i] < 0 ? (double)INFINITY
                          : pair->z[i] / (cos_b * cos_b * cos(pair->beta));
}

/* q' in mm um / N; pinion first. */
static double flexibility(const gm_pair *pair)
{
    int p = abs(pair->z[0]) <= abs(pair->z[1]) ? 0 : 1;
    double z_1 = equivalent_teeth(pair, p), z_2 = equivalent_teeth(pair, 1 - p);
    double x_1 = pair->x[p], x_2 = pair->x[1 - p];
    return 0.04723 + 0.15551 / z_1 + 0.25791 / z_2 - 0.00635 * x_1 - 0.11654 * x_1 / z_1 -
           0.00193 * x_2 - 0.24188 * x_2 / z_2 + 0.00529 * x_1 * x_1 +
           0.00182 * x_2 * x_2;
}

gm_tooth_stiffness gm_tooth_stiffness_of(const gm_pair *pair, double line_load)
{
    double low = line_load < full_line_load ? pow(line_load / full_line_load, 0.25) : 1.0;
    double shift = pair->x[0] + pair->x[1];
    double single = average_single, mesh = average_mesh;
    if (shift >= -0.5 && shift <= 2.0 && pair->eps_alpha > 0.0) {
        single = 0.8 * cos(pair->beta) / flexibility(pair);
        mesh = single * (0.75 * pair->eps_alpha + 0.25);
    }
    return (gm_tooth_stiffness){.single = low * single * standard_unit,
                                .mesh = low * mesh * standard_unit,
                                .mesh_load = 0.85 * low * mesh * standard_unit};
}

double gm_default_backlash(const gm_pair *pair)
{
    return 2.0 / 3.0 * (0.06e-3 + 0.0005 * pair->a_w + 0.03 * pair->m_n);
}

double gm_row_reduced_mass(const gm_row *row, const double *inertia)
{
    double mobility = 0.0;
    for (int k = 0; k < row->n; k++)
        mobility += row->g[k] * row->g[k] / inertia[row->body[k]];
    return 1.0 / mobility;
}

gm_contact_law gm_flanks_law(const gm_flanks *flanks, double stiffness, double lash,
                             double mass)
{
    return (gm_contact_law){.model = flanks->model,
                            .stiffness = stiffness,
                            .damping =
                                2.0 * flanks->damping_ratio * sqrt(stiffness * mass),
                            .gap = 0.5 * lash,
                            .entry = flanks->entry,
                            .film = flanks->film};
}

gm_contact_law gm_mesh_contact_law(const gm_gearset *gearset, int mesh, double mass)
{
    const gm_mesh_element *element = &gearset->meshes[mesh];
    const gm_flanks *flanks = &gearset->description->meshes[mesh].flanks;
    double stiffness = flanks->stiffness, backlash = flanks->backlash;
    if (isnan(stiffness))
        stiffness =
            gm_tooth_stiffness_of(&element->pair, full_line_load).mesh * element->pair.b;
    if (isnan(backlash))
        backlash = gm_default_backlash(&element->pair);
    return gm_flanks_law(flanks, stiffness * element->contacts,
                         backlash / cos(element->pair.beta_b), mass);
}

gm_contact_law gm_lock_contact_law(const gm_gearset *gearset, const gm_lock *lock,
                                   double mass)
{
    const gm_description *d = gearset->description;
    const gm_flanks *flanks = lock->is_clutch ? &d->clutches[lock->index].closed
                                              : &gm_synchroniser_of(d, lock->index)->dogs;
    return gm_flanks_law(flanks, flanks->stiffness, flanks->backlash, mass);
}
