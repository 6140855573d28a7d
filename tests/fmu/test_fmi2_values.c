/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Variables through the FMI 2.0 interface: what may be set when, what is refused, and
 * what start values mean.
 */
#include "fmi2_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static fmi2Status set_real(fmi2Component c, gm_variable_id id, int p, double value)
{
    unsigned vr = reference(id, p);
    return fmi2SetReal(c, &vr, 1, &value);
}

static void start_values_are_in_the_binary(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < (gm_variables[id].scope == GM_SCOPE_PATH ? 2 : 1); p++) {
            gm_variable_id v = (gm_variable_id)id;
            double expected = gm_variables[id].start;
            if (v == GM_PATH_SYNC_TORQUE)
                expected = gm_model_map()->path[p].sync_torque;
            if (v == GM_OIL_TEMPERATURE)
                expected = gm_model_map()->oil_temperature;
            if (gm_variables[id].initial == GM_INITIAL_CALCULATED)
                continue;
            if (gm_variables[id].type == GM_TYPE_REAL)
                assert_true(get(c, v, p) == expected);
            else
                assert_int_equal(get_integer(c, v, p), (int)expected);
        }
    fmi2FreeInstance(c);
}

static void not_finite_values_are_refused(void **state)
{
    const double wrong[] = {(double)NAN, (double)INFINITY, (double)-INFINITY};
    (void)state;
    for (size_t i = 0; i < 3; i++)
        for (int id = 0; id < GM_VARIABLES; id++) {
            host h;
            if (gm_variables[id].type != GM_TYPE_REAL ||
                (gm_variables[id].initial != GM_INITIAL_EXACT &&
                 gm_variables[id].causality != GM_CAUSALITY_INPUT))
                continue;
            fmi2Component c = host_instantiate(&h);
            assert_refused(&h, set_real(c, (gm_variable_id)id, 0, wrong[i]), "finite",
                           gm_variables[id].name, NULL);
            fmi2FreeInstance(c);
        }
}

static void unknown_references_are_refused(void **state)
{
    const unsigned wrong[] = {GM_SLOTS * GM_VARIABLES, 0xffffffffu,
                              GM_SLOTS * GM_OUTPUT_TAU + 1, GM_SLOTS * GM_PATH_TAU,
                              GM_SLOTS * GM_PATH_TAU + 3};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        host h;
        fmi2Component c = host_initialise(&h);
        assert_refused(&h, fmi2SetReal(c, &wrong[i], 1, &(double){0}), "reference", NULL);
        assert_refused(&h, fmi2GetReal(c, &wrong[i], 1, &(double){0}), "reference", NULL);
        fmi2FreeInstance(c);
    }
}

static void wrong_types_are_refused(void **state)
{
    host h;
    const char *text = "";
    unsigned real = reference(GM_PATH_TAU, 1), integer = reference(GM_PATH_GEAR, 1);
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_refused(&h, fmi2GetInteger(c, &real, 1, &(int){0}), "even.tau", "Integer",
                   NULL);
    assert_refused(&h, fmi2GetReal(c, &integer, 1, &(double){0}), "even.gear", NULL);
    assert_refused(&h, fmi2GetBoolean(c, &integer, 1, &(int){0}), "Boolean", NULL);
    assert_refused(&h, fmi2GetString(c, &real, 1, &text), "String", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, fmi2SetInteger(c, &real, 1, &(int){0}), "even.tau", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, fmi2SetReal(c, &integer, 1, &(double){0}), "even.gear", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, fmi2SetBoolean(c, &real, 1, &(int){0}), "even.tau", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, fmi2SetString(c, &real, 1, &text), "String", NULL);
    fmi2FreeInstance(c);
}

static void calculated_outputs_are_never_set(void **state)
{
    (void)state;
    for (int id = 0; id < GM_VARIABLES; id++) {
        host h;
        unsigned vr = reference((gm_variable_id)id, 0);
        if (gm_variables[id].initial != GM_INITIAL_CALCULATED)
            continue;
        fmi2Component c = host_initialise(&h);
        fmi2Status status = gm_variables[id].type == GM_TYPE_REAL
                                ? fmi2SetReal(c, &vr, 1, &(double){1})
                            : gm_variables[id].type == GM_TYPE_BOOLEAN
                                ? fmi2SetBoolean(c, &vr, 1, &(int){1})
                                : fmi2SetInteger(c, &vr, 1, &(int){1});
        assert_refused(&h, status, "output", gm_variables[id].name, NULL);
        fmi2FreeInstance(c);
    }
}

