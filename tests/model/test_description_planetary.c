/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random planetary descriptions: valid ones are gearsets with Willis' ratios and a finite
 * balance, each with one thing wrong is refused for that reason.
 */
#include "property.h"

#include "description_fixture.h"
#include "model/gm_gearset.h"
#include "planetary_fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_NAME GM_BINARY_DIR "/test_description_planetary.yaml"
enum { ROUNDS = 300 }; /* with the 200 of tests/variations.py: 500 */

static const char *const shafts[] = {"in", "sun", "carrier", "ring", NULL};

typedef struct draw {
    int z_sun, z_ring, planets, held, from, to;
} draw;

static int pick(uint64_t *state, int low, int high)
{
    return low + (int)random_between(state, 0.0, high - low + 1.0);
}

static int fits(const draw *d)
{
    int z_p = (d->z_ring - d->z_sun) / 2;
    double r = 0.5 * (d->z_sun + d->z_ring), tip = 2.0 * z_p + 4.0;
    return (d->z_ring - d->z_sun) % 2 == 0 && z_p >= 15 &&
           (d->z_sun + d->z_ring) % d->planets == 0 &&
           2.0 * r * sin(3.14159265358979323846 / d->planets) > tip + 0.5;
}

static draw draw_set(uint64_t *state)
{
    draw d;
    do
        d = (draw){.z_sun = pick(state, 18, 50),
                   .z_ring = pick(state, 60, 120),
                   .planets = pick(state, 2, 6)};
    while (!fits(&d));
    d.held = pick(state, 0, 2);
    d.from = (d.held + pick(state, 1, 2)) % 3;
    d.to = 3 - d.held - d.from;
    return d;
}

static double willis(const draw *d)
{
    double i = -(double)d->z_ring / d->z_sun, w[3];
    w[d->held] = 0.0;
    w[d->to] = 1.0;
    /* w_s - w_c = i (w_r - w_c), members 0 sun, 1 carrier, 2 ring */
    if (d->from == 0)
        w[0] = w[1] + i * (w[2] - w[1]);
    else if (d->from == 1)
        w[1] = (w[0] - i * w[2]) / (1.0 - i);
    else
        w[2] = w[1] + (w[0] - w[1]) / i;
    return w[d->from];
}

static void write_set(const draw *d, uint64_t *state, char *text, size_t size)
{
    char rest[640];
    planetary_text t;
    planetary_set set = {"p",      "sun",     "carrier",  "ring",
                         d->z_sun, d->z_ring, d->planets, random_between(state, 60, 240)};
    planetary_begin(&t, text, size);
    t.friction = pick(state, 0, 1);
    t.efficiency = pick(state, 0, 1) ? random_between(state, 0.97, 1.0) : 0.0;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add_set(&t, &set);
    (void)snprintf(
        rest, sizeof rest,
        "clutches:\n  drive: {shaft: in, on: %s, torque_capacity_Nm: %.6g}\n"
        "  brake: {shaft: %s, torque_capacity_Nm: %.6g, friction_surfaces: %d,\n"
        "    inner_radius_mm: 50, outer_radius_mm: %.6g, clearance_mm: 0.2}\n"
        "paths:\n  input:\n    shaft: in\n    gears:\n"
        "      0: {lock: [brake]}\n      1: {lock: [drive, brake]}\n"
        "output: %s\n",
        shafts[1 + d->from], random_scale(state, 10.0, 1e4), shafts[1 + d->held],
        random_scale(state, 10.0, 1e4), pick(state, 1, 20),
        random_between(state, 51.0, 120.0), shafts[1 + d->to]);
    planetary_end(&t, shafts, rest);
}

static void check_balance(const gm_gearset *g, double ratio)
{
    gm_balance *balance;
    double x[16] = {0.0};
    gm_steady_result result;
    gm_steady_point point = {
        .gear = {1}, .speed = {200.0 / ratio}, .torque = {0.0, 50.0}};
    point.direction[0] = point.speed[0];
    assert_int_equal(gm_balance_create(g, &balance, NULL), GM_OK);
    assert_int_equal(gm_balance_set_point(balance, &point, NULL), GM_OK);
    for (int i = 0; i < 100 && gm_balance_pass(balance, x) > 1e-13; i++)
        continue;
    gm_balance_result(balance, x, &result);
    double in = result.torque[1] * result.speed[1];
    double out = -result.torque[0] * result.speed[0];
    assert_true(isfinite(out) && out <= in && out > 0.3 * in);
    gm_balance_destroy(balance);
}

