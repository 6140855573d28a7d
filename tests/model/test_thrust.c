/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Pairs of bearings that hold one direction each: the catalogues' cases, preload, balance
 * and derivatives.
 */
#include "description_fixture.h"
#include "property.h"

#include "model/gm_gearset.h"
#include "model/statics.h"

#include <stdlib.h>
#include <string.h>

/* Rounding of the maximum: at most 5 N above, for two maxima 10 N. */
#define ROUNDING 10.0

enum { N_FORCES = 4 };

/* A pair whose loads are linear in four forces: force 0 gives F_r of the one, force 1 of
 * the other, force 2 the axial force; force 3 everything at random. */
typedef struct pair {
    gm_load_row row[2];
    int mesh[2][N_FORCES];
    double a[2][N_FORCES][3], b[2][N_FORCES][3];
} pair;

static void make(pair *p, double preload)
{
    memset(p, 0, sizeof *p);
    for (int i = 0; i < 2; i++)
        p->row[i] = (gm_load_row){.mesh = p->mesh[i],
                                  .a = p->a[i],
                                  .b = p->b[i],
                                  .way = i == 0 ? 1. : -1.,
                                  .induced = i == 0 ? 0.5 / 1.6 : 0.5 / 1.4,
                                  .preload = preload};
    p->row[0].n = p->row[1].n = 2;
    p->mesh[0][0] = 0, p->a[0][0][1] = 1.;
    p->mesh[0][1] = 2, p->a[0][1][0] = 1.; /* the linear statics' share: all of it */
    p->mesh[1][0] = 3, p->a[1][0][1] = 0.3, p->a[1][0][0] = 0.2, p->b[1][0][2] = 0.5;
    p->mesh[1][1] = 1, p->a[1][1][2] = 1.;
    gm_thrust_pair(&p->row[0], &p->row[1]);
}

static void check_loads(double preload, double F_r, double F_r_mate, double K,
                        double expected, double expected_mate)
{
    pair p;
    double radial, axial, mate;
    const double F[N_FORCES] = {F_r, F_r_mate, K, 0.};
    make(&p, preload);
    gm_load_row_at(&p.row[0], F, &radial, &axial, NULL, NULL);
    gm_load_row_at(&p.row[1], F, &radial, &mate, NULL, NULL);
    if (!(axial >= expected && axial - expected <= ROUNDING))
        fail_msg("F_a %.9g, expected %.9g", axial, expected);
    if (!(mate >= expected_mate && mate - expected_mate <= ROUNDING))
        fail_msg("F_a' %.9g, expected %.9g", mate, expected_mate);
    if (!(fabs(axial - mate - K) <= 1e-9 * (axial + mate))) /* the shaft's balance */
        fail_msg("%.12g - %.12g is not %.12g", axial, mate, K);
}

/* Tapered, Y 1.6 and 1.4. F_r 3200 and 1400 N: S = 1000 and 500 N. */
static void catalogue_cases(void **state)
{
    (void)state;
    check_loads(0., 3200., 1400., 0., 1000., 1000.);    /* the larger S rules */
    check_loads(0., 3200., 1400., 300., 1000., 700.);   /* K less than S - S' */
    check_loads(0., 3200., 1400., 800., 1300., 500.);   /* more: S' + K */
    check_loads(0., 3200., 1400., -800., 1000., 1800.); /* K onto the mate */
    check_loads(0., 0., 0., 2000., 2000., 0.);          /* K alone */
    check_loads(0., 0., 0., 0., 0., 0.);
}

/* Preload 1500 N: both sides share until one would come free at K = 3000 N. */
static void preload_shares_the_axial_force(void **state)
{
    (void)state;
    check_loads(1500., 0., 0., 0., 1500., 1500.);
    check_loads(1500., 0., 0., 1000., 2000., 1000.);
    check_loads(1500., 0., 0., -2000., 500., 2500.);
    check_loads(1500., 0., 0., 4000., 4000., 0.);
    check_loads(1500., 3200., 1400., 800., 1900., 1100.);
}

/* Loads by one of the forces, the others held. */
typedef struct axis {
    const pair *p;
    double F[N_FORCES];
    int k, side;
} axis;

