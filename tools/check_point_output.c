/* SPDX-License-Identifier: BSD-2-Clause
 *
 * One operating point as text, a table per question (which components lose, how the teeth
 * are loaded, how the bearings are loaded, what else drags), and as JSON.
 */
#include "check.h"

#include <math.h>

#define RPM_PER_RAD_S 9.549296585513721 /* 60 / (2 pi) */
#define KELVIN 273.15
#define SMALL_SHARE 1e-3 /* of the loss: below, an element is not listed */

static void print_free_path(const gm_checked_point *c, FILE *out)
{
    double rpm = c->other_speed * RPM_PER_RAD_S;
    fprintf(out, "%s in neutral, ", c->other);
    if (!c->other_sticks)
        fprintf(out, "turning freely at %.0f rpm\n", rpm);
    else if (fabs(rpm) < 0.5)
        fputs("held at rest by friction\n", out);
    else if (c->other_gear != 0)
        fprintf(out, "held by friction in step with gear %d at %.0f rpm\n", c->other_gear,
                rpm);
    else
        fprintf(out, "held by friction at %.0f rpm\n", rpm);
}

static void print_head(const gm_checked_point *c, FILE *out)
{
    const gm_point_request *r = &c->request;
    double efficiency = gm_checked_point_efficiency(c);
    fprintf(out, "gear %d (%s) at %.0f rpm and %.1f N·m, oil %.1f °C\n", r->gear, c->path,
            r->speed * RPM_PER_RAD_S, r->torque, c->oil_temperature - KELVIN);
    if (c->other && r->preselected != 0)
        fprintf(out, "gear %d preselected (%s at %.0f rpm)\n", r->preselected, c->other,
                c->other_speed * RPM_PER_RAD_S);
    else if (c->other)
        print_free_path(c, out);
    fprintf(out, "output %.1f rpm, %.2f N·m; loss %.1f W = %.4f N·m at the input",
            c->output_speed * RPM_PER_RAD_S, -c->output_torque, c->loss,
            c->loss / fabs(r->speed));
    if (!isnan(efficiency))
        fprintf(out, "; efficiency %.2f %%", 100.0 * efficiency);
    fputs("\n\n", out);
}

static void print_components(const gm_checked_point *c, FILE *out)
{
    double speed = fabs(c->request.speed);
    fprintf(out, "%-26s %10s %12s %10s\n", "component", "loss [W]", "at input", "share");
    for (int k = 0; k < GM_LOSS_KINDS; k++) {
        double power = gm_checked_point_power(c, (gm_loss_kind)k);
        if (power > 0.0)
            fprintf(out, "  %-24s %10.2f %8.4f N·m %8.1f %%\n",
                    gm_loss_kind_name((gm_loss_kind)k), power, power / speed,
                    100.0 * power / c->loss);
    }
}

static int is_small(const gm_checked_point *c, const gm_element_loss *e)
{
    return e->power < SMALL_SHARE * c->loss;
}

static void print_meshes(const gm_checked_point *c, FILE *out)
{
    fprintf(out, "\n%-26s %10s %12s %10s %10s\n", "mesh", "loss [W]", "speed [m/s]",
            "force [N]", "teeth [Hz]");
    for (int i = 0; i < c->n_elements; i++) {
        const gm_element_loss *e = &c->elements[i];
        if (e->kind == GM_LOSS_MESH && !is_small(c, e))
            fprintf(out, "  %-24s %10.3f %12.2f %10.0f %10.1f\n", e->name, e->power,
                    e->speed, e->radial, e->frequency);
    }
}

static int is_bearing(const gm_element_loss *e)
{
    return e->kind == GM_LOSS_BEARING || e->kind == GM_LOSS_IDLER;
}

