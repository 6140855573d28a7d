/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap check: read a description, print what the gearset is and how its gears work at
 * a reference point; with a gear, where that gear loses power.
 */
#include "commands.h"

#include "check.h"

#include <math.h>

typedef struct arguments {
    const char *description, *points;
    int gear, preselect, json;
    double speed, torque, oil_temperature;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_INTEGER, .name = "gear", .value = "N", .low = -9, .high = 99,
     .offset = offsetof(arguments, gear),
     .help = "print one operating point in detail, in this gear (-1: reverse)"},
    {.kind = GM_OPTION_QUANTITY, .name = "speed", .value = "SPEED", .unit = "rpm",
     .low = -1e5, .high = 1e5, .offset = offsetof(arguments, speed),
     .help = "speed of the input at the point; default: half of the largest"},
    {.kind = GM_OPTION_QUANTITY, .name = "torque", .value = "TORQUE", .unit = "Nm",
     .low = -1e6, .high = 1e6, .offset = offsetof(arguments, torque),
     .help = "torque at the input, negative: the output drives (at positive speed); "
             "default: half of the largest"},
    {.kind = GM_OPTION_INTEGER, .name = "preselect", .value = "N", .low = -9, .high = 99,
     .fallback = "0", .offset = offsetof(arguments, preselect),
     .help = "gear engaged without load on the other path; 0: that path is free"},
    {.kind = GM_OPTION_TEXT, .name = "points", .value = "FILE.csv",
     .offset = offsetof(arguments, points),
     .help = "losses by component at all points of a table with columns gear, "
             "speed_rpm, torque_Nm and optionally preselected, as a table"},
    GM_OIL_OPTION(offsetof(arguments, oil_temperature),
                  "oil temperature; default: the description's"),
    GM_JSON_OPTION(arguments),
};
// clang-format on

static int wants_point(const arguments *a)
{
    return a->gear != GM_OPTION_UNSET;
}

static const char *usage_problem(const arguments *a)
{
    if (a->points && (wants_point(a) || !isnan(a->speed) || !isnan(a->torque)))
        return "--points takes its gears, speeds and torques from the file";
    if (!wants_point(a) && a->preselect != 0)
        return "--preselect belongs to an operating point (--gear)";
    if (a->gear == 0)
        return "an operating point needs a gear; 0 is neutral";
    return a->speed == 0.0 ? "an operating point needs a speed other than 0" : NULL;
}

/* The point, or else what the gearset is and all gears. */
typedef struct checked {
    gm_checked_gearset gearset;
    gm_checked_reference reference;
    gm_checked_point point;
    gm_checked_points points;
    int has_point, has_points;
} checked;

static void print_text(const void *result, FILE *out)
{
    const checked *c = result;
    if (c->has_point) {
        gm_checked_point_print(&c->point, out);
        return;
    }
    if (c->has_points) {
        gm_checked_points_print(&c->points, out);
        return;
    }
    gm_checked_gearset_print(&c->gearset, out);
    gm_checked_reference_print(&c->reference, out);
}

static void print_json(const void *result, gm_json *json)
{
    const checked *c = result;
    gm_checked_gearset_json(&c->gearset, json);
    gm_checked_parts_json(c->gearset.description, json);
    if (c->has_point)
        gm_checked_point_json(&c->point, "point", json);
    else if (c->has_points)
        gm_checked_points_json(&c->points, json);
    else
        gm_checked_reference_json(&c->reference, json);
}

static const gm_result_form form = {print_text, print_json};

static gm_status check_open_file(const arguments *a, const gm_gearset_file *file,
                                 gm_error *error)
{
    checked c = {.has_point = wants_point(a), .has_points = a->points != NULL};
    const gm_description *d = file->description;
    const double speed = isnan(a->speed) ? 0.5 * d->speed_max : a->speed;
    const double torque = isnan(a->torque) ? 0.5 * d->torque_max : a->torque;
    const gm_point_request request = {a->gear, a->preselect, speed, torque};
    gm_status status = gm_check_gearset(file, &c.gearset, error);
    if (status == GM_OK && c.has_point)
        status = gm_check_point(file, &request, &c.point, error);
    else if (status == GM_OK && c.has_points)
        status = gm_check_points(file, a->points, &c.points, error);
    else if (status == GM_OK)
        status = gm_check_reference(file, speed, torque, &c.reference, error);
    if (status == GM_OK)
        status = gm_command_print(&form, a->json, &c, error);
    gm_checked_points_clear(&c.points);
    gm_checked_point_clear(&c.point);
    gm_checked_reference_clear(&c.reference);
    gm_checked_gearset_clear(&c.gearset);
    return status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_gearset_file file;
    gm_error error = {0};
    const char *problem = usage_problem(a);
    if (problem) {
        fprintf(stderr, "gearmap: %s\n", problem);
        return GM_EXIT_USAGE;
    }
    gm_status status =
        gm_gearset_file_open(a->description, a->oil_temperature, &file, &error);
    if (status == GM_OK) {
        status = check_open_file(a, &file, &error);
        gm_gearset_file_close(&file);
    }
    return gm_command_end(status, &error);
}

const gm_command gm_command_check = {
    .name = "check",
    .summary = "validate a description, print the gearset",
    .details =
        "Prints shafts, ratios as the model turns, inertias, the power flow of each "
        "gear, "
        "and of all gears at half of the largest speed and torque (or at --speed and "
        "--torque): losses by component, efficiency, mesh frequencies, bearing loads. "
        "With --gear: that gear alone, element by element. With --points: many points at "
        "once, component by component.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
