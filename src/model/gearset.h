/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The assembled gearset, as the files of this room share it.
 */
#ifndef GEARSET_H
#define GEARSET_H

#include "model/bearing.h"
#include "model/drag.h"
#include "model/gm_gearset.h"
#include "model/mesh.h"
#include "model/statics.h"

/** A rotating body: every shaft with its fixed gears, then every idling gear. */
typedef struct gm_body {
    double inertia; /* kg.m2 */
    double mass;    /* kg */
} gm_body;

/** A row of the assembly: deflection rate sum g[k] w(body[k]), k < n. A mesh has two
 *  bodies, seen from a carrier three; a brake against the housing has one. */
typedef struct gm_row {
    int n;
    int body[3];
    double g[3];
} gm_row;

/** A mesh: base radii as row. A mesh with a planet gear is seen from the carrier c,
 *  g0 (w_a - w_c) + g1 (w_b - w_c) = 0, and stands for as many equal contacts as there
 *  are planets: a force F of the row is F / contacts on each. Friction acts on the
 *  rolling speed, in rigid motion the speed along the line of action:
 *  (g0 (w_a - w_c) - g1 (w_b - w_c)) / 2. */
typedef struct gm_mesh_element {
    gm_row row, roll;
    int carrier;  /* body from which it is seen; GM_HOUSING: at rest */
    int contacts; /* >= 1 */
    gm_pair pair;
    gm_mesh_law law;
    double cos_alpha_wt;
    gm_contact contact[2]; /* what the normal force does to each wheel */
} gm_mesh_element;

/** A rolling bearing between two bodies, its loads from the row forces. */
typedef struct gm_bearing_element {
    gm_loss_kind kind;
    const char *name;
    int body, on;    /* on = GM_HOUSING: relative to the housing */
    double position; /* x, m */
    int count;       /* equal bearings under equal load that the element stands for */
    gm_bearing_law law;
    gm_load_row load;      /* of one of them */
    double centrifugal[3]; /* force of a planet on its pin per speed of `on` squared,
                              N s2/rad2, in the directions of load */
} gm_bearing_element;

/** Loads of one bearing. */
typedef struct gm_bearing_load {
    double radial, axial; /* N */
    double d_radial_on;   /* by the speed of what it sits on, N.s/rad */
} gm_bearing_load;

/** Loads at row forces F with its `on` turning at w_on [rad/s], and their derivatives by
 *  F as gm_load_row_at. */
gm_bearing_load gm_bearing_load_at(const gm_bearing_element *bearing, double w_on,
                                   const double *F, double *d_radial, double *d_axial);

/** A drag of speed alone between two bodies. */
typedef enum gm_drag_law {
    GM_DRAG_SEAL,
    GM_DRAG_GAP, /* Petroff: shaft gaps and open cones */
    GM_DRAG_CLUTCH,
    GM_DRAG_CHURNING, /* Changenet and Velex */
    GM_DRAG_CHURNING_ISO14179_1,
    GM_DRAG_SPLASH, /* ISO/TR 14179-2, of a mesh */
    GM_DRAG_WINDAGE,
    GM_DRAG_JET
} gm_drag_law;

typedef struct gm_drag_element {
    gm_loss_kind kind;
    const char *name;
    int body, on;
    double position; /* x, m; NAN: none of its own */
    gm_drag_law law;
    gm_seal_model seal;
    double radius, length, clearance; /* seal: radius only */
    gm_plates plates;                 /* of a clutch */
    gm_dip dip;
    gm_splash splash;
    gm_windage windage;
    gm_jet_law jet;
} gm_drag_element;

/** Friction force of a mesh along its line of action, against its rolling speed [N]. */
typedef struct gm_mesh_friction {
    double value;   /* >= 0 */
    double d_force; /* by the signed row force F */
    double d_speed; /* by the pitch-line speed v_t, N.s/m */
} gm_mesh_friction;

/** At row force F [N] and pitch-line speed v_t >= 0 [m/s], by the mesh's law. Parallel
 *  contacts share the force equally. */
gm_mesh_friction gm_mesh_friction_at(const gm_mesh_element *mesh, double F, double v_t);

