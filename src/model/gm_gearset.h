/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset, assembled: bodies that rotate, rows that couple them (meshes,
 * locked synchronisers), friction elements between them, and the steady balance of
 * torques.
 *
 *   for every body b:   - sum_e g_e,b F_e + tau_friction,b + tau_flange,b = 0
 *   for every row e:      g_e . w = 0   (meshes are rigid in steady motion)
 *
 * Bearing loads follow from the row forces by statics (statics.c), bearing and mesh
 * friction from loads and speeds. The room knows no solver: it gives residuals and their
 * exact Jacobian.
 *
 * Independent speeds of a configuration: the output and every path in neutral. Where such
 * a speed is given, the torque at its flange is unknown; where it is free, the torque is
 * given. An engaged path's torque is given and its speed follows.
 */
#ifndef GM_GEARSET_H
#define GM_GEARSET_H

#include "model/gm_description.h"
#include "model/gm_steady.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_gearset gm_gearset;

/** Assemble. oil_temperature [K]. The description must outlive the gearset.
 *  GM_ERR_MODEL: a given ratio is not the one that the gears make; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_gearset_create(const gm_description *description,
                                         double oil_temperature, gm_gearset **gearset,
                                         gm_error *error);
void gm_gearset_destroy(gm_gearset *gearset);

const gm_description *gm_gearset_description(const gm_gearset *gearset);

/** Oil temperature that the gearset was assembled for [K]. */
double gm_gearset_oil_temperature(const gm_gearset *gearset);

/** GM_ERR_MODEL when the gears block each other or a body is reached by no flange. */
GM_NODISCARD gm_status gm_gearset_kinematics(const gm_gearset *gearset, const int *gear,
                                             gm_kinematics *kinematics, gm_error *error);

/** Capacity of path p's synchronisers as a torque at its input flange [N.m]: cone torque
 *  times wheel speed over input speed, the smallest of its gears. NAN without memory. */
double gm_gearset_sync_torque(const gm_gearset *gearset, int p);

/** Speeds of path p in gear `number` [rad/s, ascending, at most n_max] at which the
 *  sliding speed of a loaded mesh leaves boundary friction or the film of an open clutch
 *  begins to shrink: kinks of the loss. Returns their number. */
int gm_gearset_kink_speeds(const gm_gearset *gearset, int p, int number, int n_max,
                           double *speed);

/** Torques at path p in gear `number` [N.m, > 0, ascending, at most n_max] at which the
 *  line load of a mesh reaches the least that its friction coefficient knows: kinks of
 *  the loss. Returns their number. */
int gm_gearset_kink_torques(const gm_gearset *gearset, int p, int number, int n_max,
                            double *torque);

/** Ratios w_path / w_output of path p in neutral at which a bearing between a part that
 *  turns with the path and one that turns with the output does not turn: where the drag
 *  on the path jumps. Ascending, each once, at most n_max. Returns their number. */
int gm_gearset_drag_lines(const gm_gearset *gearset, int p, int n_max, double *ratio);

/** How path p in gear `number` gives way between its flange and the held output, the
 *  other path in neutral: 1/k = sum F_e^2 / k_e and lash = sum |F_e| j_e over meshes,
 *  locks and compliant shafts with their forces F_e at 1 N.m; damping of these and of
 *  what turns idly along. GM_ERR_ARGUMENT: the path has no such gear; GM_ERR_MODEL;
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_gearset_compliance(const gm_gearset *gearset, int p, int number,
                                             gm_compliance *compliance, gm_error *error);

/** Workspace of the steady balance for one thread; keeps what does not change while the
 *  configuration and the speeds stay. */
typedef struct gm_balance gm_balance;
GM_NODISCARD gm_status gm_balance_create(const gm_gearset *gearset, gm_balance **balance,
                                         gm_error *error);
void gm_balance_destroy(gm_balance *balance);

/** Choose the point. Unknowns x: row forces, then unknown flange torques (N, N.m). */
GM_NODISCARD gm_status gm_balance_set_point(gm_balance *balance,
                                            const gm_steady_point *point,
                                            gm_error *error);

/** Number of unknowns and of Jacobian entries at the present configuration. */
int gm_balance_size(const gm_balance *balance);
int gm_balance_entries(const gm_balance *balance);

/** One pass of the natural predictor: friction at x, then forces from the leaves to the
 *  root; x -> next x. Start from zeros. Returns the largest change relative to the
 *  largest unknown. */
double gm_balance_pass(gm_balance *balance, double *x);

/** Residual f[size] of the torque balances [N.m] at x. */
void gm_balance_residual(gm_balance *balance, const double *x, double *f);

/** Jacobian df/dx, compressed columns: column_start[size + 1], row[entries] and
 *  value[entries]; the pattern is that of the configuration. */
void gm_balance_pattern(const gm_balance *balance, int *column_start, int *row);
void gm_balance_jacobian(gm_balance *balance, const double *x, double *value);

/** Flange torques and speeds at the solution x. */
void gm_balance_result(const gm_balance *balance, const double *x,
                       gm_steady_result *result);

/** Loss power of every friction element at the solution. */
typedef enum gm_loss_kind {
    GM_LOSS_MESH,
    GM_LOSS_BEARING,
    GM_LOSS_IDLER,
    GM_LOSS_SEAL,
    GM_LOSS_SYNCHRONISER,
    GM_LOSS_CLUTCH,
    GM_LOSS_GAP,
    GM_LOSS_CHURNING,
    GM_LOSS_WINDAGE,
    GM_LOSS_JET,
    GM_LOSS_KINDS
} gm_loss_kind;

typedef struct gm_element_loss {
    gm_loss_kind kind;
    const char *name;     /* the part's, owned by the description */
    double power;         /* W, >= 0 */
    double speed;         /* relative, rad/s or m/s (meshes) */
    double radial, axial; /* loads of bearings, tangential force F_bt of meshes [N] */
    double frequency;     /* of a mesh: pairs of teeth that meet per second, Hz */
} gm_element_loss;

int gm_gearset_element_count(const gm_gearset *gearset);
/** losses[element_count] */
void gm_balance_losses(gm_balance *balance, const double *x, gm_element_loss *losses);

/** Name of a kind of loss, such as "bearings". */
const char *gm_loss_kind_name(gm_loss_kind kind);

#ifdef __cplusplus
}
#endif
#endif
