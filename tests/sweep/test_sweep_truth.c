/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The sweep of a gearset whose reduction is known: every value of every table.
 */
#include "sweep/gm_sweep.h"

#include "synthetic.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

/* The solver leaves 1e-12 of the largest flange torque (about 700 N.m at the output). */
#define EXACT 1e-9

typedef struct fixture {
    synthetic source;
    gm_map *map;
    gm_sweep_summary summary;
} fixture;

static fixture two, one;

static int sweep_all(void **state)
{
    const gm_sweep_options options = {.threads = 2};
    (void)state;
    synthetic_init(&two.source, 2);
    synthetic_init(&one.source, 1);
    for (int i = 0; i < 2; i++) {
        fixture *f = i ? &one : &two;
        gm_error error = {GM_OK, ""};
        if (gm_sweep_run(&f->source.plant, &options, NULL, NULL, NULL, &f->map,
                         &f->summary, &error) != GM_OK) {
            print_error("%s\n", error.message);
            return -1;
        }
    }
    return 0;
}

static int clear_all(void **state)
{
    (void)state;
    gm_map_destroy(two.map);
    gm_map_destroy(one.map);
    return 0;
}

static double sign_of(int direction)
{
    return direction == GM_BACKWARD ? -1.0 : 1.0;
}

static double sgn(double x)
{
    return (double)(x > 0) - (double)(x < 0);
}

static void assert_close(const gm_map_table *t, int at, double found, double truth)
{
    if (!(fabs(found - truth) <= EXACT))
        fail_msg(
            "%s, path %d, gears (%d, %d), directions (%d, %d), value %d: %.15g, truth "
            "%.15g",
            gm_symbol_name(t->key.symbol), t->key.path, t->key.gear[0], t->key.gear[1],
            t->key.direction[0], t->key.direction[1], at, found, truth);
}

/* Compare all tables of a symbol; truth by node indices. Returns how many there are. */
typedef double truth_at(const fixture *f, const gm_map_table *t, int i, int j, int k);

static int check_symbol(const fixture *f, gm_symbol symbol, truth_at *truth)
{
    int tables = 0;
    for (int n = 0; n < f->map->n_tables; n++) {
        const gm_map_table *t = &f->map->tables[n];
        if (t->key.symbol != symbol)
            continue;
        tables++;
        int at = 0;
        for (int i = 0; i < t->n[0]; i++)
            for (int j = 0; j < t->n[1]; j++)
                for (int k = 0; k < t->n[2]; k++, at++)
                    assert_close(t, at, t->value[at], truth(f, t, i, j, k));
    }
    return tables;
}

static double parasitic(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    int gear[2] = {t->key.gear[0], f->map->n_paths == 2 ? t->key.gear[1] : 0};
    (void)j;
    (void)k;
    return synthetic_parasitic(gear, t->key.direction[0], t->x[0][i]);
}

static void parasitic_loss_is_found_in_every_configuration(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_PARASITIC, parasitic), 4 * 4 * 2);
    assert_int_equal(check_symbol(&one, GM_PARASITIC, parasitic), 4 * 2);
}

static double load(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    (void)k;
    return synthetic_load(&f->source, t->key.path, t->key.gear[t->key.path],
                          t->key.direction[0], t->x[0][i], t->x[1][j]);
}

static void load_loss_is_found_in_every_gear_and_direction(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_LOAD_LOSS, load), 2 * 3 * 2);
    assert_int_equal(check_symbol(&one, GM_LOAD_LOSS, load), 3 * 2);
}

static void load_loss_is_exactly_zero_without_load(void **state)
{
    (void)state;
    for (int n = 0; n < two.map->n_tables; n++) {
        const gm_map_table *t = &two.map->tables[n];
        int zero = 0;
        while (t->key.symbol == GM_LOAD_LOSS && t->x[1][zero] < 0.0)
            zero++;
        for (int i = 0; t->key.symbol == GM_LOAD_LOSS && i < t->n[0]; i++) {
            assert_true(t->x[1][zero] == 0.0);
            assert_true(t->value[i * t->n[1] + zero] == 0.0);
        }
    }
}

/* X is what interpolated P and D tables leave, and both are linear enough here only at
   nodes: compare the sum at the nodes of X. */
