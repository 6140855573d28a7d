/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Model Exchange through the functions of FMI 2.0: what is allowed when, and what is
 * refused.
 */
#include "fmi2_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { NX = 10, NZ = 6 }; /* of two paths */

/* ---- order of calls ---- */

typedef enum place {
    INSTANTIATED,
    INITIALISING,
    EVENT,
    UPDATED, /* in event mode, after the update */
    CONTINUOUS,
    TERMINATED,
    BROKEN,
    PLACES
} place;

static fmi2Component bring_to(host *h, place where)
{
    fmi2EventInfo info;
    fmi2Component c = host_instantiate_as(h, fmi2ModelExchange);
    if (where == INSTANTIATED)
        return c;
    assert_int_equal(fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    if (where == INITIALISING)
        return c;
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    if (where == EVENT)
        return c;
    assert_int_equal(fmi2NewDiscreteStates(c, &info), fmi2OK);
    if (where == UPDATED)
        return c;
    assert_int_equal(fmi2EnterContinuousTimeMode(c), fmi2OK);
    if (where == TERMINATED)
        assert_int_equal(fmi2Terminate(c), fmi2OK);
    if (where == BROKEN)
        assert_int_equal(fmi2SetTime(c, (double)NAN), fmi2Error);
    return c;
}

static fmi2Status call_update(fmi2Component c)
{
    fmi2EventInfo info;
    return fmi2NewDiscreteStates(c, &info);
}

static fmi2Status call_completed(fmi2Component c)
{
    fmi2Boolean enter = fmi2True, terminate = fmi2True;
    fmi2Status status = fmi2CompletedIntegratorStep(c, fmi2True, &enter, &terminate);
    if (status == fmi2OK)
        assert_true(!enter && !terminate);
    return status;
}

static fmi2Status call_time(fmi2Component c)
{
    return fmi2SetTime(c, 0.5);
}

static fmi2Status call_set_states(fmi2Component c)
{
    return fmi2SetContinuousStates(c, (double[NX]){0}, NX);
}

static fmi2Status call_get_states(fmi2Component c)
{
    return fmi2GetContinuousStates(c, (double[NX]){0}, NX);
}

static fmi2Status call_rates(fmi2Component c)
{
    return fmi2GetDerivatives(c, (double[NX]){0}, NX);
}

static fmi2Status call_indicators(fmi2Component c)
{
    return fmi2GetEventIndicators(c, (double[NZ]){0}, NZ);
}

static fmi2Status call_nominals(fmi2Component c)
{
    return fmi2GetNominalsOfContinuousStates(c, (double[NX]){0}, NX);
}

static fmi2Status call_set_input(fmi2Component c)
{
    unsigned vr = reference(GM_OUTPUT_TAU, 0);
    return fmi2SetReal(c, &vr, 1, &(double){1});
}

static fmi2Status call_get_real(fmi2Component c)
{
    unsigned vr = reference(GM_OUTPUT_W, 0);
    return fmi2GetReal(c, &vr, 1, &(double){1});
}

static fmi2Status call_step(fmi2Component c)
{
    return fmi2DoStep(c, 0, 0.001, fmi2True);
}

static fmi2Status call_input_rate(fmi2Component c)
{
    unsigned vr = reference(GM_OUTPUT_TAU, 0);
    return fmi2SetRealInputDerivatives(c, &vr, 1, &(int){1}, &(double){0});
}

static fmi2Status call_output_rate(fmi2Component c)
{
    unsigned vr = reference(GM_OUTPUT_W, 0);
    return fmi2GetRealOutputDerivatives(c, &vr, 1, &(int){1}, &(double){0});
}

static fmi2Status call_last_time(fmi2Component c)
{
    return fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &(double){0});
}

static const struct {
    const char *name;
    fmi2Status (*call)(fmi2Component c);
    const char *allowed; /* by place: + or - */
} calls[] = {
    {"fmi2EnterEventMode", fmi2EnterEventMode, "--+++--"},
    {"fmi2NewDiscreteStates", call_update, "--++---"},
    {"fmi2EnterContinuousTimeMode", fmi2EnterContinuousTimeMode, "---+---"},
    {"fmi2CompletedIntegratorStep", call_completed, "----+--"},
    {"fmi2SetTime", call_time, "--+++--"},
    {"fmi2SetContinuousStates", call_set_states, "----+--"},
    {"fmi2GetContinuousStates", call_get_states, "-++++++"},
    {"fmi2GetDerivatives", call_rates, "--+++++"},
    {"fmi2GetEventIndicators", call_indicators, "-++++++"},
    {"fmi2GetNominalsOfContinuousStates", call_nominals, "+-+++++"},
    {"fmi2SetReal", call_set_input, "+++++--"},
    {"fmi2GetReal", call_get_real, "-++++++"},
    {"fmi2Terminate", fmi2Terminate, "--+++--"},
    {"fmi2Reset", fmi2Reset, "+++++++"},
    {"fmi2DoStep", call_step, "-------"},
    {"fmi2SetRealInputDerivatives", call_input_rate, "-------"},
    {"fmi2GetRealOutputDerivatives", call_output_rate, "-------"},
    {"fmi2GetRealStatus", call_last_time, "-------"},
};