static void check_valid(const draw *d)
{
    gm_description *description = gm_test_read(FILE_NAME);
    gm_gearset *g = NULL;
    gm_kinematics k;
    gm_error error = {GM_OK, ""};
    if (gm_gearset_create(description, 353.15, &g, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(gm_gearset_kinematics(g, (const int[]){1, 0}, &k, NULL), GM_OK);
    check_close("ratio", k.ratio[0], willis(d), 1e-12);
    assert_true(isfinite(k.inertia_total) && k.inertia_total > k.inertia_output);
    check_balance(g, k.ratio[0]);
    gm_gearset_destroy(g);
    gm_description_destroy(description);
}

/* One change, and what must be said of it. */
static const struct {
    const char *find, *replace, *sentence;
} faults[] = {
    {"planets: ", "planets: 2", "a whole number from 0 to 12"}, /* 22 to 26 */
    {"pin_radius_mm: ", "pin_radius_mm: 1", "the centre distance from teeth"},
    {"normal_module_mm: 2, ", "normal_module_mm: 2.5, ", "have the same normal module"},
    {"internal: true,", "internal: false,", "the centre distance from teeth"},
    {"internal: true,", "internal: true, helix_deg: 5,",
     "helix angles must be equal with internal teeth"},
    {"internal: true,", "internal: true, idles: true,", "an idling gear needs a bearing"},
    {"in: {y_mm: 0", "in: {y_mm: 3", "must be concentric within"},
    {"ring: {y_mm: 0", "ring: {y_mm: 3", "must be concentric"},
    {"1: {lock: [drive, brake]}", "1: {lock: [drive]}", "nothing determines the speed"},
    {"1: {lock: [drive, brake]}", "1: {lock: [brake, brake]}", "locks twice 'brake'"},
    {"1: {lock: [drive, brake]}", "1: {lock: [drive, break]}", "did you mean 'brake'?"},
    {"1: {lock: [drive, brake]}", "1: {lock: [drive, p_sun]}",
     "only an idling gear can be locked"},
    {"1: {lock: [drive, brake]}", "1: {lock: {}}", "lock must be the name of a gear"},
    {"1: {lock: [drive, brake]}", "1: {lock: [[drive]]}", "lock must be the name"},
    {"1: {lock: [drive, brake]}", "1: {lock: [drive, brake], ratio: 0.01}",
     "the gears make"},
    {"0: {lock: [brake]}", "0: {lock: []}",
     "in neutral its speed follows from no flange"},
    {"0: {lock: [brake]}", "0: {lock: [drive]}", "couples the output and input"},
    {"0: {lock: [brake]}", "0: {lock: [drive, brake], ratio: 2}", "neutral has no ratio"},
    {"friction_surfaces: ", "friction_surfaces: -", "a whole number from 0 to 100"},
    {"inner_radius_mm: 50", "inner_radius_mm: 130", "must be less than outer_radius_mm"},
    {"  drive: {shaft: in, on: ", "  drive: {shaft: in, onto: ", "unknown key 'onto'"},
    {"clutches:\n", "clutches:\n  p_ring: {shaft: in, on: sun, torque_capacity_Nm: 5}\n",
     "a gear in line"},
};
enum { FAULTS = sizeof faults / sizeof faults[0] };

static gm_status read_and_assemble(gm_error *error)
{
    gm_description *d = NULL;
    gm_gearset *g = NULL;
    gm_status status = gm_description_read(FILE_NAME, &d, error);
    if (status == GM_OK)
        status = gm_gearset_create(d, 353.15, &g, error);
    gm_gearset_destroy(g);
    gm_description_destroy(d);
    return status;
}

static void check_fault(const char *text, int fault)
{
    gm_error error = {GM_OK, ""};
    char *wrong = gm_test_replaced(text, faults[fault].find, faults[fault].replace);
    gm_test_spill(FILE_NAME, wrong);
    free(wrong);
    gm_status status = read_and_assemble(&error);
    if (status != GM_ERR_FORMAT && status != GM_ERR_MODEL)
        fail_msg("not refused: %s", faults[fault].replace);
    if (!strstr(error.message, faults[fault].sentence) ||
        strncmp(error.message, FILE_NAME ":", sizeof FILE_NAME) != 0)
        fail_msg("'%s' does not say '%s'", error.message, faults[fault].sentence);
}

static void valid_ones_are_taken_and_each_fault_is_told(void **state)
{
    (void)state;
    uint64_t random = 2025;
    for (int i = 0; i < ROUNDS; i++) {
        char text[16384];
        draw d = draw_set(&random);
        write_set(&d, &random, text, sizeof text);
        gm_test_spill(FILE_NAME, text);
        if (i % 2 == 0)
            check_valid(&d);
        else
            check_fault(text, i / 2 % FAULTS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(valid_ones_are_taken_and_each_fault_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