static double interpolated_load(const fixture *f, const gm_map_table *t, int p,
                                double w_o, double torque)
{
    double ratio = synthetic_ratio(p, t->key.gear[p]);
    gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
    key.path = p;
    key.gear[p] = t->key.gear[p];
    key.direction[0] = (ratio < 0) != (t->key.direction[0] == GM_BACKWARD);
    const gm_map_table *d = gm_map_find(f->map, &key);
    gm_table2 view = {{d->n[0], d->x[0]}, {d->n[1], d->x[1]}, d->value, 0};
    gm_cell2 cell = {0};
    return fabs(ratio) * gm_table2_at(&view, 1, &cell, fabs(ratio) * w_o, torque).value;
}

static double both(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    double w = t->x[0][i], torque[2] = {t->x[1][j], t->x[2][k]};
    double truth = synthetic_both(t->key.gear, t->key.direction[0], w, torque);
    for (int p = 0; p < 2; p++) {
        double ratio = synthetic_ratio(p, t->key.gear[p]);
        int backward = (ratio < 0) != (t->key.direction[0] == GM_BACKWARD);
        truth += fabs(ratio) * synthetic_load(&f->source, p, t->key.gear[p], backward,
                                              fabs(ratio) * w, torque[p]) -
                 interpolated_load(f, t, p, w, torque[p]);
    }
    return truth;
}

static void correction_under_both_loads_is_found(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_BOTH_LOADED, both), 3 * 3 * 2);
    assert_int_equal(check_symbol(&one, GM_BOTH_LOADED, both), 0);
}

/* Held from the first node on at which the line has left the range of the path. */
static double held_speed(const gm_map_table *t, int axis, double ratio, int node)
{
    double leaves = SYNTHETIC_SPEED_MAX / fabs(ratio);
    int held = 0;
    while (held < t->n[axis] && t->x[axis][held] < leaves)
        held++;
    return t->x[axis][node < held ? node : held];
}

static double jump(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    int p = t->key.path, line = 0;
    (void)f;
    (void)j;
    (void)k;
    while (synthetic_line(p, line) != t->key.line)
        line++;
    return synthetic_jump(p, line, t->key.direction[0], held_speed(t, 0, t->key.line, i));
}

static void jumps_on_the_lines_are_found(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_LINE_JUMP, jump), 2 * SYNTHETIC_LINES * 2);
    assert_int_equal(check_symbol(&one, GM_LINE_JUMP, jump), SYNTHETIC_LINES * 2);
}

/* The steps that the tables leave out, minus those the gearset has. */
typedef struct steps {
    double drag, reaction;
} steps;

static steps steps_left(const fixture *f, const gm_map_table *t, int i, int j)
{
    int p = t->key.path;
    double sigma_n = sign_of(t->key.direction[0]), sigma_o = sign_of(t->key.direction[1]);
    double w_n = sigma_n * t->x[0][i], w_o = sigma_o * t->x[1][j];
    steps sum = {0.0, 0.0};
    (void)f;
    for (int line = 0; line < SYNTHETIC_LINES; line++) {
        double ratio = synthetic_line(p, line), w = fabs(w_o);
        double held = held_speed(t, 1, ratio, j);
        double half = 0.5 * (synthetic_jump(p, line, sigma_o < 0, w) -
                             synthetic_jump(p, line, sigma_o < 0, held));
        double side = w_n == 0.0 && w_o == 0.0 ? sgn(sigma_n - ratio * sigma_o)
                                               : sgn(w_n - ratio * w_o);
        sum.drag += half * side;
        sum.reaction -= ratio * half * (side - sgn(-ratio * sigma_o));
    }
    return sum;
}

static double drag(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    double sigma_n = sign_of(t->key.direction[0]), sigma_o = sign_of(t->key.direction[1]);
    (void)k;
    return synthetic_drag(t->key.path, sigma_n * t->x[0][i], sigma_n,
                          sigma_o * t->x[1][j]) +
           steps_left(f, t, i, j).drag;
}