/* fixed parameters and start values belong to the time before; tunable ones live on */
static void only_inputs_and_tunable_parameters_are_set_between_steps(void **state)
{
    (void)state;
    for (int id = 0; id < GM_VARIABLES; id++) {
        host h;
        const gm_variable *v = &gm_variables[id];
        bool may = v->causality == GM_CAUSALITY_INPUT ||
                   v->variability == GM_VARIABILITY_TUNABLE;
        if (v->type != GM_TYPE_REAL || v->initial == GM_INITIAL_CALCULATED)
            continue;
        fmi2Component c = host_start(&h);
        fmi2Status status = set_real(c, (gm_variable_id)id, 0, 2.5);
        if (may)
            assert_int_equal(status, fmi2OK);
        else
            assert_refused(&h, status, "after initialisation", "2.5", v->name, NULL);
        fmi2FreeInstance(c);
    }
}

static void values_outside_their_range_are_refused(void **state)
{
    host h;
    unsigned fidelity = reference(GM_FIDELITY, 0);
    (void)state;
    fmi2Component c = host_instantiate(&h);
    assert_refused(&h, set_real(c, GM_LOSS_SCALE, 0, -0.5), "loss_scale", "-0.5", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, set_real(c, GM_PATH_SYNC_TORQUE, 1, 0), "even.sync_torque", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, set_real(c, GM_OIL_TEMPERATURE, 0, -1), "oil_temperature", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, fmi2SetInteger(c, &fidelity, 1, &(int){3}), "fidelity", "3", NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_int_equal(fmi2SetInteger(c, &fidelity, 1, &(int){1}), fmi2OK);
    fmi2FreeInstance(c);
}

static void missing_arrays_are_refused(void **state)
{
    host h;
    unsigned vr = reference(GM_OUTPUT_TAU, 0);
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_refused(&h, fmi2GetReal(c, NULL, 1, &(double){0}), "missing", NULL);
    assert_refused(&h, fmi2GetReal(c, &vr, 1, NULL), "missing", NULL);
    assert_int_equal(fmi2GetReal(c, NULL, 0, NULL), fmi2OK);
    assert_refused(&h, fmi2GetRealOutputDerivatives(c, &vr, 1, NULL, &(double){0}),
                   "missing", NULL);
    fmi2FreeInstance(c);
}

static void output_speed_wins_over_engaged_paths(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 0, 1);
    set(c, GM_OUTPUT_W_START, 0, 10);
    set(c, GM_PATH_W_START, 0, 77);
    set(c, GM_PATH_W_START, 1, 55);
    set(c, GM_PATH_PHI, 1, 3);
    assert_int_equal(get_integer(c, GM_PATH_STATE, 0), GM_PATH_ENGAGED);
    assert_int_equal(get_integer(c, GM_PATH_STATE, 1), GM_PATH_NEUTRAL);
    assert_true(get(c, GM_PATH_W, 0) == 150);
    assert_true(get(c, GM_PATH_W, 1) == 55);
    assert_true(get(c, GM_PATH_PHI, 1) == 3);
    /* 1/2 (0.1 + 15^2 0.01) 10^2 + 1/2 0.01 55^2, exact to rounding */
    assert_true(fabs(get(c, GM_KINETIC_ENERGY, 0) - (117.5 + 15.125)) < 1e-12 * 132);
    set(c, GM_OUTPUT_W_START, 0, 20); /* start values still count */
    assert_true(get(c, GM_PATH_W, 0) == 300);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    assert_true(get(c, GM_OUTPUT_W, 0) == 20);
    fmi2FreeInstance(c);
}

/* third gear driving: D = 0.02 tau_m and P = 2 + 0.01 w_o, by hand */
static void outputs_follow_the_inputs_at_once(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 0, 3);
    set(c, GM_OUTPUT_W_START, 0, 50);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    set(c, GM_PATH_TAU, 0, 100);
    set(c, GM_OUTPUT_TAU, 0, -300);
    /* tau_m = 100 + C - 0.06 a with C on the odd shaft -0.0005 (300 - 0) = -0.15;
       (0.1 + 0.36) a = 6 * 99.85 - 300 - 2.5 - 6 * 0.02 tau_m */
    double a = (6 * 99.85 - 302.5 - 0.12 * 99.85) / (0.46 - 0.12 * 0.06);
    assert_true(fabs(get(c, GM_OUTPUT_A, 0) - a) < 1e-9 * a);
    assert_true(fabs(get(c, GM_PATH_A, 0) - 6 * a) < 1e-9 * 6 * a);
    assert_true(fabs(get(c, GM_PATH_LOSS_TORQUE, 0) - 0.02 * (99.85 - 0.06 * a)) < 1e-9);
    assert_true(fabs(get(c, GM_OUTPUT_LOSS_TORQUE, 0) - 2.5) < 1e-12);
    set(c, GM_LOSS_SCALE, 0, 0); /* tunable: has its effect at once */
    assert_true(fabs(get(c, GM_OUTPUT_A, 0) - 300 / 0.46) < 1e-9 * 652);
    assert_true(get(c, GM_LOSS_POWER, 0) == 0);
    fmi2FreeInstance(c);
}

