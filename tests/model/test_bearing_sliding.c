/* SPDX-License-Identifier: BSD-2-Clause */
#include "bearing_cases.h"

#include "model/bearing_models.h"

static const double none = (double)NAN;

/* A bearing of 30 x 62 mm with nothing given; plain: bore 36, width 25 mm. */
static gm_bearing_data nothing(gm_bearing_friction_model friction)
{
    return (gm_bearing_data){.type = GM_BEARING_DEEP_GROOVE_BALL,
                             .friction = friction,
                             .d = 30e-3,
                             .D = 62e-3,
                             .B = 16e-3,
                             .torque = none,
                             .static_torque = none,
                             .mu = none,
                             .static_mu = none,
                             .stribeck = 0.05,
                             .viscous = none,
                             .stiffness = 200.,
                             .damping = 1.,
                             .clearance = none};
}

static gm_bearing_data plain(void)
{
    gm_bearing_data data = nothing(GM_FRICTION_HYDRODYNAMIC);
    data.type = GM_BEARING_PLAIN;
    data.d = 36e-3, data.D = none, data.B = 25e-3;
    data.clearance = 30e-6;
    return data;
}

/* A small gearbox bearing of the literature on presliding. */
static gm_bearing_data small_elastic(void)
{
    gm_bearing_data data = nothing(GM_FRICTION_ELASTIC);
    data.torque = 0.10, data.static_torque = 0.15, data.viscous = 2e-3;
    return data;
}

static gm_bearing_law law_of(gm_bearing_data data, double eta)
{
    gm_oil oil = {.nu = 9e-6, .eta = eta};
    gm_bearing_law law;
    gm_error error = {0};
    if (gm_bearing_law_make(&data, &oil, &law, &error) != GM_OK)
        fail_msg("%s", error.message);
    return law;
}

static double steady(const gm_bearing_law *law, double w, double F_r, double F_a)
{
    bearing_point p = {*law, w, F_r, F_a};
    return torque_at(&p).value;
}

/* T_ss = g(w) + sigma_2 w, printed with eight digits. */
static void elastic_friction_follows_the_stribeck_curve(void **state)
{
    (void)state;
    gm_bearing_law law = law_of(small_elastic(), 0.0075);
    const double table[][2] = {{0.01, 0.14805947}, {0.05, 0.11849397}, {0.1, 0.10111578},
                               {1., 0.102},        {10., 0.12},        {100., 0.3}};
    for (int i = 0; i < 6; i++)
        check_close("T_ss", steady(&law, table[i][0], 0., 0.), table[i][1], 1e-7);
    check_close("at rest", steady(&law, 0., 0., 0.), 0.15, 1e-14);
    gm_bearing_data data = small_elastic();
    data.friction = GM_FRICTION_HYDRODYNAMIC;
    gm_bearing_law same = law_of(data, 0.0075);
    assert_true(steady(&same, 3., 0., 0.) == steady(&law, 3., 0., 0.));
}

/* Petroff: eta 0.0075 Pa.s, 100 rad/s, r 18 mm, L 25 mm, c 30 um: 0.02290221 N.m. */
static void film_of_a_plain_bearing(void **state)
{
    (void)state;
    gm_bearing_law law = law_of(plain(), 0.0075);
    check_close("T", steady(&law, 100., 500., 20.), 0.02290221, 1e-6);
    /* boundary friction at rest, 0.1 * 0.018 m * 500 N, fades to the film alone */
    gm_bearing_data data = plain();
    data.static_mu = 0.1, data.stribeck = 5.;
    law = law_of(data, 0.0075);
    check_close("rest", steady(&law, 0., 300., 400.), 0.1 * 0.018 * 500., 1e-12);
    check_close("film", steady(&law, 100., 300., 400.), 0.02290221, 1e-6);
}

/* A rolling bearing's lever is half of d_m = 46 mm. */
static void coulomb_friction_is_proportional_to_load(void **state)
{
    (void)state;
    gm_bearing_data data = nothing(GM_FRICTION_COULOMB);
    data.torque = 0.02, data.mu = 0.0015;
    gm_bearing_law law = law_of(data, 0.0075);
    check_close("T", steady(&law, 50., 3., 4.), 0.02 + 0.0015 * 0.023 * 5., 1e-13);
    assert_true(steady(&law, 0., 300., 0.) == steady(&law, 900., 300., 0.));
    data.mu = none, data.d = data.D = none; /* needs no dimensions then */
    law = law_of(data, 0.0075);
    assert_true(steady(&law, 1., 1e4, 1e4) == 0.02);
}

/* The example of the Modelica Standard Library: 0 0; 1 2; 2 5; 3 8 gives 6.5 at 2.5. */
static gm_bearing_data tabulated(void)
{
    gm_bearing_data data = nothing(GM_FRICTION_COULOMB);
    const gm_friction_point table[] = {
        {.speed = 0.}, {1., 2., 0}, {2., 5., 0}, {3., 8., 0}};
    memcpy(data.table, table, sizeof table);
    data.n_table = 4;
    return data;
}

