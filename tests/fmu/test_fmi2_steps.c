/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Simulation through the FMI 2.0 interface: the same numbers as the core, energy, input
 * and output derivatives, several instances.
 */
#include "fmi2_fixture.h"

#include "gm_reduced.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Flange torques and gears of a drive-away with shifts, a change of direction of load and
 * a stop; smooth in between. */
static void command(double t, gm_reduced_inputs *in)
{
    in->oil_temperature = 353.15;
    in->path_tau[0] = t < 4 ? 60 * sin(1.3 * t) + 40 : -5;
    in->path_tau[1] = t > 3 && t < 8 ? 80 : 0;
    in->output_tau = t < 10 ? -300 - 20 * t : -700;
    in->gear[0] = t < 5 ? 1 : 3;
    in->gear[1] = t < 2 ? 0 : t < 9 ? 2 : 0;
}

static void apply(fmi2Component c, const gm_reduced_inputs *in)
{
    set(c, GM_OUTPUT_TAU, 0, in->output_tau);
    for (int p = 0; p < 2; p++) {
        set(c, GM_PATH_TAU, p, in->path_tau[p]);
        set_integer(c, GM_PATH_GEAR, p, in->gear[p]);
    }
}

static void assert_same(fmi2Component c, const gm_reduced_state *s)
{
    assert_true(get(c, GM_OUTPUT_W, 0) == s->w_o);
    assert_true(get(c, GM_OUTPUT_PHI, 0) == s->phi_o);
    assert_true(get(c, GM_WORK, 0) == s->work);
    assert_true(get(c, GM_LOSS_ENERGY, 0) == s->loss_energy);
    for (int p = 0; p < 2; p++) {
        assert_true(get(c, GM_PATH_W, p) == s->path[p].w);
        assert_true(get(c, GM_PATH_PHI, p) == s->path[p].phi);
        assert_int_equal(get_integer(c, GM_PATH_STATE, p), s->path[p].mode);
    }
}

static void a_long_run_has_the_bits_of_the_core(void **state)
{
    host h;
    gm_reduced_params params;
    gm_reduced_inputs in = {0};
    gm_reduced_state s;
    const double w[2] = {0, 0}, dt = 0.001;
    (void)state;
    fmi2Component c = host_initialise(&h);
    command(0, &in);
    apply(c, &in);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    gm_reduced_default_params(gm_model_map(), &params);
    assert_int_equal(gm_reduced_start(gm_model_map(), &in, 0, w, &s), 0);
    for (int i = 0; i < 12000; i++) {
        command(i * dt, &in);
        apply(c, &in);
        (void)gm_reduced_step(gm_model_map(), &params, &in, dt, &s);
        if (fmi2DoStep(c, i * dt, dt, fmi2True) > fmi2Warning)
            fail_msg("%s", h.text);
        if (i % 100 == 0)
            assert_same(c, &s);
    }
    assert_same(c, &s);
    fmi2FreeInstance(c);
}

/* work = kinetic + loss to rounding, whatever the step and the capacity */
static void energy_is_accounted_for_at_every_step(void **state)
{
    const double steps[] = {0.0005, 0.01, 0.1}, capacity[] = {5, 30, 1e30};
    (void)state;
    for (int k = 0; k < 9; k++) {
        host h;
        double dt = steps[k / 3], largest = 1;
        gm_reduced_inputs in = {0};
        fmi2Component c = host_initialise(&h);
        set(c, GM_PATH_SYNC_TORQUE, 0, capacity[k % 3]);
        set(c, GM_PATH_SYNC_TORQUE, 1, capacity[k % 3]);
        set(c, GM_OUTPUT_W_START, 0, 3);
        assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
        double at_start = get(c, GM_KINETIC_ENERGY, 0);
        for (int i = 0; i * dt < 12; i++) {
            command(i * dt, &in);
            apply(c, &in);
            assert_true(fmi2DoStep(c, i * dt, dt, fmi2True) <= fmi2Warning);
            double work = get(c, GM_WORK, 0), loss = get(c, GM_LOSS_ENERGY, 0);
            double kinetic = get(c, GM_KINETIC_ENERGY, 0);
            largest = fmax(largest, fmax(fabs(work), kinetic));
            /* 1e-9 of what went through: 24,000 roundings of 1e-16 leave 1e-11 */
            if (fabs(work - loss - (kinetic - at_start)) > 1e-9 * largest)
                fail_msg("step %g s at %g s: work %g, loss %g, kinetic %g", dt, i * dt,
                         work, loss, kinetic);
        }
        fmi2FreeInstance(c);
    }
}