static double reaction(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    double sigma_n = sign_of(t->key.direction[0]), sigma_o = sign_of(t->key.direction[1]);
    (void)k;
    if (i == 0)
        return 0.0;
    return synthetic_reaction(t->key.path, sigma_n * t->x[0][i], sigma_o * t->x[1][j]) +
           steps_left(f, t, i, j).reaction;
}

static void drag_of_free_shafts_is_found_without_its_steps(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_DRAG, drag), 2 * 4);
    assert_int_equal(check_symbol(&one, GM_DRAG, drag), 4);
}

static void reaction_on_the_output_is_found_without_its_steps(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_REACTION, reaction), 2 * 4);
    assert_int_equal(check_symbol(&one, GM_REACTION, reaction), 4);
}

static double coupling(const fixture *f, const gm_map_table *t, int i, int j, int k)
{
    (void)f;
    (void)j;
    (void)k;
    return synthetic_coupling(t->x[0][i]);
}

static void coupling_of_the_input_shafts_is_found_and_odd(void **state)
{
    (void)state;
    assert_int_equal(check_symbol(&two, GM_COUPLING, coupling), 1);
    assert_int_equal(check_symbol(&one, GM_COUPLING, coupling), 0);
    gm_table_key key = gm_table_key_of(GM_COUPLING);
    const gm_map_table *t = gm_map_find(two.map, &key);
    for (int i = 0; i < t->n[0]; i++)
        assert_true(t->value[i] == -t->value[t->n[0] - 1 - i]);
}

static void ratios_and_inertias_are_found(void **state)
{
    (void)state;
    assert_true(two.map->inertia_output == synthetic_inertia(0));
    for (int p = 0; p < 2; p++) {
        assert_true(two.map->paths[p].inertia == synthetic_inertia(1 + p));
        for (int g = 0; g < 3; g++) {
            const gm_map_gear *gear = &two.map->paths[p].gears[g];
            gm_compliance c = synthetic_compliance(p, gear->number);
            assert_true(gear->ratio == synthetic_ratio(p, gear->number));
            assert_true(gear->stiffness == c.stiffness && gear->damping == c.damping &&
                        gear->lash == c.lash);
        }
    }
    assert_true(two.summary.largest_ratio_deviation == 0.0);
}

static void axes_stay_within_the_promised_size_and_hold_the_kinks(void **state)
{
    (void)state;
    for (int n = 0; n < two.map->n_tables; n++) {
        const gm_map_table *t = &two.map->tables[n];
        if (t->key.symbol != GM_LOAD_LOSS)
            continue;
        assert_true(t->n[0] <= 40);
        assert_true(t->n[1] <= 2 * 14 - 1);
        assert_true(t->x[0][t->n[0] - 1] == SYNTHETIC_SPEED_MAX);
        assert_true(t->x[1][t->n[1] - 1] == SYNTHETIC_TORQUE_MAX);
        double kink;
        int p = t->key.path, found = 0;
        two.source.plant.is->kink_speeds(&two.source, p, t->key.gear[p], 1, &kink);
        for (int i = 0; i < t->n[0]; i++)
            found += t->x[0][i] == kink;
        assert_int_equal(found, 1);
        found = 0;
        two.source.plant.is->kink_torques(&two.source, p, t->key.gear[p], 1, &kink);
        for (int i = 0; i < t->n[1]; i++)
            found += fabs(t->x[1][i]) == kink;
        assert_int_equal(found, 2); /* of both signs */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parasitic_loss_is_found_in_every_configuration),
        cmocka_unit_test(load_loss_is_found_in_every_gear_and_direction),
        cmocka_unit_test(load_loss_is_exactly_zero_without_load),
        cmocka_unit_test(correction_under_both_loads_is_found),
        cmocka_unit_test(jumps_on_the_lines_are_found),
        cmocka_unit_test(drag_of_free_shafts_is_found_without_its_steps),
        cmocka_unit_test(reaction_on_the_output_is_found_without_its_steps),
        cmocka_unit_test(coupling_of_the_input_shafts_is_found_and_odd),
        cmocka_unit_test(ratios_and_inertias_are_found),
        cmocka_unit_test(axes_stay_within_the_promised_size_and_hold_the_kinks),
    };
    return cmocka_run_group_tests(tests, sweep_all, clear_all);
}
