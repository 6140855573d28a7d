/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Shafts that twist: stiffness of their pieces, stations, compliance and motion.
 */
#include "motion_fixture.h"
#include "property.h"
#include "reducer_fixture.h"

#include "base/alloc.h"
#include "model/motion.h"
#include "model/power.h"

#include <string.h>

/* Input shaft from 0 to 160 mm: 30 mm, hollow 10 mm up to 100 mm, then 20 mm solid. */
static gm_segment stepped[2] = {
    {.from = 0., .to = 0.1, .diameter = 0.030, .bore = 0.010},
    {.from = 0.1, .to = 0.160, .diameter = 0.020},
};

static void make_stepped(reducer *r)
{
    reducer_make(r);
    r->shafts[0].segments = stepped;
    r->shafts[0].n_segments = 2;
    r->shafts[0].torsion = GM_TORSION_ELASTIC;
    r->shafts[0].torsion_damping = 0.05;
    r->shafts[0].flange = (double)NAN;
}

/* G J_p / L of the lengths in series. */
static void stiffness_of_cylinders_in_series(void **state)
{
    (void)state;
    reducer r;
    make_stepped(&r);
    double J_a = GM_PI / 32. * (0.03 * 0.03 * 0.03 * 0.03 - 0.01 * 0.01 * 0.01 * 0.01);
    double J_b = GM_PI / 32. * 0.02 * 0.02 * 0.02 * 0.02;
    check_close("one", gm_shaft_stiffness(&r.shafts[0], 0.02, 0.08), 79.2e9 * J_a / 0.06,
                1e-12);
    check_close("two", gm_shaft_stiffness(&r.shafts[0], 0.05, 0.12),
                1. / (0.05 / (79.2e9 * J_a) + 0.02 / (79.2e9 * J_b)), 1e-12);
}

static void stations_are_where_torque_enters(void **state)
{
    (void)state;
    reducer r;
    gm_stations st;
    make_stepped(&r);
    assert_int_equal(gm_stations_make(&r.d, 0, &st, NULL), GM_OK);
    assert_int_equal(st.n, 2); /* flange at 0, pinion at 60 mm */
    check_close("gear", st.x[1], 0.060, 1e-15);
    /* inertia: half of 60 mm to the flange, the rest to the gear */
    double a = 0.060 * (0.03 * 0.03 * 0.03 * 0.03 - 0.01 * 0.01 * 0.01 * 0.01);
    double all = a / 0.6 + 0.060 * 0.02 * 0.02 * 0.02 * 0.02;
    check_close("share", st.share[0], 0.5 * a / all, 1e-12);
    check_close("all", st.share[0] + st.share[1], 1., 1e-15);
    assert_int_equal(gm_station_at(&st, 0.031), 1);
    assert_int_equal(gm_station_at(&st, 0.029), 0);
    assert_int_equal(gm_station_at(&st, (double)NAN), 0);
    gm_stations_clear(&st);
    r.shafts[0].flange = 0.0605; /* nearer than 1 mm: the same place */
    assert_int_equal(gm_stations_make(&r.d, 0, &st, NULL), GM_OK);
    assert_int_equal(st.n, 1);
    gm_stations_clear(&st);
    assert_int_equal(gm_stations_make(&r.d, 1, &st, NULL), GM_OK); /* rigid */
    assert_int_equal(st.n, 1);
    gm_stations_clear(&st);
}

