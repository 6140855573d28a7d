/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Planets as parts of the assembled gearset: bodies, loads, inertia, brakes and clutches;
 * paths without neutral. Efficiencies are in tests/solve/test_planetary.c.
 */
#include "property.h"

#include "base/alloc.h"
#include "description_fixture.h"
#include "model/gearset.h"
#include "planetary_fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_NAME GM_BINARY_DIR "/test_planets.yaml"

static const char *const shafts[] = {"in", "sun", "carrier", "ring", NULL};

/* Ring on a brake, sun driven through a clutch, carrier is the output. */
#define LOCKS                                                                            \
    "clutches:\n  drive: {shaft: in, on: sun, torque_capacity_Nm: 300}\n"                \
    "  brake: {shaft: ring, torque_capacity_Nm: 90, friction_surfaces: 8,\n"             \
    "    inner_radius_mm: 45, outer_radius_mm: 60, clearance_mm: 0.15}\n"

typedef struct assembled {
    char text[16384];
    gm_description *d;
    gm_gearset *g;
} assembled;

static gm_status build(assembled *a, const char *rest, gm_error *error)
{
    const planetary_set set = {"p", "sun", "carrier", "ring", 33, 75, 3, 150.0};
    planetary_text t;
    planetary_begin(&t, a->text, sizeof a->text);
    t.efficiency = 1.0;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add_set(&t, &set);
    planetary_end(&t, shafts, rest);
    gm_test_spill(FILE_NAME, a->text);
    gm_status status = gm_description_read(FILE_NAME, &a->d, error);
    if (status != GM_OK)
        return status;
    status = gm_gearset_create(a->d, 353.15, &a->g, error);
    if (status != GM_OK)
        gm_description_destroy(a->d);
    return status;
}

static void make(assembled *a, const char *rest)
{
    gm_error error = {GM_OK, ""};
    if (build(a, rest, &error) != GM_OK)
        fail_msg("%s", error.message);
}

static void clear(assembled *a)
{
    gm_gearset_destroy(a->g);
    gm_description_destroy(a->d);
}

static const gm_element_loss *element(const gm_element_loss *losses, int n,
                                      const char *name)
{
    for (int i = 0; i < n; i++)
        if (strcmp(losses[i].name, name) == 0)
            return &losses[i];
    fail_msg("no element %s", name);
    return NULL;
}

#define GEARS                                                                            \
    "paths:\n  input:\n    shaft: in\n    gears:\n      0: {lock: brake}\n"              \
    "      1: {lock: [drive, brake]}\noutput: carrier\n"

/* Torque T on the sun: each of three planets gets F_bt = T / (3 r_b) from sun and ring,
 * which push its pin with 2 F_bt cos(alpha) tangentially (their radial parts cancel);
 * outwards pulls m w_c^2 r. Sun, ring and carrier get nothing across but weight. */
static void loads_by_hand(void **state)
{
    (void)state;
    assembled a;
    make(&a, LOCKS GEARS);
    const double T = 100.0, w_in = 300.0, alpha = 20.0 * 3.14159265358979323846 / 180.0;
    gm_balance *balance;
    double x[16] = {0.0};
    gm_element_loss losses[32];
    gm_steady_point point = {.gear = {1}, .torque = {0.0, T}};
    point.speed[0] = w_in / (1.0 + 75.0 / 33.0);
    point.direction[0] = 1.0;
    assert_int_equal(gm_balance_create(a.g, &balance, NULL), GM_OK);
    assert_int_equal(gm_balance_set_point(balance, &point, NULL), GM_OK);
    while (gm_balance_pass(balance, x) > 1e-14)
        continue;
    gm_balance_losses(balance, x, losses);
    int n = gm_gearset_element_count(a.g);
    double F_bt = T / (3.0 * 0.033 * cos(alpha));
    check_close("force of a mesh", element(losses, n, "p_inner")->radial, F_bt, 1e-9);
    check_close("force of a mesh", element(losses, n, "p_outer")->radial, F_bt, 1e-9);
    double mass = gm_wheel_mass(a.d, &a.d->wheels[1]);
    double pull = mass * point.speed[0] * point.speed[0] * 0.054;
    check_close("pin", element(losses, n, "p_planet")->radial,
                hypot(2.0 * F_bt * cos(alpha), pull), 1e-9);
    check_close("speed of the pin", element(losses, n, "p_planet")->speed,
                fabs(w_in - point.speed[0]) * 33.0 / 21.0, 1e-9);
    /* half of 1 kg and of the sun at 150 mm, between bearings at 10 and 290 mm */
    double sun = gm_wheel_mass(a.d, &a.d->wheels[0]);
    check_close("sun", element(losses, n, "sun_front")->radial, 0.5 * (1.0 + sun) * 9.81,
                1e-9);
    check_close("carrier", element(losses, n, "carrier_rear")->radial,
                0.5 * (1.0 + 3.0 * mass) * 9.81, 1e-9);
    gm_balance_destroy(balance);
    clear(&a);
}

