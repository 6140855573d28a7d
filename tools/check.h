/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The parts of `gearmap check`: what the gearset is, how all its gears work at one speed
 * and torque, and where one operating point loses its power. Each collects first and
 * prints after, as text or as JSON.
 */
#ifndef CHECK_H
#define CHECK_H

#include "gearset_file.h"
#include "json.h"
#include "power_flow.h"

typedef struct gm_checked_gear {
    int path, number;
    double ratio, ratio_given; /* input/output; NAN: not given */
    double inertia;            /* of everything that turns, seen at the input, kg.m2 */
    gm_power_flow flow;
} gm_checked_gear;

typedef struct gm_checked_gearset {
    const gm_description *description;
    double oil_temperature;                             /* K */
    double inertia_output, inertia[GM_MAX_INPUT_PATHS]; /* J_out, J_p, kg.m2 */
    int n_gears;
    gm_checked_gear *gears; /* [n_gears] */
} gm_checked_gearset;

/** Identify every gear. On failure nothing is held. */
GM_NODISCARD gm_status gm_check_gearset(const gm_gearset_file *file,
                                        gm_checked_gearset *checked, gm_error *error);
void gm_checked_gearset_clear(gm_checked_gearset *checked);
void gm_checked_gearset_print(const gm_checked_gearset *checked, FILE *out);
void gm_checked_gearset_json(const gm_checked_gearset *checked, gm_json *json);

/** All parts with places and sizes: an object "parts". */
void gm_checked_parts_json(const gm_description *description, gm_json *json);

/** An operating point as asked for: gear, speed [rad/s] and torque [N.m] at the input;
 *  preselected: gear engaged on the other path, 0: that path is in neutral and free. */
typedef struct gm_point_request {
    int gear, preselected;
    double speed, torque;
} gm_point_request;

typedef struct gm_checked_point {
    gm_point_request request;
    const char *path, *other; /* names; other NULL: one path only */
    double other_speed;       /* rad/s */
    int other_sticks;         /* 1: in neutral and held by friction */
    int other_gear;           /* then the gear that it turns in step with; 0: none */
    double output_speed, output_torque;
    double loss;            /* W, of all elements */
    double oil_temperature; /* K */
    int n_elements;
    gm_element_loss *elements; /* [n_elements], largest first */
} gm_checked_point;

/** Solve the point. GM_ERR_MODEL when there is no such gear. */
GM_NODISCARD gm_status gm_check_point(const gm_gearset_file *file,
                                      const gm_point_request *request,
                                      gm_checked_point *point, gm_error *error);
void gm_checked_point_clear(gm_checked_point *point);
/** A part by its kind and name; NULL: none. */
const gm_element_loss *gm_checked_point_element(const gm_checked_point *point,
                                                gm_loss_kind kind, const char *name);
/** 1: the mesh transmits power; 0: it only turns gears that idle. */
int gm_checked_point_loads(const gm_checked_point *point, const char *mesh);
/** Power [W] that all parts of a kind lose. */
double gm_checked_point_power(const gm_checked_point *point, gm_loss_kind kind);
/** Power out over power in, in the direction of the flow; NAN when nothing comes out. */
double gm_checked_point_efficiency(const gm_checked_point *point);
void gm_checked_point_print(const gm_checked_point *point, FILE *out);
/** key: of the object; NULL inside an array. */
void gm_checked_point_json(const gm_checked_point *point, const char *key, gm_json *json);

/** Losses by component of one of many points. */
typedef struct gm_point_losses {
    gm_point_request request;
    double output_speed, output_torque; /* rad/s, N.m */
    double loss, efficiency;            /* W; NAN when nothing comes out */
    double power[GM_LOSS_KINDS];        /* W */
} gm_point_losses;

typedef struct gm_checked_points {
    int n;
    gm_point_losses *point; /* [n], in the file's order */
} gm_checked_points;

/** Solve all points of a table (docs: gearmap help check). GM_ERR_IO, GM_ERR_FORMAT,
 *  GM_ERR_MODEL when there is no such gear. On failure nothing is held. */
GM_NODISCARD gm_status gm_check_points(const gm_gearset_file *file, const char *table,
                                       gm_checked_points *points, gm_error *error);
void gm_checked_points_clear(gm_checked_points *points);
/** A table of comma-separated values. */
void gm_checked_points_print(const gm_checked_points *points, FILE *out);
/** An array "points". */
void gm_checked_points_json(const gm_checked_points *points, gm_json *json);

/** Every gear at one speed [rad/s] and torque [N.m] of the input. */
typedef struct gm_checked_reference {
    const gm_description *description;
    double speed, torque;
    int n_points;
    gm_checked_point *points; /* [n_points], ascending by gear */
} gm_checked_reference;

/** Solve the point in every gear. On failure nothing is held. */
GM_NODISCARD gm_status gm_check_reference(const gm_gearset_file *file, double speed,
                                          double torque, gm_checked_reference *reference,
                                          gm_error *error);
void gm_checked_reference_clear(gm_checked_reference *reference);
void gm_checked_reference_print(const gm_checked_reference *reference, FILE *out);
void gm_checked_reference_json(const gm_checked_reference *reference, gm_json *json);

#endif