static double axial_of(const void *data, double x)
{
    axis at = *(const axis *)data;
    double radial, axial;
    at.F[at.k] = x;
    gm_load_row_at(&at.p->row[at.side], at.F, &radial, &axial, NULL, NULL);
    return axial;
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 51;
    for (int i = 0; i < 2000; i++) {
        pair p;
        axis at = {.p = &p};
        double radial, axial, d_radial[N_FORCES], d_axial[N_FORCES];
        make(&p, i & 1 ? random_between(&seed, 1., 3000.) : 0.);
        for (int k = 0; k < N_FORCES; k++)
            at.F[k] = random_scale(&seed, 1., 5000.);
        for (at.side = 0; at.side < 2; at.side++) {
            const gm_load_row *row = &p.row[at.side];
            gm_load_row_at(row, at.F, &radial, &axial, d_radial, d_axial);
            assert_int_equal(row->n, N_FORCES);
            for (int j = 0; j < row->n; j++) {
                at.k = row->mesh[j];
                check_slope("F_a", axial_of, &at, at.F[at.k], d_axial[j]);
            }
        }
    }
}

static void rows_of_a_pair_have_the_same_meshes(void **state)
{
    (void)state;
    pair p;
    make(&p, 0.);
    assert_memory_equal(p.mesh[0], p.mesh[1], sizeof p.mesh[0]);
    assert_ptr_equal(p.row[0].mate, &p.row[1]);
    const double F[N_FORCES] = {10., 20., 30., 40.};
    double v[3];
    gm_load_row_vector(&p.row[1], F, v);
    check_close("x", v[0], 0.2 * 40., 1e-14);
    check_close("y", v[1], 0.3 * 40., 1e-14);
    check_close("z", v[2], 20. + 0.5 * 40., 1e-14);
}

/* Output shaft 1 of the example on a pair of tapered bearings. */
#define CHANGED GM_BINARY_DIR "/test_thrust.yaml"
#define FRONT                                                                            \
    "position_mm: 10, type: cylindrical_roller,\n"                                       \
    "                   series: \"22\",    # NU 2207\n"                                  \
    "                   bore_mm: 35, outer_mm: 72, width_mm: 23}\n  output_1_rear"
#define REAR                                                                             \
    "output_1_rear: {shaft: output_1, position_mm: 274, locating: true,\n"               \
    "                  type: deep_groove_ball, designation: \"6307\"}"
#define TAPERED                                                                          \
    "type: tapered_roller, series: \"322\", bore_mm: 35, outer_mm: 72, "                 \
    "axial_factor: 1.6}"

typedef struct shaft_load {
    double radial[2], axial[2]; /* front, rear */
} shaft_load;

/* Loads of output shaft 1 under 150 N.m in first gear. */
static shaft_load load_of(const char *front, const char *rear)
{
    gm_error error = {GM_OK, ""};
    char *text = gm_test_slurp(EXAMPLE);
    char *one = gm_test_replaced(text, FRONT, front);
    char *two = gm_test_replaced(one, REAR, rear);
    gm_test_spill(CHANGED, two);
    gm_description *d = gm_test_read(CHANGED);
    gm_gearset *g = NULL;
    gm_balance *b = NULL;
    gm_steady_point point = {.gear = {1, 0}, .speed = {20., 0., 0.}};
    point.direction[0] = 1., point.torque[1] = 150.;
    if (gm_gearset_create(d, d->oil.temperature, &g, &error) != GM_OK ||
        gm_balance_create(g, &b, &error) != GM_OK ||
        gm_balance_set_point(b, &point, &error) != GM_OK)
        fail_msg("%s", error.message);
    int n = gm_gearset_element_count(g);
    gm_element_loss *losses = calloc((size_t)n, sizeof *losses);
    double *x = calloc((size_t)gm_balance_size(b), sizeof *x);
    assert_true(losses && x);
    for (int i = 0; i < 100 && gm_balance_pass(b, x) > 1e-13; i++)
        ;
    gm_balance_losses(b, x, losses);
    shaft_load load = {{0., 0.}, {0., 0.}};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 2; k++)
            if (strcmp(losses[i].name, k ? "output_1_rear" : "output_1_front") == 0)
                load.radial[k] = losses[i].radial, load.axial[k] = losses[i].axial;
    free(losses);
    free(x);
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
    gm_description_destroy(d);
    free(text);
    free(one);
    free(two);
    return load;
}

