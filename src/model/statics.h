/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Bearing loads from mesh forces. Every shaft is a rigid beam on its bearings (two
 * lateral, one axial, two tilting motions); the bearings are linear springs. These
 * coordinates are condensed once: each bearing's load becomes a linear function of the
 * normal forces F of the meshes, of their magnitudes |F| (the separating component does
 * not change sign with the flank), and of the weight. Where two bearings carry a shaft
 * the result does not depend on stiffness: it is plain statics.
 */
#ifndef STATICS_H
#define STATICS_H

#include "model/gm_description.h"

/** Force of a mesh on one of its wheels per newton of base-tangent force F (signed) and
 *  of |F|; components x, y, z; acting at `point` (absolute). */
typedef struct gm_contact {
    double signed_part[3];
    double magnitude_part[3];
    double point[3];
} gm_contact;

/** Load of one bearing: vector = weight + sum_k (a_k F_k + b_k |F_k|), k over meshes. */
typedef struct gm_load_row {
    int n;
    int *mesh;        /* [n] */
    double (*a)[3];   /* [n], x y z */
    double (*b)[3];   /* [n] */
    double weight[3]; /* N */
    /* Of a pair that holds its shaft one direction each (thrust.c); mate NULL: both. */
    const struct gm_load_row *mate; /* with the same meshes in the same order */
    double way;                     /* +1: holds the shaft from moving towards +x; -1 */
    double induced;                 /* axial force by radial load */
    double preload;                 /* N, the same in both */
} gm_load_row;

/** Make a pair of two rows, whose way, induced and preload are set and which stay where
 *  they are. */
void gm_thrust_pair(gm_load_row *one, gm_load_row *other);

/** Axial load of a bearing of a pair under mesh forces F, >= 0 [N]; d_axial[n] by the
 *  forces of the row, or NULL. */
double gm_thrust_at(const gm_load_row *row, const double *F, double *d_axial);

void gm_load_row_clear(gm_load_row *row);

/** The load as a vector, x y z [N]. */
void gm_load_row_vector(const gm_load_row *row, const double *F, double load[3]);

/** Radial and axial magnitude under mesh forces F, and their derivatives by the n forces
 *  of the row. d_radial and d_axial may be NULL. */
void gm_load_row_at(const gm_load_row *row, const double *F, double *radial,
                    double *axial, double *d_radial, double *d_axial);

/** A mesh as statics sees it: which shaft carries each of its wheels. */
typedef struct gm_static_mesh {
    int shaft[2];
    gm_contact contact[2];
} gm_static_mesh;

/** A dead weight on a shaft. */
typedef struct gm_static_mass {
    int shaft;
    double position; /* x, m */
    double mass;     /* kg */
} gm_static_mass;

/** Loads of all bearings of the description: rows[n_bearings], to be cleared by the
 *  caller. GM_ERR_MODEL when the bearings leave a shaft free to move. */
GM_NODISCARD gm_status gm_statics_solve(const gm_description *description, int n_meshes,
                                        const gm_static_mesh *meshes, int n_masses,
                                        const gm_static_mass *masses, gm_load_row *rows,
                                        gm_error *error);

/** Load that the meshes of one wheel and its weight put on the wheel's own bearing. */
GM_NODISCARD gm_status gm_statics_wheel(double mass, int n, const int *mesh,
                                        const gm_contact *const *contact,
                                        gm_load_row *row, gm_error *error);

#endif