/* With the slope given, one step integrates a ramp of torque as the core does. */
static void input_derivatives_make_ramps(void **state)
{
    host h;
    gm_reduced_params params;
    gm_reduced_inputs in = {.oil_temperature = 353.15, .gear = {3, 0}};
    gm_reduced_state s;
    const double w[2] = {0, 0};
    const unsigned vr[] = {reference(GM_PATH_TAU, 0), reference(GM_OUTPUT_TAU, 0)};
    const int order[] = {1, 1};
    const double rate[] = {50, -100};
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 0, 3);
    set(c, GM_OUTPUT_W_START, 0, 20);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    set(c, GM_PATH_TAU, 0, 30);
    assert_int_equal(fmi2SetRealInputDerivatives(c, vr, 2, order, rate), fmi2OK);
    gm_reduced_default_params(gm_model_map(), &params);
    (void)gm_reduced_start(gm_model_map(), &in, 20, w, &s);
    in.path_tau_rate[0] = 50;
    in.output_tau_rate = -100;
    for (int i = 0; i < 3; i++) { /* the signal goes on until it is set again */
        /* binary fractions: the sums are exact */
        in.path_tau[0] = 30 + 50 * 0.125 * i;
        in.output_tau = -100 * 0.125 * i;
        (void)gm_reduced_step(gm_model_map(), &params, &in, 0.125, &s);
        assert_int_equal(fmi2DoStep(c, 0.125 * i, 0.125, fmi2True), fmi2OK);
        assert_same(c, &s);
        assert_true(get(c, GM_PATH_TAU, 0) == 30 + 50 * 0.125 * (i + 1));
    }
    fmi2FreeInstance(c);
}

static void wrong_input_derivatives_are_refused(void **state)
{
    const unsigned torque = reference(GM_PATH_TAU, 0), output = reference(GM_OUTPUT_W, 0);
    const unsigned oil = reference(GM_OIL_TEMPERATURE, 0);
    host h;
    (void)state;
    fmi2Component c = host_start(&h);
    assert_int_equal(fmi2SetRealInputDerivatives(c, &oil, 1, &(int){1}, &(double){1}),
                     fmi2OK);
    assert_refused(&h,
                   fmi2SetRealInputDerivatives(c, &torque, 1, &(int){2}, &(double){1}),
                   "odd.tau", "order 2", NULL);
    fmi2FreeInstance(c);
    c = host_start(&h);
    assert_refused(
        &h, fmi2SetRealInputDerivatives(c, &torque, 1, &(int){1}, &(double){(double)NAN}),
        "finite", NULL);
    fmi2FreeInstance(c);
    c = host_start(&h);
    assert_refused(&h,
                   fmi2SetRealInputDerivatives(c, &output, 1, &(int){1}, &(double){1}),
                   "not an input", NULL);
    fmi2FreeInstance(c);
}

static double rate_of(fmi2Component c, gm_variable_id id, int p)
{
    double value;
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2GetRealOutputDerivatives(c, &vr, 1, &(int){1}, &value), fmi2OK);
    return value;
}