/* By hand from Willis: J at the carrier with the ring held. */
static double inertia_by_hand(const assembled *a)
{
    const gm_wheel *planet = &a->d->wheels[1];
    double m = gm_wheel_mass(a->d, planet), r = 0.054;
    double J_p = a->g->bodies[a->g->wheel_body[1]].inertia;  /* of all three */
    double w_s = 1.0 + 75.0 / 33.0, w_p = 1.0 - 75.0 / 21.0; /* rolls in the ring */
    return a->g->bodies[1].inertia * w_s * w_s + J_p * w_p * w_p + 3.0 * m * r * r + 3e-3;
}

static void inertia_follows_willis(void **state)
{
    (void)state;
    assembled a;
    gm_kinematics k;
    make(&a, LOCKS GEARS);
    assert_int_equal(gm_gearset_kinematics(a.g, (const int[]){1, 0}, &k, NULL), GM_OK);
    check_close("ratio", k.ratio[0], 1.0 + 75.0 / 33.0, 1e-12);
    check_close("output", k.inertia_output, inertia_by_hand(&a), 1e-12);
    check_close("input", k.inertia[0], 1e-3, 1e-12);
    check_close("together", k.inertia_total,
                inertia_by_hand(&a) + 1e-3 * pow(k.ratio[0], 2), 1e-12);
    assert_true(gm_extra_inertia(&k) == 0.0);
    clear(&a);
}

/* Neutral holds the ring, gear 2 the sun: the sun and the ring change places. */
static void gears_that_release_parts_have_inertia_of_their_own(void **state)
{
    (void)state;
    assembled a;
    gm_kinematics k;
    make(&a, "clutches:\n  drive: {shaft: in, on: ring, torque_capacity_Nm: 300}\n"
             "  hold_ring: {shaft: ring, torque_capacity_Nm: 300}\n"
             "  hold_sun: {shaft: sun, torque_capacity_Nm: 300}\n"
             "paths:\n  input:\n    shaft: in\n    gears:\n      0: {lock: hold_ring}\n"
             "      1: {lock: [drive, hold_sun]}\noutput: carrier\n");
    assert_int_equal(gm_gearset_kinematics(a.g, (const int[]){1, 0}, &k, NULL), GM_OK);
    double w_r = 1.0 + 33.0 / 75.0, w_s = 1.0 + 75.0 / 33.0;
    double J_p = a.g->bodies[a.g->wheel_body[1]].inertia;
    double turns = pow(1.0 + 33.0 / 21.0, 2) - pow(1.0 - 75.0 / 21.0, 2);
    check_close("ratio", k.ratio[0], w_r, 1e-12);
    check_close("extra", gm_extra_inertia(&k),
                a.g->bodies[3].inertia * w_r * w_r - a.g->bodies[1].inertia * w_s * w_s +
                    J_p * turns,
                1e-9);
    clear(&a);
}

/* Gear 1 closes a clutch of 300 N.m between input and sun; the brake is closed already.
 * A brake of 90 N.m that stays closed in neutral has nothing to synchronise. */
static void capacity_is_that_of_what_closes(void **state)
{
    (void)state;
    assembled a;
    make(&a, LOCKS GEARS);
    check_close("capacity", gm_gearset_sync_torque(a.g, 0), 300.0, 1e-12);
    clear(&a);
}

