/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The built-in model of the example, swept and verified: the accuracy that the automatic
 * axes promise, and what physics demands of the tables.
 */
#include "model/gm_gearset.h"
#include "plant/gm_builtin.h"
#include "reduced_probe.h"
#include "solve/gm_steady_solver.h"
#include "sweep/gm_sweep.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

static gm_description *description;
static gm_gearset *gearset;
static gm_plant *plant;
static gm_map *map;
static gm_map_view *view;

static int set_up(void **state)
{
    const gm_sweep_options options = {0};
    gm_error error = {GM_OK, ""};
    gm_status status =
        gm_description_read(GM_SOURCE_DIR "/examples/dct7.yaml", &description, &error);
    (void)state;
    if (status == GM_OK)
        status = gm_gearset_create(description, description->oil.temperature, &gearset,
                                   &error);
    if (status == GM_OK)
        status = gm_builtin_create(gearset, &plant, &error);
    if (status == GM_OK)
        status = gm_sweep_run(plant, &options, NULL, NULL, NULL, &map, NULL, &error);
    if (status == GM_OK)
        status = gm_map_view_create(map, &view, &error);
    if (status != GM_OK)
        print_error("%s\n", error.message);
    return status != GM_OK;
}

static int tear_down(void **state)
{
    (void)state;
    gm_map_view_destroy(view);
    gm_map_destroy(map);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    return 0;
}

/* The bars of the project, of each case's largest loss: one path or a preselected gear
   0.5 %, rms 0.2 %; both paths loaded 5 %; free shafts 2 %. */
static void random_points_are_within_the_promised_accuracy(void **state)
{
    static const double largest[GM_VERIFY_GROUPS] = {5e-3, 5e-3, 5e-2, 2e-2, 2e-2};
    static const double rms[GM_VERIFY_GROUPS] = {2e-3, 2e-3, 1e-2, 5e-3, 5e-3};
    reduced_probe of = {.view = view, .loss_factor = 1.0};
    const gm_reduced_probe probe = {reduced_probe_at, &of};
    gm_verify_result result;
    (void)state;
    assert_int_equal(gm_verify_steady(plant, &probe, 2000, 20, &result, NULL), GM_OK);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++) {
        print_message("%-12s max %.3f %% rms %.3f %%\n",
                      gm_verify_group_name((gm_verify_group)g),
                      100.0 * result.max_relative[g], 100.0 * result.rms_relative[g]);
        assert_true(result.max_relative[g] <= largest[g]);
        assert_true(result.rms_relative[g] <= rms[g]);
    }
    gm_verify_result_clear(&result);
}

static double coupling_at(double relative_speed)
{
    gm_table_key key = gm_table_key_of(GM_COUPLING);
    const gm_map_table *c = gm_map_find(map, &key);
    gm_table1 table = {{c->n[0], c->x[0]}, c->value, 0};
    gm_cell1 cell = {0};
    return gm_table1_at(&table, 1, &cell, relative_speed).value;
}

/* Loss torque at the path's flange at a node of D, detailed and reduced: the flange
   torque is what transmits the node's torque, with the other path at rest. */
static double error_at_node(gm_steady_solver *solver, const gm_map_table *d, double ratio,
                            int i, int j, double *loss)
{
    reduced_probe of = {.view = view, .loss_factor = 1.0};
    int p = d->key.path;
    double sign = d->key.direction[0] == GM_BACKWARD ? -1.0 : 1.0;
    double w_p = sign * d->x[0][i];
    gm_steady_point point = {.speed = {w_p / ratio}};
    gm_steady_result found;
    gm_reduced_answer answer;
    point.gear[p] = d->key.gear[p];
    point.torque[1 + p] = sign * d->x[1][j] - coupling_at(-w_p);
    assert_int_equal(gm_steady_solve(solver, &point, &found, NULL), GM_OK);
    assert_int_equal(reduced_probe_at(&of, 0.0, &point, found.torque[0], &answer, NULL),
                     GM_OK);
    double power = found.torque[0] * found.speed[0] + found.torque[1 + p] * w_p;
    *loss = power / fabs(w_p);
    return (answer.loss_power - power) / fabs(w_p);
}

/* 0.01 % of the gear's largest loss: what is left is the solver's tolerance and the own
   acceleration that an output torque with the detailed loss gives the reduced gearset. */
static void nodes_of_an_engaged_path_are_met(void **state)
{
    gm_steady_solver *solver;
    double all = 0.0;
    (void)state;
    assert_int_equal(gm_steady_solver_create(plant, &solver, NULL), GM_OK);
    for (int t = 0; t < map->n_tables; t++) {
        const gm_map_table *d = &map->tables[t];
        if (d->key.symbol != GM_LOAD_LOSS)
            continue;
        int gear[GM_MAX_PATHS] = {0, 0};
        gm_kinematics kinematics;
        double largest = 0.0, worst = 0.0;
        gear[d->key.path] = d->key.gear[d->key.path];
        assert_int_equal(plant->is->kinematics(plant->self, gear, &kinematics, NULL),
                         GM_OK);
        for (int i = 1; i < d->n[0]; i += 3)
            for (int j = 0; j < d->n[1]; j++) {
                double loss, error = error_at_node(
                                 solver, d, kinematics.ratio[d->key.path], i, j, &loss);
                largest = fmax(largest, loss);
                worst = fmax(worst, fabs(error));
            }
        all = fmax(all, worst / largest);
        assert_true(worst <= 1e-4 * largest);
    }
    print_message("nodes        max %.2e %%\n", 100.0 * all);
    gm_steady_solver_destroy(solver);
}

