/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Planetary gearsets, solved: efficiency of a simple set against Willis' closed form,
 * ratios of well-known automatics, and the power balance of random sets.
 */
#include "property.h"

#include "base/alloc.h"
#include "description_fixture.h"
#include "planetary_fixture.h"
#include "plant/gm_builtin.h"
#include "solve/gm_steady_solver.h"

#include <stdio.h>
#include <string.h>

#define FILE_NAME GM_BINARY_DIR "/test_planetary.yaml"

/* ---- a gearset with all that solves it ---- */

typedef struct solved {
    char text[32768];
    gm_description *d;
    gm_gearset *gearset;
    gm_plant *plant;
    gm_steady_solver *solver;
} solved;

static void assemble(solved *s, const planetary_text *t)
{
    gm_error error = {GM_OK, ""};
    s->d = planetary_read(t, FILE_NAME);
    if (gm_gearset_create(s->d, 353.15, &s->gearset, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(gm_builtin_create(s->gearset, &s->plant, NULL), GM_OK);
    assert_int_equal(gm_steady_solver_create(s->plant, &s->solver, NULL), GM_OK);
}

static void clear(solved *s)
{
    gm_steady_solver_destroy(s->solver);
    gm_builtin_destroy(s->plant);
    gm_gearset_destroy(s->gearset);
    gm_description_destroy(s->d);
}

/* A random gearset may have a gear that blocks or holds the input: then it is refused. */
static int try_to_assemble(solved *s)
{
    gm_error error = {GM_OK, ""};
    gm_test_spill(FILE_NAME, s->text);
    if (gm_description_read(FILE_NAME, &s->d, &error) != GM_OK) {
        assert_non_null(strstr(error.message, "hold"));
        return 0;
    }
    if (gm_gearset_create(s->d, 353.15, &s->gearset, &error) != GM_OK) {
        assert_non_null(strstr(error.message, "holds the input"));
        gm_description_destroy(s->d);
        return 0;
    }
    assert_int_equal(gm_builtin_create(s->gearset, &s->plant, NULL), GM_OK);
    assert_int_equal(gm_steady_solver_create(s->plant, &s->solver, NULL), GM_OK);
    return 1;
}

static double ratio_of(const solved *s, int number)
{
    gm_kinematics k;
    const int gear[GM_MAX_INPUT_PATHS] = {number, 0};
    assert_int_equal(gm_gearset_kinematics(s->gearset, gear, &k, NULL), GM_OK);
    return k.ratio[0];
}

static gm_steady_result solve(solved *s, int number, double w_in, double torque)
{
    gm_steady_point point = {.gear = {number}};
    gm_steady_result result;
    gm_error error = {GM_OK, ""};
    point.speed[0] = w_in / ratio_of(s, number);
    point.direction[0] = point.speed[0] < 0.0 ? -1.0 : 1.0;
    point.torque[1] = torque;
    if (gm_steady_solve(s->solver, &point, &result, &error) != GM_OK)
        fail_msg("%s", error.message);
    return result;
}

/* Flange power against the sum of all losses, relative to the power that goes through. */
static double imbalance(solved *s, const gm_steady_result *r)
{
    const double *x;
    gm_balance *work = gm_steady_solver_work(s->solver, &x);
    int n = gm_gearset_element_count(s->gearset);
    gm_element_loss *losses = gm_calloc((size_t)n, sizeof *losses);
    double in = 0.0, through = 0.0, sum = 0.0;
    assert_non_null(losses);
    gm_balance_losses(work, x, losses);
    for (int i = 0; i < n; i++) {
        assert_true(losses[i].power >= 0.0);
        sum += losses[i].power;
    }
    gm_free(losses);
    for (int i = 0; i < 2; i++) {
        in += r->torque[i] * r->speed[i];
        through += fabs(r->torque[i] * r->speed[i]);
    }
    return fabs(in - sum) / through;
}

/* ---- one set: Willis ---- */

enum { SUN, CARRIER, RING };
static const char *const member[] = {"sun", "carrier", "ring"};
static const char *const one_set[] = {"in", "sun", "carrier", "ring", NULL};

/* The input is clutched to `from`, `to` is the output, `held` on a brake. */
static void make_set(solved *s, int z_sun, int z_ring, int held, int from, int to,
                     double mesh_efficiency, int friction)
{
    char rest[512];
    planetary_text t;
    const planetary_set set = {"p", "sun", "carrier", "ring", z_sun, z_ring, 3, 150.0};
    planetary_begin(&t, s->text, sizeof s->text);
    t.efficiency = mesh_efficiency;
    t.friction = friction;
    planetary_shafts(&t, one_set);
    planetary_gears(&t);
    planetary_add_set(&t, &set);
    (void)snprintf(rest, sizeof rest,
                   "clutches:\n  drive: {shaft: in, on: %s, torque_capacity_Nm: 300}\n"
                   "  brake: {shaft: %s, torque_capacity_Nm: 300}\n"
                   "paths:\n  input:\n    shaft: in\n    gears:\n"
                   "      0: {lock: brake}\n      1: {lock: [drive, brake]}\n"
                   "output: %s\n",
                   member[from], member[held], member[to]);
    planetary_end(&t, one_set, rest);
    assemble(s, &t);
}

/* Speed ratios and efficiencies of a set with i0 = -z_r/z_s, whose meshes pass on eta0
 * with the carrier at rest. Mueller, Die Umlaufgetriebe, 1998. */
typedef struct willis {
    int held, from, to;
    double ratio;           /* in / out */
    double driving, driven; /* efficiency from -> to and back */
} willis;

static void closed_forms(double i, double e, willis w[3])
{
    w[0] = (willis){RING,
                    SUN,
                    CARRIER,
                    1.0 - i,
                    (1.0 - i * e) / (1.0 - i),
                    (1.0 - i) / (1.0 - i / e)};
    w[1] = (willis){CARRIER, SUN, RING, i, e, e};
    w[2] = (willis){SUN,
                    RING,
                    CARRIER,
                    (i - 1.0) / i,
                    (i - e) / (i - 1.0),
                    (i - 1.0) / (i - 1.0 / e)};
}

static void check_willis(const willis *w, int z_sun, int z_ring, double mesh_efficiency)
{
    for (int turned = 0; turned < 2; turned++) {
        solved s;
        int from = turned ? w->to : w->from, to = turned ? w->from : w->to;
        double ratio = turned ? 1.0 / w->ratio : w->ratio;
        double onward = turned ? w->driven : w->driving;
        double back = turned ? w->driving : w->driven;
        make_set(&s, z_sun, z_ring, w->held, from, to, mesh_efficiency, 0);
        check_close("ratio", ratio_of(&s, 1), ratio, 1e-12);
        for (int way = -1; way <= 1; way += 2) {
            gm_steady_result r = solve(&s, 1, way * 200.0, way * 100.0);
            double in = r.torque[1] * r.speed[1], out = -r.torque[0] * r.speed[0];
            check_close("efficiency, driving", out / in, onward, 1e-9);
            r = solve(&s, 1, way * 200.0, -way * 100.0);
            in = r.torque[0] * r.speed[0], out = -r.torque[1] * r.speed[1];
            check_close("efficiency, driven", out / in, back, 1e-9);
            assert_true(imbalance(&s, &r) < 1e-12);
        }
        clear(&s);
    }
}

static void efficiency_is_the_closed_form(void **state)
{
    (void)state;
    static const int teeth[][2] = {{33, 75}, {24, 84}, {45, 75}, {18, 90}};
    for (size_t k = 0; k < sizeof teeth / sizeof teeth[0]; k++) {
        double i = -(double)teeth[k][1] / teeth[k][0];
        for (double e = 0.9; e < 0.995; e += 0.03) {
            willis w[3];
            closed_forms(i, e, w);
            for (int c = 0; c < 3; c++)
                check_willis(&w[c], teeth[k][0], teeth[k][1], sqrt(e));
        }
    }
}

/* Ford C4, 33 and 72 teeth: eta0 = 0.98, sun to carrier with the ring held. Its planets
 * have 19 teeth on a pin at 52.5 mm, with the profile shifts that follow from it. */
static void shifted_set(solved *s, double efficiency)
{
    planetary_text t;
    planetary_begin(&t, s->text, sizeof s->text);
    t.efficiency = efficiency;
    planetary_shafts(&t, one_set);
    planetary_gears(&t);
    planetary_add(
        &t, "  s: {shaft: sun, teeth: 33, normal_module_mm: 2, width_mm: 20, "
            "position_mm: 100}\n"
            "  p: {shaft: carrier, teeth: 19, normal_module_mm: 2, width_mm: 20,\n"
            "      position_mm: 100, idles: true, planets: 3, pin_radius_mm: 52.5,\n"
            "      profile_shift: 0.258782, bearing: {type: needle_roller, "
            "bore_mm: 8,\n      outer_mm: 10, width_mm: 12, friction: none}}\n"
            "  r: {shaft: ring, teeth: 72, normal_module_mm: 2, width_mm: 20,\n"
            "      position_mm: 100, internal: true, profile_shift: -0.017997,\n"
            "      inertia_kgm2: 0.01, mass_kg: 2}");
    planetary_add_mesh(&t, "inner", "s", "p");
    planetary_add_mesh(&t, "outer", "p", "r");
    planetary_end(&t, one_set,
                  "clutches:\n  drive: {shaft: in, on: sun, torque_capacity_Nm: 300}\n"
                  "  brake: {shaft: ring, torque_capacity_Nm: 300}\n"
                  "paths:\n  input:\n    shaft: in\n    gears:\n"
                  "      0: {lock: brake}\n      1: {lock: [drive, brake]}\n"
                  "output: carrier\n");
    assemble(s, &t);
}

static void ford_c4_set_has_its_efficiency(void **state)
{
    (void)state;
    solved s;
    shifted_set(&s, sqrt(0.98));
    gm_steady_result r = solve(&s, 1, 200.0, 100.0);
    check_close("efficiency", -r.torque[0] * r.speed[0] / (r.torque[1] * r.speed[1]),
                0.9862857, 1e-7);
    check_close("ratio", ratio_of(&s, 1), 1.0 + 72.0 / 33.0, 1e-12);
    clear(&s);
}

/* ---- automatics ---- */

static void has_ratios(const solved *s, int n, const int *number, const double *ratio)
{
    for (int i = 0; i < n; i++)
        check_close("ratio", ratio_of(s, number[i]), ratio[i], 1e-12);
}

static void every_gear_is_balanced(solved *s)
{
    const gm_path_part *path = &s->d->paths[0];
    for (int g = 0; g < path->n_gears; g++)
        for (int way = -1; way <= 1; way += 2) {
            gm_steady_result r = solve(s, path->gears[g].number, 300.0, way * 120.0);
            assert_true(imbalance(s, &r) < 1e-9);
        }
}

/* Two equal sets with one sun; front carrier and rear ring are the output. */
static void simpson(void **state)
{
    (void)state;
    static const char *const shafts[] = {"in", "suns", "front", "rear", "out", NULL};
    const planetary_set front = {"f", "suns", "out", "front", 33, 75, 3, 100.0};
    const planetary_set rear = {"r", "suns", "rear", "out", 33, 75, 3, 200.0};
    const double z = 33.0 / 75.0;
    const double ratio[] = {2.0 + z, 1.0 + z, 1.0, -1.0 / z};
    solved s;
    planetary_text t;
    planetary_begin(&t, s.text, sizeof s.text);
    t.friction = 1;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add_set(&t, &front);
    planetary_add_set(&t, &rear);
    planetary_end(&t, shafts,
                  "clutches:\n"
                  "  forward: {shaft: in, on: front, torque_capacity_Nm: 400}\n"
                  "  direct: {shaft: in, on: suns, torque_capacity_Nm: 400}\n"
                  "  band: {shaft: suns, torque_capacity_Nm: 400, friction_surfaces: 6,\n"
                  "    inner_radius_mm: 70, outer_radius_mm: 85, clearance_mm: 0.2}\n"
                  "  low: {shaft: rear, torque_capacity_Nm: 600}\n"
                  "paths:\n  input:\n    shaft: in\n    gears:\n"
                  "      -1: {lock: [direct, low]}\n      0: {lock: low}\n"
                  "      1: {lock: [forward, low]}\n      2: {lock: [forward, band]}\n"
                  "      3: {lock: [forward, direct]}\noutput: out\n");
    assemble(&s, &t);
    has_ratios(&s, 4, (const int[]){1, 2, 3, -1}, ratio);
    every_gear_is_balanced(&s);
    clear(&s);
}

/* Small sun 21, large sun 27, ring 57, short and long planets on one carrier. */
static void ravigneaux(void **state)
{
    (void)state;
    static const char *const shafts[] = {"in", "small", "large", "carrier", "ring", NULL};
    const double ratio[] = {57.0 / 21.0, 57.0 * (21.0 + 27.0) / (21.0 * (57.0 + 27.0)),
                            1.0, 57.0 / (57.0 + 27.0), -57.0 / 27.0};
    solved s;
    planetary_text t;
    planetary_begin(&t, s.text, sizeof s.text);
    t.friction = 1;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add(
        &t,
        "  s1: {shaft: small, teeth: 21, normal_module_mm: 2, width_mm: 20, position_mm: "
        "100}\n"
        "  s2: {shaft: large, teeth: 27, normal_module_mm: 2, width_mm: 20, position_mm: "
        "200}\n"
        "  short: {shaft: carrier, teeth: 15, normal_module_mm: 2, width_mm: 20,\n"
        "    position_mm: 100, idles: true, planets: 3, pin_radius_mm: 36,\n"
        "    pin_angle_deg: 44.415309, bearing: {type: needle_roller, bore_mm: 8,\n"
        "    outer_mm: 10, width_mm: 16}}\n"
        "  long: {shaft: carrier, teeth: 15, normal_module_mm: 2, width_mm: 140,\n"
        "    position_mm: 150, idles: true, planets: 3, pin_radius_mm: 42,\n"
        "    bearing: {type: needle_roller, bore_mm: 8, outer_mm: 10, width_mm: 16}}\n"
        "  r: {shaft: ring, teeth: 57, normal_module_mm: 2, width_mm: 20,\n"
        "    position_mm: 200, internal: true, inertia_kgm2: 0.01, mass_kg: 2}");
    planetary_add_mesh(&t, "small_short", "s1", "short");
    planetary_add_mesh(&t, "short_long", "short", "long");
    planetary_add_mesh(&t, "large_long", "s2", "long");
    planetary_add_mesh(&t, "long_ring", "long", "r");
    planetary_end(&t, shafts,
                  "clutches:\n"
                  "  k1: {shaft: in, on: small, torque_capacity_Nm: 400}\n"
                  "  k2: {shaft: in, on: large, torque_capacity_Nm: 400}\n"
                  "  k3: {shaft: in, on: carrier, torque_capacity_Nm: 400}\n"
                  "  b1: {shaft: large, torque_capacity_Nm: 400}\n"
                  "  b2: {shaft: carrier, torque_capacity_Nm: 400}\n"
                  "paths:\n  input:\n    shaft: in\n    gears:\n"
                  "      -1: {lock: [k2, b2]}\n      0: {lock: b2}\n"
                  "      1: {lock: [k1, b2]}\n      2: {lock: [k1, b1]}\n"
                  "      3: {lock: [k1, k3]}\n      4: {lock: [k3, b1]}\noutput: ring\n");
    assemble(&s, &t);
    has_ratios(&s, 5, (const int[]){1, 2, 3, 4, -1}, ratio);
    every_gear_is_balanced(&s);
    clear(&s);
}

/* ---- random sets ---- */

static int pick(uint64_t *state, int n)
{
    return (int)random_between(state, 0.0, n);
}

/* Two sets; two members of the second are joined with two of the first, which leaves four
 * shafts: one is driven, one is the output, one is held. Power may circulate. */
static int random_compound(solved *s, uint64_t *state)
{
    static const char *const shafts[] = {"in", "a", "b", "c", "d", NULL};
    static const int zs[] = {33, 24, 45, 30}, zr[] = {75, 84, 75, 78};
    const char *second[3] = {shafts[1 + pick(state, 3)], NULL, "d"};
    int k = pick(state, 4), l = pick(state, 4), turn = pick(state, 3), at[3];
    char rest[512];
    planetary_text t;
    do
        second[1] = shafts[1 + pick(state, 3)];
    while (second[1] == second[0]);
    for (at[0] = pick(state, 4), at[1] = at[0]; at[1] == at[0];)
        at[1] = pick(state, 4);
    do
        at[2] = pick(state, 4);
    while (at[2] == at[0] || at[2] == at[1]);
    const planetary_set p = {"p", "a", "b", "c", zs[k], zr[k], 3, 100.0};
    const planetary_set q = {
        "q", second[turn], second[(turn + 1) % 3], second[(turn + 2) % 3], zs[l], zr[l],
        3,   200.0};
    planetary_begin(&t, s->text, sizeof s->text);
    t.friction = 1;
    planetary_shafts(&t, shafts);
    planetary_gears(&t);
    planetary_add_set(&t, &p);
    planetary_add_set(&t, &q);
    (void)snprintf(rest, sizeof rest,
                   "clutches:\n  drive: {shaft: in, on: %s, torque_capacity_Nm: 300}\n"
                   "  brake: {shaft: %s, torque_capacity_Nm: 300}\n"
                   "paths:\n  input:\n    shaft: in\n    gears:\n"
                   "      0: {lock: brake}\n      1: {lock: [drive, brake]}\n"
                   "output: %s\n",
                   shafts[1 + at[0]], shafts[1 + at[1]], shafts[1 + at[2]]);
    planetary_end(&t, shafts, rest);
    return try_to_assemble(s);
}

static void random_sets_are_balanced(void **state)
{
    (void)state;
    uint64_t random = 7;
    int built = 0;
    for (int i = 0; i < 200; i++) {
        solved s;
        if (!random_compound(&s, &random))
            continue;
        built++;
        for (int k = 0; k < 20; k++) {
            gm_steady_result r = solve(&s, 1, random_between(&random, -600.0, 600.0),
                                       random_between(&random, -300.0, 300.0));
            if (!(imbalance(&s, &r) < 1e-9)) /* the bar of every steady point */
                fail_msg("set %d: %g of the power is not accounted for", i,
                         imbalance(&s, &r));
        }
        clear(&s);
    }
    assert_true(built > 150);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(efficiency_is_the_closed_form),
        cmocka_unit_test(ford_c4_set_has_its_efficiency),
        cmocka_unit_test(simpson),
        cmocka_unit_test(ravigneaux),
        cmocka_unit_test(random_sets_are_balanced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