static void print_bearings(const gm_checked_point *c, FILE *out)
{
    fprintf(out, "\n%-26s %10s %12s %10s %10s\n", "bearing", "loss [W]", "speed [rpm]",
            "radial [N]", "axial [N]");
    for (int i = 0; i < c->n_elements; i++) {
        const gm_element_loss *e = &c->elements[i];
        if (is_bearing(e) && !is_small(c, e))
            fprintf(out, "  %-24s %10.3f %12.0f %10.0f %10.0f\n", e->name, e->power,
                    e->speed * RPM_PER_RAD_S, e->radial, e->axial);
    }
}

static int is_drag(const gm_element_loss *e)
{
    return e->kind != GM_LOSS_MESH && !is_bearing(e);
}

/* The heading only when something follows it. */
static void print_drags(const gm_checked_point *c, FILE *out)
{
    int n = 0;
    for (int i = 0; i < c->n_elements; i++) {
        const gm_element_loss *e = &c->elements[i];
        if (!is_drag(e) || is_small(c, e))
            continue;
        if (n++ == 0)
            fprintf(out, "\n%-26s %10s %12s  %s\n", "drag", "loss [W]", "speed [rpm]",
                    "component");
        fprintf(out, "  %-24s %10.3f %12.0f  %s\n", e->name, e->power,
                e->speed * RPM_PER_RAD_S, gm_loss_kind_name(e->kind));
    }
}

static void print_rest(const gm_checked_point *c, FILE *out)
{
    int n = 0;
    for (int i = 0; i < c->n_elements; i++)
        n += is_small(c, &c->elements[i]);
    if (n > 0)
        fprintf(out, "\n%d other parts lose less than %g %% each (all: --json)\n", n,
                100.0 * SMALL_SHARE);
}

void gm_checked_point_print(const gm_checked_point *point, FILE *out)
{
    print_head(point, out);
    print_components(point, out);
    print_meshes(point, out);
    print_bearings(point, out);
    print_drags(point, out);
    print_rest(point, out);
}

static void element_json(const gm_element_loss *e, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_text(json, "name", e->name);
    gm_json_text(json, "kind", gm_loss_kind_name(e->kind));
    gm_json_number(json, "loss_W", e->power);
    if (e->kind == GM_LOSS_MESH) {
        gm_json_number(json, "speed_m_s", e->speed);
        gm_json_number(json, "force_N", e->radial);
        gm_json_number(json, "frequency_Hz", e->frequency);
    } else {
        gm_json_number(json, "speed_rpm", e->speed * RPM_PER_RAD_S);
    }
    if (is_bearing(e)) {
        gm_json_number(json, "radial_load_N", e->radial);
        gm_json_number(json, "axial_load_N", e->axial);
    }
    gm_json_end(json);
}

static void operation_json(const gm_checked_point *point, gm_json *json)
{
    const gm_point_request *r = &point->request;
    gm_json_text(json, "path", point->path);
    gm_json_integer(json, "gear", r->gear);
    gm_json_integer(json, "preselected", r->preselected);
    gm_json_number(json, "speed_rpm", r->speed * RPM_PER_RAD_S);
    gm_json_number(json, "torque_Nm", r->torque);
    gm_json_number(json, "output_speed_rpm", point->output_speed * RPM_PER_RAD_S);
    gm_json_number(json, "output_torque_Nm", -point->output_torque);
    gm_json_number(json, "loss_W", point->loss);
    gm_json_number(json, "loss_at_input_Nm", point->loss / fabs(r->speed));
    gm_json_number(json, "efficiency", gm_checked_point_efficiency(point));
}

void gm_checked_point_json(const gm_checked_point *point, const char *key, gm_json *json)
{
    gm_json_object(json, key);
    operation_json(point, json);
    gm_json_object(json, "components_W");
    for (int k = 0; k < GM_LOSS_KINDS; k++)
        gm_json_number(json, gm_loss_kind_name((gm_loss_kind)k),
                       gm_checked_point_power(point, (gm_loss_kind)k));
    gm_json_end(json);
    gm_json_array(json, "elements");
    for (int i = 0; i < point->n_elements; i++)
        element_json(&point->elements[i], json);
    gm_json_end(json);
    gm_json_end(json);
}