static void a_path_whose_gear_locks_what_neutral_locks_has_none(void **state)
{
    (void)state;
    assembled a;
    gm_kinematics k;
    make(&a, "clutches:\n  drive: {shaft: in, on: sun, torque_capacity_Nm: 300}\n"
             "  brake: {shaft: ring, torque_capacity_Nm: 90}\n"
             "paths:\n  input:\n    shaft: in\n    gears:\n"
             "      0: {lock: [brake, drive]}\n"
             "      1: {lock: [drive, brake]}\noutput: carrier\n");
    assert_false(a.d->paths[0].has_neutral);
    assert_int_equal(gm_path_rest_gear(&a.d->paths[0]), 1);
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_gearset_kinematics(a.g, (const int[]){0, 0}, &k, &error),
                     GM_ERR_ARGUMENT);
    assert_non_null(strstr(error.message, "path 'input' has no gear 0"));
    assert_int_equal(gm_gearset_kinematics(a.g, (const int[]){1, 0}, &k, &error), GM_OK);
    check_close("its own", k.inertia[0], 1e-3, 1e-12);
    check_close("sum", k.inertia_output + pow(k.ratio[0], 2) * k.inertia[0],
                k.inertia_total, 1e-12);
    assert_true(isinf(gm_gearset_sync_torque(a.g, 0)));
    clear(&a);
}

/* ---- what is refused ---- */

typedef struct refused {
    const char *rest, *sentence;
} refused;

#define PATHS "paths:\n  input:\n    shaft: in\n    gears:\n"

static const refused wrong[] = {
    {LOCKS "paths:\n  input:\n    shaft: sun\n    gears:\n      1: {lock: brake}\n"
           "output: carrier\n",
     "shaft 'in': no flange reaches it through meshes: its speed would not be known"},
    {LOCKS PATHS "      1: {lock: [drive, brake]}\noutput: carrier\n",
     "shaft 'sun': in neutral its speed follows from no flange; a path must lock one "
     "more part in neutral (gear 0)"},
    {LOCKS PATHS "      0: {lock: drive}\n      1: {lock: [drive, brake]}\n"
                 "output: carrier\n",
     "with gears (0, 0) the inertia of parts between them couples the output and input"},
    {LOCKS PATHS "      0: {lock: brake}\n      1: {lock: [drive]}\noutput: carrier\n",
     "gear 1: nothing determines the speed of 'in'; one more part must be locked"},
    {LOCKS PATHS "      0: {lock: brake}\n      1: {lock: [drive, brake, brake]}\n"
                 "output: carrier\n",
     "gear 1: locks twice 'brake'"},
    {LOCKS PATHS
     "      0: {lock: brake}\n      1: {lock: brake}\n      2: {lock: drive}\n"
     "output: carrier\n",
     "gear 1: locks what is locked in neutral, found 'brake'; only a path with one gear "
     "can do without neutral"},
    {LOCKS PATHS "      0: {lock: brake}\n      1: {lock: break}\noutput: carrier\n",
     "lock must be the name of a gear or a clutch, or a list of such names, found "
     "'break'; did you mean 'brake'?"},
    {LOCKS PATHS "      0: {lock: brake}\noutput: carrier\n",
     "path 'input': needs at least 1 gear besides neutral, found 0"},
    {LOCKS PATHS
     "      0: {lock: brake}\n      1: {lock: [drive, brake]}\noutput: ring\n",
     "what is locked in neutral holds the output 'ring'"},
    {LOCKS PATHS "      0: {lock: brake}\n      1: {lock: [drive, brake, p_planet]}\n"
                 "output: carrier\n",
     "gear 1: no synchroniser locks gear 'p_planet'; expected 1, found 0"},
    {LOCKS PATHS "      0: {lock: brake}\n      1: {lock: [brake, p_sun]}\n"
                 "output: carrier\n",
     "gear 1: only an idling gear can be locked; found the fixed gear 'p_sun'"},
    {"clutches:\n  drive: {shaft: in, on: in, torque_capacity_Nm: 300}\n" PATHS
     "      1: {lock: drive}\noutput: carrier\n",
     "clutch 'drive': must connect two different shafts, found 'in' twice"},
    {"clutches:\n  p_sun: {shaft: in, on: sun, torque_capacity_Nm: 300}\n" PATHS
     "      1: {lock: p_sun}\noutput: carrier\n",
     "clutch 'p_sun': a gear in line"},
    {"clutches:\n  drive: {shaft: in, on: sun, torque_capacity_Nm: 300,\n"
     "    clearance_mm: 1}\n" PATHS "      1: {lock: drive}\noutput: carrier\n",
     "clutch 'drive': radii, clearance and oil feed have an effect only with "
     "friction_surfaces, found 0 of them"},
    {"clutches:\n  drive: {shaft: in, on: sun, torque_capacity_Nm: 300,\n"
     "    friction_surfaces: 2}\n" PATHS "      1: {lock: drive}\noutput: carrier\n",
     "clutch 'drive': friction surfaces need inner_radius_mm, outer_radius_mm and "
     "clearance_mm"},
    {"clutches:\n  drive: {shaft: in, on: sun, torque_capacity_Nm: 300,\n"
     "    friction_surfaces: 2, inner_radius_mm: 50, outer_radius_mm: 40, "
     "clearance_mm: 1}\n" PATHS "      1: {lock: drive}\noutput: carrier\n",
     "clutch 'drive': inner_radius_mm must be less than outer_radius_mm; found 50 and "
     "40"},
};

