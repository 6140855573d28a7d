/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Tooth stiffness of a gear pair (stiffness.c), and from it the contact laws of a
 * gearset's elastic rows.
 */
#ifndef STIFFNESS_H
#define STIFFNESS_H

#include "model/contact.h"
#include "model/gearset.h"

/** ISO 6336-1 method B. */
typedef struct gm_tooth_stiffness {
    double single;    /* c', N/m2: force per width and deflection of one pair of teeth */
    double mesh;      /* c_gamma_alpha, N/m2: of all teeth in contact */
    double mesh_load; /* c_gamma_beta = 0.85 c_gamma_alpha, N/m2 */
} gm_tooth_stiffness;

/** Steel gears with solid bodies. line_load F_t K_A / b [N/m] > 0: below 100 N/mm the
 *  stiffness falls with its fourth root. Outside the source's range (-0.5 <= x_1 + x_2
 *  <= 2) or without a contact ratio, its average 14 N/(mm um) for c' and 20 for
 *  c_gamma_alpha are taken. */
gm_tooth_stiffness gm_tooth_stiffness_of(const gm_pair *pair, double line_load);

/** Normal backlash where none is given [m]: 2/3 (0.06 + 0.0005 a + 0.03 m_n) in mm, the
 *  recommended minimum of ISO/TR 10064-2:1996, table A.1. */
double gm_default_backlash(const gm_pair *pair);

/** The mass that moves along a row when its bodies turn freely [kg or kg.m2]:
 *  1 / sum g^2 / J. inertia[n_bodies]; infinite when none of them can move. */
double gm_row_reduced_mass(const gm_row *row, const double *inertia);

/** Contact law of flanks on a row: mass is the reduced mass [kg or kg.m2], lash and
 *  stiffness are those of the row. */
gm_contact_law gm_flanks_law(const gm_flanks *flanks, double stiffness, double lash,
                             double mass);

/** Contact law of a mesh, all its parallel contacts together; mass as above. */
gm_contact_law gm_mesh_contact_law(const gm_gearset *gearset, int mesh, double mass);

/** Contact law of a closed lock; mass: reduced mass of its row. The dogs of a
 *  synchroniser, or the splines of a clutch. An idling gear must have a synchroniser. */
gm_contact_law gm_lock_contact_law(const gm_gearset *gearset, const gm_lock *lock,
                                   double mass);

#endif