/* On coarse axes, since only the order of the work differs. */
static void threads_do_not_change_the_result(void **state)
{
    gm_map *made[2] = {NULL, NULL};
    (void)state;
    for (int i = 0; i < 2; i++) {
        gm_sweep_options options = {.speed_step = 300.0, .torque_step = 250.0};
        options.threads = 1 + 2 * i;
        assert_int_equal(
            gm_sweep_run(plant, &options, NULL, NULL, NULL, &made[i], NULL, NULL), GM_OK);
    }
    assert_string_equal(made[0]->content_hash, made[1]->content_hash);
    gm_map_destroy(made[0]);
    gm_map_destroy(made[1]);
}

/* Second law: nothing turns without loss, whatever the configuration. */
static void parasitic_losses_are_never_negative(void **state)
{
    (void)state;
    for (int t = 0; t < map->n_tables; t++)
        for (int i = 0;
             map->tables[t].key.symbol == GM_PARASITIC && i < map->tables[t].n[0]; i++)
            assert_true(map->tables[t].value[i] >= 0.0);
}

static const gm_map_table *parasitic_of(const int *gear, int direction)
{
    gm_table_key key = gm_table_key_of(GM_PARASITIC);
    for (int p = 0; p < GM_MAX_PATHS; p++)
        key.gear[p] = gear[p];
    key.direction[0] = direction;
    return gm_map_find(map, &key);
}

/* P + |r| D >= 0 at every node of every gear: load never makes the gearset a motor. */
static void the_total_loss_is_never_negative(void **state)
{
    (void)state;
    for (int n = 0; n < map->n_tables; n++) {
        const gm_map_table *d = &map->tables[n];
        if (d->key.symbol != GM_LOAD_LOSS)
            continue;
        int p = d->key.path, gear[GM_MAX_PATHS] = {0, 0};
        double ratio = 0.0;
        gear[p] = d->key.gear[p];
        for (int g = 0; g < map->paths[p].n_gears; g++)
            if (map->paths[p].gears[g].number == gear[p])
                ratio = map->paths[p].gears[g].ratio;
        const gm_map_table *q =
            parasitic_of(gear, (ratio < 0) != (d->key.direction[0] == GM_BACKWARD));
        assert_int_equal(q->n[0], d->n[0]);
        for (int i = 0; i < d->n[0]; i++)
            for (int j = 0; j < d->n[1]; j++)
                assert_true(q->value[i] + fabs(ratio) * d->value[i * d->n[1] + j] >= 0.0);
    }
}

/* A gearset so light that friction stops and would turn it in one long step: an iterate
   beyond rest may not be believed, or friction does work (it once lost -225 J). */
static void a_long_step_of_a_light_gearset_loses_energy(void **state)
{
    gm_reduced_map light = *gm_map_view_reduced(view);
    gm_reduced_params params;
    gm_reduced_inputs in = {.output_tau = 1.99614,
                            .path_tau = {-0.3617, 0.734807},
                            .gear = {7, -1},
                            .oil_temperature = 353.15};
    const gm_real at_rest[2] = {0.0, 0.0};
    (void)state;
    light.inertia_output *= 0.0691589;
    light.path[0].inertia *= 0.000558121;
    light.path[1].inertia *= 0.000558121;
    gm_reduced_default_params(&light, &params);
    for (double h = 0.01; h < 0.105; h += 0.01) {
        gm_reduced_state s;
        assert_int_equal(gm_reduced_start(&light, &in, -91.243, at_rest, &s), 0);
        (void)gm_reduced_step(&light, &params, &in, h, &s);
        assert_true(s.loss_energy > 0.0);
    }
}

/* At standstill friction holds: a map of a regularised model would have zeros here. */
static void break_away_losses_are_there(void **state)
{
    (void)state;
    const int gears[3][2] = {{0, 0}, {1, 0}, {3, 4}};
    for (int i = 0; i < 3; i++)
        for (int d = 0; d < 2; d++)
            assert_true(parasitic_of(gears[i], d)->value[0] > 0.0);
}

/* Twice the speed of a free shaft does not turn its drag round: N has the sign of w_n
   while the output rests. */
static void drag_opposes_a_shaft_that_turns_alone(void **state)
{
    (void)state;
    for (int p = 0; p < 2; p++)
        for (int d = 0; d < 2; d++) {
            gm_table_key key = gm_table_key_of(GM_DRAG);
            key.path = p;
            key.direction[0] = key.direction[1] = d;
            const gm_map_table *n = gm_map_find(map, &key);
            double sign = d == GM_BACKWARD ? -1.0 : 1.0, steps = 0.0;
            int lines = 0;
            for (int t = 0; t < map->n_tables; t++) {
                const gm_map_table *jump = &map->tables[t];
                if (jump->key.symbol != GM_LINE_JUMP || jump->key.path != p ||
                    jump->key.direction[0] != d)
                    continue;
                assert_true(jump->value[0] > 0.0);
                steps += 0.5 * jump->value[0];
                lines++;
            }
            /* four gears each; on the even path also the reverse intermediate gears,
               which turn on an output shaft */
            assert_int_equal(lines, p == 0 ? 4 : 5);
            for (int i = 1; i < n->n[0]; i++)
                assert_true(sign * n->value[i * n->n[1]] + steps > 0.0);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_points_are_within_the_promised_accuracy),
        cmocka_unit_test(nodes_of_an_engaged_path_are_met),
        cmocka_unit_test(threads_do_not_change_the_result),
        cmocka_unit_test(parasitic_losses_are_never_negative),
        cmocka_unit_test(the_total_loss_is_never_negative),
        cmocka_unit_test(a_long_step_of_a_light_gearset_loses_energy),
        cmocka_unit_test(break_away_losses_are_there),
        cmocka_unit_test(drag_opposes_a_shaft_that_turns_alone),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