static double flexibility(gm_description *d)
{
    gm_gearset *g = NULL;
    gm_compliance c;
    assert_int_equal(gm_gearset_create(d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_gearset_compliance(g, 0, 1, &c, NULL), GM_OK);
    gm_gearset_destroy(g);
    return 1. / c.stiffness;
}

/* The input torque goes from the flange to the pinion; on the other side of the mesh
 * u = 49/32 of it from the wheel's lock at 60 mm to the flange at 160 mm. */
static void compliance_adds_the_pieces(void **state)
{
    (void)state;
    reducer r;
    gm_segment output[1] = {{.from = 0., .to = 0.160, .diameter = 0.025}};
    make_stepped(&r);
    r.shafts[0].torsion = GM_TORSION_RIGID;
    double rigid = flexibility(&r.d);
    r.shafts[0].torsion = GM_TORSION_ELASTIC;
    double input = 1. / gm_shaft_stiffness(&r.shafts[0], 0., 0.060);
    check_close("input", flexibility(&r.d), rigid + input, 1e-12);
    r.shafts[1].segments = output;
    r.shafts[1].n_segments = 1;
    r.shafts[1].torsion = GM_TORSION_ELASTIC;
    r.shafts[1].flange = 0.160;
    double u = 49. / 32., piece = 1. / gm_shaft_stiffness(&r.shafts[1], 0.060, 0.160);
    check_close("both", flexibility(&r.d), rigid + input + u * u * piece, 1e-12);
}

/* Against a wall the piece settles at the twist T L / (G J_p). */
static void a_held_shaft_twists(void **state)
{
    (void)state;
    moving m;
    reducer r;
    const double speed[GM_MAX_FLANGES] = {0.};
    make_stepped(&r);
    r.shafts[1].inertia = 1e3;
    r.meshes[0].flanks.backlash = 0.02e-3;
    moving_make(&m, &r.d);
    m.input.gear[0] = 1;
    moving_start(&m, speed);
    m.input.torque[1] = 80.;
    moving_run(&m, 0.12, 2e-6);
    int row = m.motion->n_rows - 1;
    double twist = m.x[m.motion->n_nodes + row];
    /* what is left of the ringing */
    check_close("twist", twist, 80. / gm_shaft_stiffness(&r.shafts[0], 0., 0.060), 1e-3);
    check_close("torque", moving_signal(&m, "shaft.input.1.torque"), 80., 1e-3);
    assert_true(fabs(moving_signal(&m, "body.input.1.w") -
                     moving_signal(&m, "body.input.2.w")) < 0.1);
    moving_clear(&m);
}

/* Every state has a name, and the signals of that name that are states show them. */
static void states_have_the_names_of_signals(void **state)
{
    (void)state;
    for (int holding = 0; holding < 2; holding++) {
        moving m;
        const double speed[GM_MAX_FLANGES] = {100., 50., 10.};
        if (holding)
            moving_read_holding(&m, MOTION_EXAMPLES "dct7.yaml");
        else
            moving_read_twisting(&m, MOTION_EXAMPLES "dct7.yaml");
        moving_start(&m, speed);
        for (int i = 0; i < m.n; i++)
            m.x[i] = 1e-4 * (i + 1);
        int shown = m.motion->n_nodes + m.gearset->n_meshes;
        for (int i = 0; i < m.n; i++) {
            const char *name = gm_motion_state_name(m.motion, i);
            double value = moving_signal(&m, name);
            assert_true(i >= shown || value == m.x[i]);
            for (int k = 0; k < i; k++)
                assert_string_not_equal(name, gm_motion_state_name(m.motion, k));
        }
        const char *last = gm_motion_state_name(m.motion, m.n - 1);
        assert_ptr_equal(strstr(last, holding ? "bearing." : "shaft."), last);
        moving_clear(&m);
    }
}

/* All shafts of the example twist: inertia stays, the account closes. Runge-Kutta of
 * fourth order at 0.2 us; the stiffest piece has 40 kHz. */
static void the_account_closes_with_torsion(void **state)
{
    (void)state;
    moving rigid, m;
    const double speed[GM_MAX_FLANGES] = {30., 0., 0.};
    moving_read(&rigid, MOTION_EXAMPLES "dct7.yaml");
    moving_read_twisting(&m, MOTION_EXAMPLES "dct7.yaml");
    m.input.gear[0] = rigid.input.gear[0] = 3;
    m.input.gear[1] = rigid.input.gear[1] = 4;
    moving_start(&m, speed);
    moving_start(&rigid, speed);
    double stored = moving_view(&m).stored_energy;
    check_close("inertia", stored, moving_view(&rigid).stored_energy, 1e-12);
    m.input.torque[0] = -400.;
    m.input.torque[1] = 80.;
    moving_run(&m, 1e-3, 2e-7);
    m.input.torque[1] = -60.;
    moving_run(&m, 1e-3, 2e-7);
    gm_motion_view view = moving_view(&m);
    double left = m.work - m.lost - (view.stored_energy - stored);
    if (!(fabs(left) <= 1e-9 * stored))
        fail_msg("%.9g J left of %.9g J", left, stored);
    moving_clear(&m);
    moving_clear(&rigid);
}

static void without_memory_nothing_is_left_behind(void **state)
{
    (void)state;
    reducer r;
    make_stepped(&r);
    gm_gearset *g = NULL;
    gm_nodes nodes;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    gm_status status = GM_ERR_MEMORY;
    int k = 0;
    while (status == GM_ERR_MEMORY) {
        gm_alloc_fail_after(++k);
        status = gm_nodes_make(g, &nodes, NULL);
        gm_alloc_fail_after(0);
    }
    assert_int_equal(status, GM_OK);
    assert_true(k > 8);
    gm_nodes_clear(&nodes);
    gm_gearset_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stiffness_of_cylinders_in_series),
        cmocka_unit_test(stations_are_where_torque_enters),
        cmocka_unit_test(compliance_adds_the_pieces),
        cmocka_unit_test(a_held_shaft_twists),
        cmocka_unit_test(states_have_the_names_of_signals),
        cmocka_unit_test(the_account_closes_with_torsion),
        cmocka_unit_test(without_memory_nothing_is_left_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