static void what_cannot_move_is_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assembled a;
        gm_error error = {GM_OK, ""};
        if (build(&a, wrong[i].rest, &error) == GM_OK)
            fail_msg("taken: %s", wrong[i].sentence);
        if (!strstr(error.message, wrong[i].sentence) ||
            !strstr(error.message, FILE_NAME ":"))
            fail_msg("'%s' does not say '%s'", error.message, wrong[i].sentence);
    }
}

/* One change of the valid gearset, and its sentence. */
static const struct {
    const char *find, *replace, *sentence;
} changes[] = {
    {"planets: 3", "planets: 0", "pin_radius_mm and pin_angle_deg have an effect only"},
    {"planets: 3", "planets: 1", "there are 2 or more; found 1"},
    {"planets: 3", "planets: 5",
     "5 planets stand evenly only where the teeth of sun and ring add up to a multiple "
     "of "
     "5; found 33 ('p_sun') and 75 ('p_ring')"},
    {"planets: 3", "planets: 8",
     "planets side by side must not touch; found tip diameter 46 mm, their axes 41.3298 "
     "mm apart"},
    {"pin_radius_mm: 54", "pin_angle_deg: 54", "a planet needs pin_radius_mm"},
    {"pin_radius_mm: 54", "pin_radius_mm: 53",
     "must be that of the axes of 'p_sun' and 'p_planet' within 0.02 mm; found 54.0000 "
     "mm "
     "from the gears, 53.0000 mm from the pins"},
    {"idles: true, planets: 3", "planets: 3",
     "a planet needs idles: true and external teeth"},
    {"p_sun: {shaft: sun", "p_sun: {shaft: carrier",
     "planet 'p_planet' must not mesh with a gear that is fixed on its own carrier "
     "'carrier', found 'p_sun'"},
    {"ring: {y_mm: 0", "ring: {y_mm: 1",
     "gear 'p_ring' that meshes with planet 'p_planet' must be concentric with the "
     "carrier 'carrier' within 0.020 mm; found the axes 1.000 mm apart"},
};

static void planets_must_fit(void **state)
{
    (void)state;
    assembled a;
    make(&a, LOCKS GEARS);
    clear(&a);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        gm_error error = {GM_OK, ""};
        gm_description *d = NULL;
        char *text = gm_test_replaced(a.text, changes[i].find, changes[i].replace);
        gm_test_spill(FILE_NAME, text);
        free(text);
        assert_int_not_equal(gm_description_read(FILE_NAME, &d, &error), GM_OK);
        if (!strstr(error.message, changes[i].sentence))
            fail_msg("'%s' does not say '%s'", error.message, changes[i].sentence);
    }
}

static void memory_that_fails_is_told(void **state)
{
    (void)state;
    assembled a;
    make(&a, LOCKS GEARS);
    clear(&a);
    gm_status status = GM_ERR_MEMORY;
    int k = 1;
    for (; status == GM_ERR_MEMORY; k++) {
        gm_description *d = NULL;
        gm_gearset *g = NULL;
        gm_alloc_fail_after(k);
        status = gm_description_read(FILE_NAME, &d, NULL);
        if (status == GM_OK)
            status = gm_gearset_create(d, 353.15, &g, NULL);
        gm_alloc_fail_after(0);
        gm_gearset_destroy(g);
        gm_description_destroy(d);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
    }
    assert_true(k > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_by_hand),
        cmocka_unit_test(inertia_follows_willis),
        cmocka_unit_test(gears_that_release_parts_have_inertia_of_their_own),
        cmocka_unit_test(capacity_is_that_of_what_closes),
        cmocka_unit_test(a_path_whose_gear_locks_what_neutral_locks_has_none),
        cmocka_unit_test(what_cannot_move_is_refused),
        cmocka_unit_test(planets_must_fit),
        cmocka_unit_test(memory_that_fails_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