static void friction_from_a_table(void **state)
{
    (void)state;
    gm_bearing_law law = law_of(tabulated(), 0.0075);
    const double expected[][2] = {{0., 0.}, {0.5, 1.},  {1., 2.}, {1.5, 3.5},
                                  {2., 5.}, {2.5, 6.5}, {3., 8.}, {10., 29.}};
    for (int i = 0; i < 8; i++)
        check_close("T", 1. + steady(&law, expected[i][0], 100., 50.),
                    1. + expected[i][1], 1e-14);
    gm_bearing_data data = tabulated();
    data.table[0].torque = 3., data.mu = 0.001; /* more at rest, and with load */
    law = law_of(data, 0.0075);
    check_close("T", steady(&law, 0., 3., 4.), 3. + 0.001 * 0.023 * 5., 1e-13);
    bearing_point p = {law, 0.25, 300., 20.};
    check_slope("M(w)", torque_of_w, &p, p.w, torque_at(&p).d_speed);
    p.w = 7.;
    check_slope("M(w)", torque_of_w, &p, p.w, torque_at(&p).d_speed);
    data = tabulated(), data.n_table = 2; /* the shortest: one line */
    law = law_of(data, 0.0075);
    check_close("T", steady(&law, 7., 0., 0.), 14., 1e-14);
}

static void random_data(gm_bearing_data *data, uint64_t *seed, int i)
{
    static const gm_bearing_friction_model models[] = {
        GM_FRICTION_COULOMB, GM_FRICTION_ELASTIC, GM_FRICTION_HYDRODYNAMIC};
    *data = nothing(models[i % 3]);
    data->torque = random_scale(seed, 1e-2, 1.);
    data->mu = random_scale(seed, 1e-4, 0.1);
    data->static_torque = data->torque * random_between(seed, 1., 2.);
    data->static_mu = data->mu * random_between(seed, 1., 2.);
    data->viscous = random_scale(seed, 1e-5, 1e-2);
    data->stribeck = random_scale(seed, 0.05, 30.);
    data->damping = random_scale(seed, 1e-4, 9. * data->torque / data->stribeck);
}

static bearing_point random_point(uint64_t *seed, int i)
{
    gm_bearing_data data;
    random_data(&data, seed, i);
    bearing_point p = {.law = law_of(data, 0.0075)};
    p.w = random_scale(seed, 1e-3, 600.);
    p.F_r = random_scale(seed, 1e-1, 1e5);
    p.F_a = random_scale(seed, 1e-1, 1e5);
    return p;
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 31;
    for (int i = 0; i < 3000; i++) {
        bearing_point p = random_point(&seed, i);
        gm_bearing_torque M = torque_at(&p);
        assert_true(M.value > 0. && M.d_radial >= 0. && M.d_axial >= 0.);
        check_slope("M(w)", torque_of_w, &p, p.w, M.d_speed);
        check_slope("M(F_r)", torque_of_F_r, &p, p.F_r, M.d_radial);
        check_slope("M(F_a)", torque_of_F_a, &p, p.F_a, M.d_axial);
        p.F_r = p.F_a = 0.;
        M = torque_at(&p);
        check_slope("M(F_r) from 0", torque_of_F_r, &p, 1e-3, M.d_radial);
    }
}

static gm_bearing_state state_at(const bearing_point *p, double w, double z)
{
    gm_bearing_speed speed = gm_bearing_at_speed(&p->law, fabs(w));
    return gm_bearing_elastic(&p->law, &speed, w, z, p->F_r, p->F_a);
}

typedef struct changed {
    double w, z, F_r, F_a;
} changed;

/* Rate and torque by central differences along one argument. */
static void check_state_slopes(bearing_point p, changed at, changed step, double rate,
                               double torque)
{
    gm_bearing_state f[2];
    for (int k = 0; k < 2; k++) {
        double s = k ? 1. : -1.;
        p.F_r = at.F_r + s * step.F_r, p.F_a = at.F_a + s * step.F_a;
        f[k] = state_at(&p, at.w + s * step.w, at.z + s * step.z);
    }
    double h = 2. * (step.w + step.z + step.F_r + step.F_a);
    double d_rate = (f[1].rate - f[0].rate) / h;
    double d_torque = (f[1].torque - f[0].torque) / h;
    /* rounding of differences, 1e-10 of the value over the step; truncation 1e-6 */
    double noise_r = 1e-10 * fabs(f[1].rate) / h, noise_t = 1e-10 * fabs(f[1].torque) / h;
    if (!(fabs(d_rate - rate) <= 2e-6 * (fabs(rate) + 1e-3) + noise_r))
        fail_msg("rate: %.9g, by differences %.9g", rate, d_rate);
    if (!(fabs(d_torque - torque) <= 2e-6 * (fabs(torque) + 1e-3) + noise_t))
        fail_msg("torque: %.9g, by differences %.9g", torque, d_torque);
}