static void output_derivatives_are_speeds_and_accelerations(void **state)
{
    host h;
    double value;
    unsigned a = reference(GM_OUTPUT_A, 0), w = reference(GM_OUTPUT_W, 0);
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 1, 2);
    set(c, GM_OUTPUT_W_START, 0, 20);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    set(c, GM_PATH_TAU, 1, 70);
    assert_true(rate_of(c, GM_PATH_PHI, 1) == get(c, GM_PATH_W, 1));
    assert_true(rate_of(c, GM_OUTPUT_PHI, 0) == 20);
    assert_true(rate_of(c, GM_PATH_W, 0) == get(c, GM_PATH_A, 0));
    assert_true(rate_of(c, GM_OUTPUT_W, 0) == get(c, GM_OUTPUT_A, 0));
    assert_true(rate_of(c, GM_LOSS_ENERGY, 0) == get(c, GM_LOSS_POWER, 0));
    assert_int_equal(fmi2GetRealOutputDerivatives(c, &a, 1, &(int){1}, &value),
                     fmi2Discard);
    assert_int_equal(fmi2GetRealOutputDerivatives(c, &w, 1, &(int){2}, &value),
                     fmi2Discard);
    assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2OK);
    fmi2FreeInstance(c);
}

static void instances_do_not_know_of_each_other(void **state)
{
    enum { N = 8 };
    host h[N];
    fmi2Component c[N];
    (void)state;
    for (int k = 0; k < N; k++) {
        c[k] = host_initialise(&h[k]);
        set_integer(c[k], GM_PATH_GEAR, 0, 3);
        set(c[k], GM_OUTPUT_W_START, 0, 10 + k / 2);
        assert_int_equal(fmi2ExitInitializationMode(c[k]), fmi2OK);
    }
    for (int i = 0; i < 200; i++)
        for (int k = 0; k < N; k++) {
            set(c[k], GM_PATH_TAU, 0, 3 * (k / 2));
            assert_int_equal(fmi2DoStep(c[k], i * 0.01, 0.01, fmi2True), fmi2OK);
        }
    for (int k = 0; k < N; k += 2) {
        assert_true(get(c[k], GM_OUTPUT_W, 0) == get(c[k + 1], GM_OUTPUT_W, 0));
        assert_true(get(c[k], GM_LOSS_ENERGY, 0) == get(c[k + 1], GM_LOSS_ENERGY, 0));
        if (k > 0)
            assert_true(get(c[k], GM_OUTPUT_W, 0) > get(c[k - 1], GM_OUTPUT_W, 0));
    }
    for (int k = 0; k < N; k++)
        fmi2FreeInstance(c[k]);
    assert_int_equal(fixture_blocks(), 0);
}

static void reset_gives_the_same_run_again(void **state)
{
    host h;
    double first[2];
    (void)state;
    fmi2Component c = host_instantiate(&h);
    for (int run = 0; run < 2; run++) {
        gm_reduced_inputs in = {0};
        assert_int_equal(fmi2SetupExperiment(c, 0, 0, 0, 0, 0), fmi2OK);
        assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
        assert_true(get(c, GM_PATH_TAU, 0) == 0);
        assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
        for (int i = 0; i < 3000; i++) {
            command(i * 0.001, &in);
            apply(c, &in);
            assert_true(fmi2DoStep(c, i * 0.001, 0.001, fmi2True) <= fmi2Warning);
        }
        first[run] = get(c, GM_OUTPUT_PHI, 0);
        assert_int_equal(fmi2Reset(c), fmi2OK);
    }
    assert_true(first[0] == first[1] && first[0] != 0);
    fmi2FreeInstance(c);
}

/* A load below the break-away torque of P = 2 N.m holds for ever, exactly. */
static void nothing_creeps_at_standstill(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_start(&h);
    set(c, GM_OUTPUT_TAU, 0, -1.9);
    for (int i = 0; i < 1000; i++)
        assert_int_equal(fmi2DoStep(c, i * 0.1, 0.1, fmi2True), fmi2OK);
    assert_true(get(c, GM_OUTPUT_W, 0) == 0 && get(c, GM_OUTPUT_PHI, 0) == 0);
    fmi2FreeInstance(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_long_run_has_the_bits_of_the_core),
        cmocka_unit_test(energy_is_accounted_for_at_every_step),
        cmocka_unit_test(input_derivatives_make_ramps),
        cmocka_unit_test(wrong_input_derivatives_are_refused),
        cmocka_unit_test(output_derivatives_are_speeds_and_accelerations),
        cmocka_unit_test(instances_do_not_know_of_each_other),
        cmocka_unit_test(reset_gives_the_same_run_again),
        cmocka_unit_test(nothing_creeps_at_standstill),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