#define PAIR_FRONT                                                                       \
    "position_mm: 10, locating: true, thrust: minus_x, " TAPERED "\n  output_1_rear"
#define PAIR_REAR(more)                                                                  \
    "output_1_rear: {shaft: output_1, position_mm: 274, locating: true, thrust: "        \
    "plus_x, " more TAPERED

static void a_shaft_on_tapered_bearings(void **state)
{
    (void)state;
    shaft_load plain = load_of(FRONT, REAR);
    shaft_load tapered = load_of(PAIR_FRONT, PAIR_REAR(""));
    assert_true(plain.axial[0] == 0. && plain.axial[1] > 500.);
    double S = 0.5 / 1.6 * tapered.radial[0], S_rear = 0.5 / 1.6 * tapered.radial[1];
    /* the same but for the friction of the bearings, half a percent in first gear */
    check_close("F_r front", tapered.radial[0], plain.radial[0], 1e-2);
    check_close("F_r rear", tapered.radial[1], plain.radial[1], 1e-2);
    check_close("K", fabs(tapered.axial[0] - tapered.axial[1]), plain.axial[1], 1e-2);
    assert_true(tapered.axial[0] >= S && tapered.axial[1] >= S_rear);
    assert_true(fmin(tapered.axial[0] - S, tapered.axial[1] - S_rear) <= ROUNDING);
}

/* 3000 N at 20 degC, 25 N/K less: 1500 N at the oil's 80 degC. */
static void preload_changes_with_temperature(void **state)
{
    (void)state;
    shaft_load hot =
        load_of(PAIR_FRONT, PAIR_REAR("preload_N: 3000, preload_change_N_K: -25, "));
    shaft_load same = load_of(PAIR_FRONT, PAIR_REAR("preload_N: 1500, "));
    shaft_load none = load_of(PAIR_FRONT, PAIR_REAR("preload_N: 300, "
                                                    "preload_change_N_K: -25, "));
    shaft_load zero = load_of(PAIR_FRONT, PAIR_REAR(""));
    for (int k = 0; k < 2; k++) {
        check_close("1500 N", hot.axial[k], same.axial[k], 1e-12);
        check_close("gone", none.axial[k], zero.axial[k], 1e-12);
        assert_true(same.axial[k] >= zero.axial[k]);
    }
}

static void pairs_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    static const gm_test_rule rules[] = {
        {REAR, PAIR_REAR(""), "  output_1: ",
         "shaft 'output_1': bearings with thrust come as one plus_x and one minus_x "
         "without other locating ones; found 1, 0 and 0 others",
         GM_ERR_MODEL, NULL},
        {REAR,
         "output_1_rear: {shaft: output_1, position_mm: 274, locating: true, preload_N: "
         "100, type: deep_groove_ball, designation: \"6307\"}",
         "output_1_rear",
         "bearing 'output_1_rear': preload_N has an effect only with thrust plus_x, "
         "found "
         "thrust both",
         GM_ERR_FORMAT, NULL},
        {FRONT,
         "position_mm: 10, thrust: plus_x, type: cylindrical_roller, series: \"22\", "
         "bore_mm: 35, outer_mm: 72, width_mm: 23}\n  output_1_rear",
         "thrust: plus_x",
         "bearing 'output_1_front': thrust has an effect only with locating true, found "
         "locating false",
         GM_ERR_FORMAT, NULL}};
    char *example = gm_test_slurp(EXAMPLE);
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        gm_test_rule_answers(example, CHANGED, &rules[i]);
    free(example);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(catalogue_cases),
        cmocka_unit_test(preload_shares_the_axial_force),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(a_shaft_on_tapered_bearings),
        cmocka_unit_test(preload_changes_with_temperature),
        cmocka_unit_test(pairs_that_do_not_fit_are_refused),
        cmocka_unit_test(rows_of_a_pair_have_the_same_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