struct gm_gearset {
    const gm_description *description;
    gm_oil oil;
    int n_bodies;
    gm_body *bodies;
    int *wheel_body; /* [n_wheels] */
    int n_meshes;
    gm_mesh_element *meshes;
    int n_bearings; /* shaft bearings, then bearings of idling gears */
    gm_bearing_element *bearings;
    int n_drags;
    gm_drag_element *drags;
};

/** Torque of a drag at relative speed w >= 0 [rad/s]. */
gm_speed_torque gm_drag_torque(const gm_gearset *gearset, const gm_drag_element *drag,
                               double w);

/** Fill drags; meshes and bodies are there (drags.c). */
GM_NODISCARD gm_status gm_drags_make(gm_gearset *gearset, gm_error *error);

/** Fill bodies and wheel_body. */
GM_NODISCARD gm_status gm_bodies_make(gm_gearset *gearset, gm_error *error);

/** Fill meshes, after the bodies. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_meshes_make(gm_gearset *gearset, gm_error *error);

/** Axis of a wheel, of planets that of the first: y, z [m]. */
void gm_wheel_axis(const gm_description *description, int wheel, double axis[2]);

/** Distance of two wheels' axes [m]. */
double gm_wheel_distance(const gm_description *description, const int wheel[2]);

/** Every given ratio must be the one that the gears make, within 1e-3 of it and with its
 *  sign. GM_ERR_MODEL with file, line, path, gear and both ratios; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_gearset_check_ratios(const gm_gearset *gearset,
                                               gm_error *error);

/** What the reduced gearset takes for granted: in no configuration does inertia couple
 *  two independent speeds, a path in neutral has the same inertia in all of them, and
 *  gears of two paths add up. GM_ERR_MODEL with file, line and path; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_gearset_check_inertia(const gm_gearset *gearset,
                                                gm_error *error);

/** Pitch mass of a wheel from its dimensions, or as given [kg]. */
double gm_wheel_mass(const gm_description *description, const gm_wheel *wheel);

/** Moment of inertia of one wheel about its own axis, likewise [kg.m2]. */
double gm_wheel_inertia(const gm_description *description, const gm_wheel *wheel);

/** Shaft mass, as given or from its segments [kg], and its centre along x [m]. */
double gm_shaft_mass(const gm_shaft *shaft, double *centre);

/** Row of a lock: relative speed of the two parts that it locks. */
gm_row gm_lock_row(const gm_gearset *gearset, const gm_lock *lock);

/** Speeds of all bodies over the independent speeds of a configuration. */
typedef struct gm_configuration_rows {
    int n_bodies;
    int n_rows;                 /* meshes, then locks */
    int n_independent;          /* output, then the paths in neutral */
    int flange[GM_MAX_FLANGES]; /* flange of each independent speed */
    gm_row *lock;               /* [n_locks] */
    const gm_lock **locked;     /* [n_locks]: what each of them is */
    int n_locks;
    double *speed_of; /* [n_bodies][n_independent] */
    double *balance;  /* A [n_bodies][n_bodies]: row forces and flange torques -> torques
                         on the bodies */
    double *inverse;  /* of A */
} gm_configuration_rows;

GM_NODISCARD gm_status gm_configuration_rows_make(const gm_gearset *gearset,
                                                  const int *gear,
                                                  gm_configuration_rows *rows,
                                                  gm_error *error);
void gm_configuration_rows_clear(gm_configuration_rows *rows);

/** Inertia between two independent speeds of a configuration: sum of J dw/du_i dw/du_k
 *  [kg.m2]. */
double gm_coupled_inertia(const gm_gearset *gearset, const gm_configuration_rows *rows,
                          int i, int k);

/** Gears of the configuration in which every path rests: neutral, or its only gear. */
void gm_rest_gears(const gm_description *description, int gear[GM_MAX_INPUT_PATHS]);

/** Column of a flange's speed among the independent speeds; -1 when it is not one. */
int gm_flange_column(const gm_configuration_rows *rows, int flange);

/** Body of a flange: 0 the output, 1 + p the input of path p. */
int gm_flange_body(const gm_gearset *gearset, int flange);

#endif