static void derivatives_in_motion_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 32;
    for (int i = 0; i < 3000; i++) {
        bearing_point p = random_point(&seed, 1);
        double w = p.w * (i & 1 ? 1. : -1.);
        double full = (steady(&p.law, p.w, p.F_r, p.F_a)) / 200.;
        double z = full * random_between(&seed, -1.5, 1.5);
        changed at = {w, z, p.F_r, p.F_a};
        gm_bearing_state b = state_at(&p, w, z);
        check_state_slopes(p, at, (changed){.w = 1e-6 * p.w}, b.rate_speed,
                           b.torque_speed);
        check_state_slopes(p, at, (changed){.z = 1e-6 * full}, b.rate_state,
                           b.torque_state);
        check_state_slopes(p, at, (changed){.F_r = 1e-6 * p.F_r}, b.rate_radial,
                           b.torque_radial);
        check_state_slopes(p, at, (changed){.F_a = 1e-6 * p.F_a}, b.rate_axial,
                           b.torque_axial);
        assert_true(b.loss >= 0.);
    }
}

/* What steady sliding settles on is the steady law, with the sign of the speed. */
static void motion_settles_on_the_steady_law(void **state)
{
    (void)state;
    uint64_t seed = 33;
    for (int i = 0; i < 300; i++) {
        bearing_point p = random_point(&seed, 1);
        double M = torque_at(&p).value, viscous = p.law.sliding.viscous * p.w;
        double w = i & 1 ? p.w : -p.w;
        gm_bearing_state b = state_at(&p, w, copysign((M - viscous) / 200., w));
        assert_true(fabs(b.rate) <= 1e-12 * p.w);
        check_close("T", b.torque, copysign(M, w), 1e-12);
        check_close("loss", b.loss, M * p.w, 1e-10);
    }
}

static void check_refused(gm_bearing_data data, const char *part)
{
    gm_oil oil = {.nu = 9e-6, .eta = 0.0075};
    gm_bearing_law law;
    gm_error error = {0};
    assert_int_equal(gm_bearing_law_make(&data, &oil, &law, &error), GM_ERR_MODEL);
    if (strstr(error.message, part) == NULL)
        fail_msg("\"%s\" lacks \"%s\"", error.message, part);
}

static void tables_that_are_none_are_refused(void **state)
{
    (void)state;
    gm_bearing_data data = tabulated();
    data.torque = 1.;
    check_refused(data, "torque_Nm and torque_over_speed exclude each other");
    data = tabulated();
    data.table[0].speed = 0.5;
    check_refused(data, "two points at least, the first at 0 rpm");
    data = tabulated();
    data.n_table = 1;
    check_refused(data, "two points at least, the first at 0 rpm");
    data = tabulated();
    data.table[2].speed = 1.;
    check_refused(data, "must rise; found 9.5493 rpm at point 3 after 9.5493");
    data = tabulated();
    data.table[3].torque = 4.;
    check_refused(data, "must not fall at its end, which is continued; found 4 N.m "
                        "after 5");
}

static void what_is_missing_is_refused(void **state)
{
    (void)state;
    gm_bearing_data data = nothing(GM_FRICTION_COULOMB);
    check_refused(data, "friction coulomb needs torque_Nm, torque_over_speed or mu");
    data.mu = 0.1, data.d = none;
    check_refused(data, "needs bore_mm beside mu");
    data.d = 70e-3;
    check_refused(data, "needs outer_mm, greater than bore_mm, beside mu");
    check_refused(nothing(GM_FRICTION_ELASTIC),
                  "friction elastic needs torque_Nm greater than 0");
    data = small_elastic();
    data.static_torque = 0.05;
    check_refused(data, "static_torque_Nm must not be less than torque_Nm; found 0.05 "
                        "and 0.1");
    data = small_elastic();
    data.damping = 100.;
    check_refused(data, "must be at most 9 times torque_Nm");
    data = small_elastic();
    data.mu = 0.1, data.static_mu = 0.01;
    check_refused(data, "static_mu must not be less than mu");
    check_refused(nothing(GM_FRICTION_HYDRODYNAMIC),
                  "friction hydrodynamic needs viscous_Nms_rad");
    data = plain();
    data.type = GM_BEARING_NEEDLE_ROLLER;
    check_refused(data, "clearance_mm belongs to a bearing of type plain");
    data = plain();
    data.clearance = 4e-3;
    check_refused(data, "less than a tenth of bore_mm; found 4 and 36");
    data.B = none;
    check_refused(data, "needs bore_mm and width_mm beside clearance_mm");
    data = plain();
    data.friction = GM_FRICTION_SKF;
    check_refused(data, "a plain bearing has friction none, coulomb, elastic or "
                        "hydrodynamic; found skf");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_friction_follows_the_stribeck_curve),
        cmocka_unit_test(film_of_a_plain_bearing),
        cmocka_unit_test(coulomb_friction_is_proportional_to_load),
        cmocka_unit_test(friction_from_a_table),
        cmocka_unit_test(tables_that_are_none_are_refused),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(derivatives_in_motion_are_exact),
        cmocka_unit_test(motion_settles_on_the_steady_law),
        cmocka_unit_test(what_is_missing_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