static void an_unknown_gear_keeps_the_gear_and_warns_once(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 0, 3);
    set(c, GM_OUTPUT_W_START, 0, 50);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    set_integer(c, GM_PATH_GEAR, 0, 2); /* an even gear */
    assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2Warning);
    assert_string_equal(h.category, "logStatusWarning");
    assert_non_null(strstr(h.text, "odd.gear = 2"));
    assert_int_equal(get_boolean(c, GM_PATH_GEAR_REFUSED, 0), 1);
    assert_int_equal(get_boolean(c, GM_PATH_GEAR_REFUSED, 1), 0);
    assert_int_equal(get_integer(c, GM_PATH_STATE, 0), GM_PATH_ENGAGED);
    assert_true(get(c, GM_PATH_W, 0) == 6 * get(c, GM_OUTPUT_W, 0));
    assert_int_equal(fmi2DoStep(c, 0.001, 0.001, fmi2True), fmi2OK); /* once */
    assert_int_equal(get_boolean(c, GM_PATH_GEAR_REFUSED, 0), 1);
    set_integer(c, GM_PATH_GEAR, 0, 99);
    assert_int_equal(fmi2DoStep(c, 0.002, 0.001, fmi2True), fmi2Warning); /* another */
    set_integer(c, GM_PATH_GEAR, 0, 3);
    assert_int_equal(fmi2DoStep(c, 0.003, 0.001, fmi2True), fmi2OK);
    assert_int_equal(get_boolean(c, GM_PATH_GEAR_REFUSED, 0), 0);
    set_integer(c, GM_PATH_GEAR, 0, 99);
    assert_int_equal(fmi2DoStep(c, 0.004, 0.001, fmi2True), fmi2Warning); /* anew */
    fmi2FreeInstance(c);
}

static void an_unknown_gear_at_the_start_is_neutral(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 1, 7);
    assert_int_equal(get_boolean(c, GM_PATH_GEAR_REFUSED, 1), 1);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2Warning);
    assert_non_null(strstr(h.text, "even.gear = 7"));
    assert_int_equal(get_integer(c, GM_PATH_STATE, 1), GM_PATH_NEUTRAL);
    fmi2FreeInstance(c);
}

static void leaving_the_map_is_flagged_always_and_told_once(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 0, 3);
    set(c, GM_OUTPUT_W_START, 0, 50);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    set(c, GM_PATH_TAU, 0, 390);
    set(c, GM_OUTPUT_TAU, 0, -2290);
    assert_int_equal(get_boolean(c, GM_OUT_OF_MAP, 0), 0);
    set(c, GM_PATH_TAU, 0, 500); /* the tables end at 400 N.m */
    set(c, GM_OUTPUT_TAU, 0, -3000);
    assert_int_equal(get_boolean(c, GM_OUT_OF_MAP, 0), 1);
    assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2Warning);
    assert_non_null(strstr(h.text, "left the map"));
    assert_int_equal(fmi2DoStep(c, 0.001, 0.001, fmi2True), fmi2OK);
    assert_int_equal(get_boolean(c, GM_OUT_OF_MAP, 0), 1);
    assert_int_equal(h.messages, 1);
    fmi2FreeInstance(c);
}

static void overflowing_outputs_are_an_error_not_a_number(void **state)
{
    host h;
    double value = 5;
    unsigned vr = reference(GM_LOSS_POWER, 0);
    (void)state;
    fmi2Component c = host_initialise(&h);
    set(c, GM_OUTPUT_W_START, 0, 1e200);
    assert_refused(&h, fmi2GetReal(c, &vr, 1, &value), "loss_power", "overflow", NULL);
    assert_true(value == 5);
    fmi2FreeInstance(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(start_values_are_in_the_binary),
        cmocka_unit_test(not_finite_values_are_refused),
        cmocka_unit_test(unknown_references_are_refused),
        cmocka_unit_test(wrong_types_are_refused),
        cmocka_unit_test(calculated_outputs_are_never_set),
        cmocka_unit_test(only_inputs_and_tunable_parameters_are_set_between_steps),
        cmocka_unit_test(values_outside_their_range_are_refused),
        cmocka_unit_test(missing_arrays_are_refused),
        cmocka_unit_test(output_speed_wins_over_engaged_paths),
        cmocka_unit_test(outputs_follow_the_inputs_at_once),
        cmocka_unit_test(an_unknown_gear_keeps_the_gear_and_warns_once),
        cmocka_unit_test(an_unknown_gear_at_the_start_is_neutral),
        cmocka_unit_test(leaving_the_map_is_flagged_always_and_told_once),
        cmocka_unit_test(overflowing_outputs_are_an_error_not_a_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