static void each_function_is_allowed_in_its_states_only(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        for (int where = 0; where < PLACES; where++) {
            host h;
            fmi2Component c = bring_to(&h, (place)where);
            fmi2Status status = calls[i].call(c);
            fmi2Status expected = calls[i].allowed[where] == '+' ? fmi2OK : fmi2Error;
            if (status != expected)
                fail_msg("%s in state %d: %d, %s", calls[i].name, where, status, h.text);
            if (status == fmi2Error)
                assert_non_null(strstr(h.text, calls[i].name));
            fmi2FreeInstance(c);
        }
    assert_int_equal(fixture_blocks(), 0);
}

static void exchange_is_refused_in_co_simulation(void **state)
{
    (void)state;
    for (int i = 0; i < 10; i++) {
        host h;
        fmi2Component c = host_start(&h);
        assert_refused(&h, calls[i].call(c), calls[i].name, NULL);
        fmi2FreeInstance(c);
    }
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        assert_int_equal(calls[i].call(NULL), fmi2Error);
}

static void arrays_of_another_size_are_refused(void **state)
{
    host h;
    double x[NX + 1] = {0};
    (void)state;
    fmi2Component c = bring_to(&h, CONTINUOUS);
    assert_refused(&h, fmi2GetDerivatives(c, x, NX + 1), "10", "11", NULL);
    fmi2FreeInstance(c);
    c = bring_to(&h, CONTINUOUS);
    assert_refused(&h, fmi2GetEventIndicators(c, NULL, NZ), "6", NULL);
    fmi2FreeInstance(c);
}

static void numbers_that_are_none_are_refused(void **state)
{
    host h;
    double x[NX] = {0};
    (void)state;
    fmi2Component c = bring_to(&h, CONTINUOUS);
    x[3] = (double)NAN;
    assert_refused(&h, fmi2SetContinuousStates(c, x, NX), "finite", NULL);
    assert_int_equal(fmi2GetContinuousStates(c, x, NX), fmi2OK);
    assert_true(x[3] == 0);
    fmi2FreeInstance(c);
}

static void states_that_overflow_are_discarded(void **state)
{
    host h;
    double x[NX] = {0}, z[NZ];
    (void)state;
    fmi2Component c = bring_to(&h, INITIALISING);
    set(c, GM_OUTPUT_W_START, 0, 10);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    assert_int_equal(call_update(c), fmi2OK);
    assert_int_equal(fmi2EnterContinuousTimeMode(c), fmi2OK);
    for (int i = 0; i < NX; i++)
        x[i] = 1e300;
    assert_int_equal(fmi2SetContinuousStates(c, x, NX), fmi2OK);
    assert_int_equal(fmi2GetDerivatives(c, x, NX), fmi2Discard);
    assert_string_equal(h.category, "logStatusDiscard");
    (void)fmi2GetEventIndicators(c, z, NZ);
    assert_int_equal(fmi2SetContinuousStates(c, (double[NX]){0}, NX), fmi2OK);
    assert_int_equal(fmi2GetDerivatives(c, x, NX), fmi2OK);
    fmi2FreeInstance(c);
}

static void a_change_in_event_mode_asks_for_an_update(void **state)
{
    host h;
    (void)state;
    fmi2Component c = bring_to(&h, UPDATED);
    set_integer(c, GM_PATH_GEAR, 0, 3);
    assert_refused(&h, fmi2EnterContinuousTimeMode(c), "fmi2NewDiscreteStates", NULL);
    fmi2FreeInstance(c);
}

static void parameters_are_not_set_between_events(void **state)
{
    host h;
    unsigned vr = reference(GM_LOSS_SCALE, 0);
    (void)state;
    fmi2Component c = bring_to(&h, CONTINUOUS);
    assert_refused(&h, fmi2SetReal(c, &vr, 1, &(double){2}), "loss_scale",
                   "between events", NULL);
    fmi2FreeInstance(c);
    c = bring_to(&h, UPDATED);
    set(c, GM_LOSS_SCALE, 0, 2);
    fmi2FreeInstance(c);
}

static void a_state_of_the_other_kind_is_refused(void **state)
{
    host h, other;
    fmi2FMUstate saved = NULL;
    (void)state;
    fmi2Component c = bring_to(&h, CONTINUOUS), slave = host_start(&other);
    assert_int_equal(fmi2GetFMUstate(c, &saved), fmi2OK);
    assert_refused(&other, fmi2SetFMUstate(slave, saved), "Model Exchange", NULL);
    assert_int_equal(fmi2SetFMUstate(c, saved), fmi2OK);
    assert_int_equal(fmi2FreeFMUstate(c, &saved), fmi2OK);
    fmi2FreeInstance(c);
    fmi2FreeInstance(slave);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_function_is_allowed_in_its_states_only),
        cmocka_unit_test(exchange_is_refused_in_co_simulation),
        cmocka_unit_test(arrays_of_another_size_are_refused),
        cmocka_unit_test(numbers_that_are_none_are_refused),
        cmocka_unit_test(states_that_overflow_are_discarded),
        cmocka_unit_test(a_change_in_event_mode_asks_for_an_update),
        cmocka_unit_test(parameters_are_not_set_between_events),
        cmocka_unit_test(a_state_of_the_other_kind_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
