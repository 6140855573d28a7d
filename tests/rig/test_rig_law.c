/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Sweeps of simulated gearsets whose losses are known in closed form: every value of
 * every table, all inertias and ratios.
 */
#include "law_rig.h"
#include "sweep/gm_rig_plant.h"
#include "sweep/gm_sweep.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

static const gm_rig_settings settings = {
    .creep = 0.2, .time_limit = 30.0, .inertia = {(double)NAN, (double)NAN}};

typedef struct fixture {
    law_rig source;
    law of;
    gm_map *map;
} fixture;

static fixture sweep(law_variant variant)
{
    const gm_sweep_options coarse = {.speed_step = 150.0, .torque_step = 50.0};
    fixture f;
    gm_plant *plant = NULL;
    gm_error error = {GM_OK, ""};
    law_rig_init(&f.source, variant);
    f.of = law_of(variant);
    gm_status status = gm_rig_plant_create(&f.source.rig, &f.source.info, &settings,
                                           &plant, NULL, &error);
    if (status == GM_OK)
        status = gm_sweep_run(plant, &coarse, NULL, NULL, NULL, &f.map, NULL, &error);
    gm_rig_plant_destroy(plant);
    if (status != GM_OK)
        fail_msg("%s", error.message);
    return f;
}

/* Two engaged paths drag on each other by the difference of their speeds, and transmit
   that. */
static double coupled(const fixture *f, const int *gear, double w_o)
{
    const law *l = &f->of;
    double ratio[2], sum = 0.0;
    for (int p = 0; p < 2; p++)
        ratio[p] = law_ratio(l, p, gear[p]);
    if (gear[0] == 0 || gear[1] == 0)
        return 0.0;
    double torque = l->coupling * (ratio[1] - ratio[0]) * w_o;
    for (int p = 0; p < 2; p++) {
        double along = (ratio[p] > 0.0 ? 1.0 : -1.0) * (p == 0 ? torque : -torque);
        sum += fabs(ratio[p]) * law_load(l, p, gear[p], ratio[p] * w_o, along);
    }
    return sum + torque * (ratio[1] - ratio[0]);
}

static double truth(const fixture *f, const gm_map_table *t, int i, int j)
{
    const gm_table_key *k = &t->key;
    double temperature = f->source.temperature, sign = k->direction[0] ? -1.0 : 1.0;
    switch (k->symbol) {
    case GM_PARASITIC: {
        int gear[2] = {k->gear[0], f->of.n_paths == 2 ? k->gear[1] : 0};
        return law_parasitic(&f->of, gear, temperature, t->x[0][i]) +
               coupled(f, gear, t->x[0][i]);
    }
    case GM_LOAD_LOSS:
        return law_load(&f->of, k->path, k->gear[k->path], t->x[0][i], t->x[1][j]);
    case GM_DRAG:
        return law_drag(&f->of, k->path, sign * t->x[0][i], sign,
                        (k->direction[1] ? -1.0 : 1.0) * t->x[1][j]);
    case GM_REACTION:
        return law_reaction(&f->of, k->path, sign * t->x[0][i]);
    default:
        return 0.0;
    }
}

static double largest_of(const fixture *f, const gm_map_table *t)
{
    double largest = 0.0;
    for (int i = 0; i < t->n[0]; i++)
        for (int j = 0; j < t->n[1]; j++)
            largest = fmax(largest, fabs(truth(f, t, i, j)));
    return largest;
}

/* Losses within 0.1 % of the table's largest. */
static void check_tables(const fixture *f)
{
    for (int n = 0; n < f->map->n_tables; n++) {
        const gm_map_table *t = &f->map->tables[n];
        if (t->key.symbol == GM_LINE_JUMP || t->key.symbol == GM_COUPLING ||
            t->key.symbol == GM_BOTH_LOADED)
            continue;
        double largest = largest_of(f, t);
        for (int i = 0; i < t->n[0]; i++)
            for (int j = 0; j < t->n[1]; j++) {
                double is = truth(f, t, i, j), found = t->value[i * t->n[1] + j];
                if (!(fabs(found - is) <= 1e-3 * largest))
                    fail_msg("%s, path %d, gears %d %d, directions %d %d, value %d %d: "
                             "%.9g, truth %.9g, largest %.3g",
                             gm_symbol_name(t->key.symbol), t->key.path, t->key.gear[0],
                             t->key.gear[1], t->key.direction[0], t->key.direction[1], i,
                             j, found, is, largest);
            }
    }
}

static void assert_near(const char *what, double found, double is, double relative)
{
    if (!(fabs(found - is) <= relative * fabs(is)))
        fail_msg("%s: %.9g, truth %.9g", what, found, is);
}

static void check_parts(const fixture *f)
{
    assert_near("J_out", f->map->inertia_output, f->of.inertia_output, 1e-3);
    for (int p = 0; p < f->of.n_paths; p++) {
        const gm_map_path *path = &f->map->paths[p];
        assert_near("J_p", path->inertia, f->of.path[p].inertia, 1e-3);
        for (int g = 0; g < path->n_gears; g++) {
            assert_near("ratio", path->gears[g].ratio,
                        law_ratio(&f->of, p, path->gears[g].number), 1e-6);
            assert_true(path->gears[g].inertia_extra == 0.0);
        }
    }
}

static void check(law_variant variant)
{
    fixture f = sweep(variant);
    check_parts(&f);
    check_tables(&f);
    gm_map_destroy(f.map);
}

#define CASE(name, variant)                                                              \
    static void name(void **state)                                                       \
    {                                                                                    \
        (void)state;                                                                     \
        check(variant);                                                                  \
    }
CASE(a_rigid_gearset, LAW_RIGID)
CASE(an_elastic_gearset_with_backlash, LAW_ELASTIC)
CASE(two_paths, LAW_TWO_PATHS)
CASE(speed_taken_at_the_input, LAW_SPEED_INPUT)
CASE(speed_taken_at_the_output, LAW_SPEED_OUTPUT)
CASE(speed_taken_at_both, LAW_SPEED_BOTH)

int main(int argc, char **argv)
{
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rigid_gearset),
        cmocka_unit_test(an_elastic_gearset_with_backlash),
        cmocka_unit_test(two_paths),
        cmocka_unit_test(speed_taken_at_the_input),
        cmocka_unit_test(speed_taken_at_the_output),
        cmocka_unit_test(speed_taken_at_both),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
