/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Gearsets that are no layshaft gearboxes, swept and verified: an automatic of two
 * planetary sets, whose gears bring inertia of their own; paths without neutral.
 */
#include "description_fixture.h"
#include "model/gm_gearset.h"
#include "planetary_fixture.h"
#include "plant/gm_builtin.h"
#include "property.h"
#include "reduced_probe.h"
#include "sweep/gm_sweep.h"

#include <stdio.h>

#define FILE_NAME GM_BINARY_DIR "/test_sweep_topology.yaml"

typedef struct swept {
    char text[32768];
    gm_description *d;
    gm_gearset *gearset;
    gm_plant *plant;
    gm_map *map;
    gm_map_view *view;
} swept;

static void sweep(swept *s)
{
    const gm_sweep_options options = {0};
    gm_error error = {GM_OK, ""};
    gm_test_spill(FILE_NAME, s->text);
    s->d = gm_test_read(FILE_NAME);
    gm_status status = gm_gearset_create(s->d, 353.15, &s->gearset, &error);
    if (status == GM_OK)
        status = gm_builtin_create(s->gearset, &s->plant, &error);
    if (status == GM_OK)
        status =
            gm_sweep_run(s->plant, &options, NULL, NULL, NULL, &s->map, NULL, &error);
    if (status == GM_OK)
        status = gm_map_view_create(s->map, &s->view, &error);
    if (status != GM_OK)
        fail_msg("%s", error.message);
}

static void clear(swept *s)
{
    gm_map_view_destroy(s->view);
    gm_map_destroy(s->map);
    gm_builtin_destroy(s->plant);
    gm_gearset_destroy(s->gearset);
    gm_description_destroy(s->d);
}

/* The bars of the project: 0.5 % of a case's largest loss, 2 % for free shafts, 5 % where
 * both paths carry load. 3 % for the reaction on the output: where a single idler makes
 * it, 0.02 N.m, its kinks are large beside it. */
static void is_faithful(const swept *s)
{
    static const double largest[GM_VERIFY_GROUPS] = {5e-3, 5e-3, 5e-2, 2e-2, 3e-2};
    reduced_probe of = {.view = s->view, .loss_factor = 1.0};
    const gm_reduced_probe probe = {reduced_probe_at, &of};
    gm_verify_result result;
    gm_error error = {GM_OK, ""};
    if (gm_verify_steady(s->plant, &probe, 1000, 5, &result, &error) != GM_OK)
        fail_msg("%s", error.message);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++)
        if (!(result.max_relative[g] <= largest[g]))
            fail_msg("%s: %g", gm_verify_group_name((gm_verify_group)g),
                     result.max_relative[g]);
    gm_verify_result_clear(&result);
}

/* J_s of every gear: what the map adds up is what the bodies have. */
static void inertias_add_up(const swept *s)
{
    const gm_map_path *path = &s->map->paths[0];
    for (int g = 0; g < path->n_gears; g++) {
        const int gear[GM_MAX_INPUT_PATHS] = {path->gears[g].number, 0};
        const double r = path->gears[g].ratio;
        gm_kinematics k;
        assert_int_equal(gm_gearset_kinematics(s->gearset, gear, &k, NULL), GM_OK);
        check_close("J_s",
                    s->map->inertia_output + r * r * path->inertia +
                        path->gears[g].inertia_extra,
                    k.inertia_total, 1e-12);
    }
}

static void an_automatic_is_reduced(void **state)
{
    (void)state;
    static const char *const shafts[] = {"in", "suns", "front", "rear", "out", NULL};
    const planetary_set front = {"f", "suns", "out", "front", 33, 75, 3, 100.0};
    const planetary_set rear = {"r", "suns", "rear", "out", 33, 75, 3, 200.0};
    const char *wet = "friction_surfaces: 6, inner_radius_mm: 70, outer_radius_mm: 85, "
                      "clearance_mm: 0.2";
    char rest[2048];
    swept s;
    planetary_text t;
    planetary_begin(&t, s.text, sizeof s.text);
    t.friction = 1;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add_set(&t, &front);
    planetary_add_set(&t, &rear);
    (void)snprintf(rest, sizeof rest,
                   "clutches:\n  forward: {shaft: in, on: front, torque_capacity_Nm: 400,"
                   "\n    %s}\n  direct: {shaft: in, on: suns, torque_capacity_Nm: 400,"
                   "\n    %s}\n  band: {shaft: suns, torque_capacity_Nm: 400}\n"
                   "  low: {shaft: rear, torque_capacity_Nm: 600}\n"
                   "paths:\n  input:\n    shaft: in\n    gears:\n"
                   "      -1: {lock: [direct, low]}\n      0: {lock: low}\n"
                   "      1: {lock: [forward, low]}\n      2: {lock: [forward, band]}\n"
                   "      3: {lock: [forward, direct]}\noutput: out\n",
                   wet, wet);
    planetary_end(&t, shafts, rest);
    sweep(&s);
    inertias_add_up(&s);
    assert_true(gm_map_has_neutral(s.map, 0));
    assert_true(s.map->paths[0].gears[1].inertia_extra == 0.0);  /* low stays closed */
    assert_true(s.map->paths[0].gears[2].inertia_extra < -1e-3); /* band holds the suns */
    is_faithful(&s);
    clear(&s);
}

/* The ring is always held, the sun driven. */
static void a_planetary_reducer_without_neutral_is_reduced(void **state)
{
    (void)state;
    static const char *const shafts[] = {"sun", "carrier", "ring", NULL};
    const planetary_set set = {"p", "sun", "carrier", "ring", 33, 75, 3, 150.0};
    swept s;
    planetary_text t;
    planetary_begin(&t, s.text, sizeof s.text);
    t.friction = 1;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add_set(&t, &set);
    planetary_end(&t, shafts,
                  "clutches:\n  fixed: {shaft: ring, torque_capacity_Nm: 600}\n"
                  "paths:\n  input:\n    shaft: sun\n    gears:\n"
                  "      0: {lock: fixed}\n      1: {lock: fixed, ratio: 3.2727}\n"
                  "output: carrier\n");
    sweep(&s);
    inertias_add_up(&s);
    assert_false(gm_map_has_neutral(s.map, 0));
    assert_int_equal(s.map->n_tables, 4); /* D and P, forward and backward */
    assert_true(s.map->paths[0].gears[0].inertia_extra == 0.0);
    const gm_reduced_map *reduced = gm_map_view_reduced(s.view);
    assert_false(gm_reduced_has_neutral(reduced, 0));
    is_faithful(&s);
    clear(&s);
}

/* A machine that is always in mesh beside a path with a synchroniser. */
static const char hybrid[] =
    "format: 1\nname: hybrid\n"
    "limits: {input_speed_max_rpm: 6000, input_torque_max_Nm: 100}\n"
    "oil: {viscosity_40_mm2_s: 30.8, viscosity_100_mm2_s: 5.9, density_15_kg_m3: 845}\n"
    "shafts:\n"
    "  engine: {y_mm: 0, z_mm: 0, segments: [{from_mm: 0, to_mm: 100, diameter_mm: "
    "25}]}\n"
    "  driven: {y_mm: 60, z_mm: 0, segments: [{from_mm: 0, to_mm: 100, diameter_mm: "
    "30}]}\n"
    "  motor: {y_mm: 110, z_mm: 0, segments: [{from_mm: 0, to_mm: 100, diameter_mm: "
    "25}]}\n"
    "gears:\n"
    "  a: {shaft: engine, teeth: 20, normal_module_mm: 2, width_mm: 20, position_mm: "
    "30}\n"
    "  b: {shaft: driven, teeth: 40, normal_module_mm: 2, width_mm: 20, position_mm: "
    "30,\n"
    "    idles: true, bearing: {type: needle_roller, bore_mm: 30, outer_mm: 35,\n"
    "    width_mm: 16}}\n"
    "  c: {shaft: driven, teeth: 30, normal_module_mm: 2, width_mm: 20, position_mm: "
    "70}\n"
    "  e: {shaft: motor, teeth: 20, normal_module_mm: 2, width_mm: 20, position_mm: 70}\n"
    "meshes:\n  first: {gears: [a, b]}\n  electric: {gears: [c, e]}\n"
    "bearings:\n"
    "  ef: {shaft: engine, position_mm: 8, locating: true, type: deep_groove_ball,\n"
    "    designation: \"6205\"}\n"
    "  er: {shaft: engine, position_mm: 92, type: deep_groove_ball, designation: "
    "\"6205\"}\n"
    "  df: {shaft: driven, position_mm: 8, locating: true, type: deep_groove_ball,\n"
    "    designation: \"6206\"}\n"
    "  dr: {shaft: driven, position_mm: 92, type: deep_groove_ball, designation: "
    "\"6206\"}\n"
    "  mf: {shaft: motor, position_mm: 8, locating: true, type: deep_groove_ball,\n"
    "    designation: \"6205\"}\n"
    "  mr: {shaft: motor, position_mm: 92, type: deep_groove_ball, designation: "
    "\"6205\"}\n"
    "synchronisers:\n  s: {shaft: driven, gears: [b], cone_torque_Nm: 30, "
    "cone_radius_mm: "
    "30,\n    cone_width_mm: 8, cone_clearance_mm: 0.2}\n"
    "paths:\n  odd: {shaft: engine, gears: {1: {lock: b}}}\n"
    "  even: {shaft: motor, gears: {2: {lock: []}}}\n"
    "output: driven\n";

static void one_path_of_two_can_do_without_neutral(void **state)
{
    (void)state;
    swept s;
    (void)snprintf(s.text, sizeof s.text, "%s", hybrid);
    sweep(&s);
    assert_true(gm_map_has_neutral(s.map, 0));
    assert_false(gm_map_has_neutral(s.map, 1));
    is_faithful(&s);
    clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_automatic_is_reduced),
        cmocka_unit_test(a_planetary_reducer_without_neutral_is_reduced),
        cmocka_unit_test(one_path_of_two_can_do_without_neutral),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
