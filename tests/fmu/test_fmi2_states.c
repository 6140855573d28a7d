/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Call order, instantiation and misuse against the state machine of FMI 2.0.3, 4.2.4.
 */
#include "fmi2_fixture.h"
#include "gm_saved.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* ---- every function in every state ---- */

typedef enum place {
    INSTANTIATED,
    INITIALISATION,
    STEP,
    FAILED,
    TERMINATED,
    BROKEN
} place;
enum { PLACES = BROKEN + 1 };

/* An instance in a given state. */
static fmi2Component bring_to(host *h, place where)
{
    if (where == INSTANTIATED)
        return host_instantiate(h);
    if (where == INITIALISATION)
        return host_initialise(h);
    fmi2Component c = host_start(h);
    if (where == FAILED) {
        set(c, GM_OUTPUT_TAU, 0, 100);
        assert_int_equal(fmi2DoStep(c, 0, 0.1, fmi2True), fmi2OK);
        set(c, GM_OUTPUT_TAU, 0, 1e308);
        assert_int_equal(fmi2DoStep(c, 0.1, 1e10, fmi2True), fmi2Discard);
    } else if (where == TERMINATED) {
        assert_int_equal(fmi2Terminate(c), fmi2OK);
    } else if (where == BROKEN) {
        assert_int_equal(fmi2DoStep(c, 0, -1, fmi2True), fmi2Error);
    }
    h->messages = 0;
    return c;
}

static const unsigned tau = GM_SLOTS * GM_OUTPUT_TAU, speed = GM_SLOTS * GM_OUTPUT_W,
                      angle = GM_SLOTS * GM_OUTPUT_PHI;

static fmi2Status call_setup(fmi2Component c)
{
    return fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0);
}

static fmi2Status call_enter(fmi2Component c)
{
    /* needs the start time, which only the states before know */
    (void)fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0);
    return fmi2EnterInitializationMode(c);
}

static fmi2Status call_set_real(fmi2Component c)
{
    return fmi2SetReal(c, &tau, 1, &(double){1});
}

static fmi2Status call_get_real(fmi2Component c)
{
    return fmi2GetReal(c, &speed, 1, &(double){0});
}

static fmi2Status call_get_nothing(fmi2Component c)
{
    return fmi2GetString(c, NULL, 0, NULL);
}

static fmi2Status call_input_rate(fmi2Component c)
{
    return fmi2SetRealInputDerivatives(c, &tau, 1, &(int){1}, &(double){0});
}

static fmi2Status call_output_rate(fmi2Component c)
{
    return fmi2GetRealOutputDerivatives(c, &angle, 1, &(int){1}, &(double){0});
}

static fmi2Status call_step(fmi2Component c)
{
    return fmi2DoStep(c, 0, 0.001, fmi2True);
}

static fmi2Status call_logging(fmi2Component c)
{
    return fmi2SetDebugLogging(c, fmi2True, 0, NULL);
}

static fmi2Status call_last_time(fmi2Component c)
{
    return fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &(double){0});
}

static fmi2Status call_get_state(fmi2Component c)
{
    fmi2FMUstate saved = NULL;
    fmi2Status status = fmi2GetFMUstate(c, &saved);
    (void)fmi2FreeFMUstate(c, &saved);
    return status;
}

static fmi2Status call_set_state(fmi2Component c)
{
    fmi2FMUstate saved = NULL;
    (void)fmi2GetFMUstate(c, &saved);
    fmi2Status status = fmi2SetFMUstate(c, saved);
    (void)fmi2FreeFMUstate(c, &saved);
    return status;
}

static fmi2Status call_free_state(fmi2Component c)
{
    fmi2FMUstate saved = NULL;
    (void)fmi2GetFMUstate(c, &saved);
    return fmi2FreeFMUstate(c, &saved);
}

static fmi2Status call_state_size(fmi2Component c)
{
    fmi2FMUstate saved = NULL;
    size_t size = 0;
    (void)fmi2GetFMUstate(c, &saved);
    fmi2Status status = fmi2SerializedFMUstateSize(c, saved, &size);
    (void)fmi2FreeFMUstate(c, &saved);
    return status;
}

static fmi2Status call_serialise(fmi2Component c)
{
    fmi2FMUstate saved = NULL;
    char bytes[sizeof(gm_saved)];
    (void)fmi2GetFMUstate(c, &saved);
    fmi2Status status = fmi2SerializeFMUstate(c, saved, bytes, sizeof bytes);
    (void)fmi2FreeFMUstate(c, &saved);
    return status;
}

static fmi2Status call_deserialise(fmi2Component c)
{
    fmi2FMUstate saved = NULL, again = NULL;
    char bytes[sizeof(gm_saved)] = {0};
    (void)fmi2GetFMUstate(c, &saved);
    (void)fmi2SerializeFMUstate(c, saved, bytes, sizeof bytes);
    fmi2Status status = fmi2DeSerializeFMUstate(c, bytes, sizeof bytes, &again);
    (void)fmi2FreeFMUstate(c, &saved);
    (void)fmi2FreeFMUstate(c, &again);
    return status;
}

static const struct {
    const char *name;
    fmi2Status (*call)(fmi2Component c);
    const char *allowed; /* by place: + or - */
} calls[] = {
    {"fmi2SetupExperiment", call_setup, "+-----"},
    {"fmi2EnterInitializationMode", call_enter, "+-----"},
    {"fmi2ExitInitializationMode", fmi2ExitInitializationMode, "-+----"},
    {"fmi2SetReal", call_set_real, "+++---"},
    {"fmi2GetReal", call_get_real, "-+++++"},
    {"fmi2GetString", call_get_nothing, "-+++++"},
    {"fmi2SetRealInputDerivatives", call_input_rate, "+++---"},
    {"fmi2GetRealOutputDerivatives", call_output_rate, "--++++"},
    {"fmi2DoStep", call_step, "--+---"},
    {"fmi2GetRealStatus", call_last_time, "--+++-"},
    {"fmi2Terminate", fmi2Terminate, "--++--"},
    {"fmi2SetDebugLogging", call_logging, "++++++"},
    {"fmi2Reset", fmi2Reset, "++++++"},
    {"fmi2CancelStep", fmi2CancelStep, "------"},
    {"fmi2GetFMUstate", call_get_state, "++++++"},
    {"fmi2SetFMUstate", call_set_state, "++++++"},
    {"fmi2FreeFMUstate", call_free_state, "++++++"},
    {"fmi2SerializedFMUstateSize", call_state_size, "++++++"},
    {"fmi2SerializeFMUstate", call_serialise, "++++++"},
    {"fmi2DeSerializeFMUstate", call_deserialise, "++++++"},
};

static void each_function_is_allowed_in_its_states_only(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        for (int where = 0; where < PLACES; where++) {
            host h;
            fmi2Component c = bring_to(&h, (place)where);
            fmi2Status status = calls[i].call(c);
            if (calls[i].allowed[where] == '+' && status != fmi2OK)
                fail_msg("%s in state %d: %d, %s", calls[i].name, where, status, h.text);
            if (calls[i].allowed[where] == '-') {
                if (status != fmi2Error || !strstr(h.text, "not allowed"))
                    fail_msg("%s in state %d: %d, %s", calls[i].name, where, status,
                             h.text);
                assert_string_equal(h.category, "logStatusError");
                assert_non_null(strstr(h.text, calls[i].name));
            }
            fmi2FreeInstance(c);
        }
    assert_int_equal(fixture_blocks(), 0);
}

static void calls_without_an_instance_fail(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        assert_int_equal(calls[i].call(NULL), fmi2Error);
    fmi2FreeInstance(NULL);
}

static void initialisation_needs_a_start_time(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_instantiate(&h);
    assert_refused(&h, fmi2EnterInitializationMode(c), "fmi2SetupExperiment", NULL);
    fmi2FreeInstance(c);
}

static void an_instance_is_usable_again_after_reset(void **state)
{
    host h;
    (void)state;
    fmi2Component c = bring_to(&h, BROKEN);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_int_equal(call_enter(c), fmi2OK);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    assert_int_equal(call_step(c), fmi2OK);
    fmi2FreeInstance(c);
}

/* ---- instantiation ---- */

static fmi2Component instantiate(host *h, const char *name, fmi2Type type,
                                 const char *guid)
{
    host_init(h);
    return fmi2Instantiate(name, type, guid, "", &h->callbacks, fmi2False, fmi2False);
}

static void instantiation_refuses_what_it_cannot_be(void **state)
{
    host h;
    const char *guid = gm_model_guid();
    (void)state;
    assert_null(instantiate(&h, "g", fmi2CoSimulation, "{another}"));
    assert_refused(&h, fmi2Error, "GUID", NULL);
    assert_null(instantiate(&h, "g", fmi2CoSimulation, NULL));
    assert_refused(&h, fmi2Error, "GUID", NULL);
    assert_null(instantiate(&h, "g", (fmi2Type)7, guid));
    assert_refused(&h, fmi2Error, "neither", NULL);
    assert_null(instantiate(&h, "", fmi2CoSimulation, guid));
    assert_refused(&h, fmi2Error, "name", NULL);
    assert_null(instantiate(&h, NULL, fmi2CoSimulation, guid));
    assert_refused(&h, fmi2Error, "name", NULL);
    assert_null(fmi2Instantiate("g", fmi2CoSimulation, guid, "", NULL, 0, 0));
    fixture_fail_allocation();
    assert_null(instantiate(&h, "g", fmi2CoSimulation, guid));
    assert_refused(&h, fmi2Error, "memory", NULL);
}

static void an_instance_is_one_block_of_the_host(void **state)
{
    host h;
    (void)state;
    int before = fixture_allocations();
    fmi2Component c = host_start(&h);
    for (int i = 0; i < 100; i++)
        assert_int_equal(fmi2DoStep(c, i, 1, fmi2True), fmi2OK);
    assert_int_equal(fixture_allocations() - before, 1);
    fmi2FreeInstance(c);
    assert_int_equal(fixture_blocks(), 0);
}

static void callbacks_may_be_missing(void **state)
{
    const fmi2CallbackFunctions none = {0};
    (void)state;
    fmi2Component c =
        fmi2Instantiate("g", fmi2CoSimulation, gm_model_guid(), NULL, &none, 0, 1);
    assert_non_null(c);
    assert_int_equal(fmi2DoStep(c, 0, 1, fmi2True), fmi2Error); /* nowhere to report */
    fmi2FreeInstance(c);
}

static void versions_are_those_of_the_headers(void **state)
{
    (void)state;
    assert_string_equal(fmi2GetVersion(), "2.0");
    assert_string_equal(fmi2GetTypesPlatform(), "default");
}

/* ---- times ---- */

static void experiments_need_finite_ordered_times(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_instantiate(&h);
    assert_refused(&h, fmi2SetupExperiment(c, 0, 0, (double)NAN, 0, 0), "start time",
                   NULL);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    assert_refused(&h, fmi2SetupExperiment(c, 0, 0, 5, 1, 4), "stop time 4", NULL);
    fmi2FreeInstance(c);
}

static void step_sizes_are_positive_and_finite(void **state)
{
    const double wrong[] = {0, -0.001, (double)NAN, (double)INFINITY};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        host h;
        fmi2Component c = host_start(&h);
        assert_refused(&h, fmi2DoStep(c, 0, wrong[i], fmi2True), "positive", NULL);
        fmi2FreeInstance(c);
    }
}

static void steps_follow_each_other(void **state)
{
    const double wrong[] = {0.0, 0.0009, 0.0011, 1.0, (double)NAN, (double)-INFINITY};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        host h;
        fmi2Component c = host_start(&h);
        assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2OK);
        assert_refused(&h, fmi2DoStep(c, wrong[i], 0.001, fmi2True), "0.001", NULL);
        fmi2FreeInstance(c);
    }
}

/* 10^5 steps in three ways of keeping time, from a start time that no step divides. */
static void rounding_of_time_never_rejects_a_step(void **state)
{
    const double start = 1234.5678, h = 1e-4 / 3.0;
    (void)state;
    for (int way = 0; way < 3; way++) {
        host messages;
        double t = start;
        fmi2Component c = host_instantiate(&messages);
        assert_int_equal(fmi2SetupExperiment(c, 0, 0, start, 1, start + 1e5 * h), fmi2OK);
        assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
        assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
        for (int i = 0; i < 100000; i++) {
            double next = start + (i + 1) * h;
            double step = way == 2 ? next - t : h;
            if (fmi2DoStep(c, t, step, fmi2False) != fmi2OK)
                fail_msg("way %d, step %d: %s", way, i, messages.text);
            t = way == 1 ? t + h : next;
        }
        fmi2FreeInstance(c);
    }
}

static void steps_beyond_the_stop_time_are_refused(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_instantiate(&h);
    assert_int_equal(fmi2SetupExperiment(c, 0, 0, 0, fmi2True, 0.3), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    for (int i = 0; i < 3; i++) /* 0.1 + 0.1 + 0.1 > 0.3 in binary */
        assert_int_equal(fmi2DoStep(c, i * 0.1, 0.1, fmi2True), fmi2OK);
    assert_refused(&h, fmi2DoStep(c, 0.3, 0.1, fmi2True), "stop time", "0.3", NULL);
    fmi2FreeInstance(c);
}

/* ---- discard, status, capabilities that are not claimed ---- */

static void an_overflowing_step_is_discarded_and_leaves_the_state(void **state)
{
    host h;
    double last = -1;
    (void)state;
    fmi2Component c = host_start(&h);
    set(c, GM_OUTPUT_TAU, 0, 100);
    assert_int_equal(fmi2DoStep(c, 0, 0.5, fmi2True), fmi2OK);
    double w = get(c, GM_OUTPUT_W, 0);
    set(c, GM_OUTPUT_TAU, 0, 1e308);
    assert_int_equal(fmi2DoStep(c, 0.5, 1e9, fmi2True), fmi2Discard);
    assert_string_equal(h.category, "logStatusDiscard");
    assert_true(get(c, GM_OUTPUT_W, 0) == w);
    assert_int_equal(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &last), fmi2OK);
    assert_true(last == 0.5);
    fmi2FreeInstance(c);
}

static void status_questions_have_their_answers(void **state)
{
    host h;
    fmi2Status status;
    double real;
    int integer;
    const char *text;
    (void)state;
    fmi2Component c = host_start(&h);
    assert_int_equal(fmi2GetBooleanStatus(c, fmi2Terminated, &integer), fmi2OK);
    assert_int_equal(integer, fmi2False);
    assert_int_equal(fmi2GetStatus(c, fmi2DoStepStatus, &status), fmi2Discard);
    assert_int_equal(fmi2GetRealStatus(c, fmi2DoStepStatus, &real), fmi2Discard);
    assert_int_equal(fmi2GetIntegerStatus(c, fmi2DoStepStatus, &integer), fmi2Discard);
    assert_int_equal(fmi2GetBooleanStatus(c, fmi2DoStepStatus, &integer), fmi2Discard);
    assert_int_equal(fmi2GetStringStatus(c, fmi2PendingStatus, &text), fmi2Discard);
    assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2OK); /* still alive */
    fmi2FreeInstance(c);
}

static void directional_derivatives_need_their_arrays(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_start(&h);
    assert_int_equal(fmi2GetDirectionalDerivative(c, NULL, 0, NULL, 0, NULL, NULL),
                     fmi2OK);
    assert_refused(&h, fmi2GetDirectionalDerivative(c, &tau, 1, NULL, 0, NULL, NULL),
                   "array", NULL);
    fmi2FreeInstance(c);
}

/* ---- logging ---- */

static void shifts_are_logged_on_demand(void **state)
{
    host h;
    const char *events[] = {"logEvents"}, *unknown[] = {"logNothing"};
    (void)state;
    fmi2Component c = host_start(&h);
    set_integer(c, GM_PATH_GEAR, 0, 1);
    assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2OK);
    assert_int_equal(h.messages, 0);
    assert_int_equal(fmi2SetDebugLogging(c, fmi2True, 1, events), fmi2OK);
    set_integer(c, GM_PATH_GEAR, 0, 0);
    assert_int_equal(fmi2DoStep(c, 0.001, 0.001, fmi2True), fmi2OK);
    assert_int_equal(h.messages, 1);
    assert_string_equal(h.category, "logEvents");
    assert_non_null(strstr(h.text, "neutral"));
    assert_string_equal(h.instance, "gearset");
    assert_int_equal(fmi2SetDebugLogging(c, fmi2False, 0, NULL), fmi2OK);
    set_integer(c, GM_PATH_GEAR, 0, 3);
    assert_int_equal(fmi2DoStep(c, 0.002, 0.001, fmi2True), fmi2OK);
    assert_int_equal(h.messages, 1);
    assert_int_equal(fmi2SetDebugLogging(c, fmi2True, 1, unknown), fmi2Warning);
    assert_string_equal(h.category, "logStatusWarning");
    fmi2FreeInstance(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_function_is_allowed_in_its_states_only),
        cmocka_unit_test(calls_without_an_instance_fail),
        cmocka_unit_test(initialisation_needs_a_start_time),
        cmocka_unit_test(an_instance_is_usable_again_after_reset),
        cmocka_unit_test(instantiation_refuses_what_it_cannot_be),
        cmocka_unit_test(an_instance_is_one_block_of_the_host),
        cmocka_unit_test(callbacks_may_be_missing),
        cmocka_unit_test(versions_are_those_of_the_headers),
        cmocka_unit_test(experiments_need_finite_ordered_times),
        cmocka_unit_test(step_sizes_are_positive_and_finite),
        cmocka_unit_test(steps_follow_each_other),
        cmocka_unit_test(rounding_of_time_never_rejects_a_step),
        cmocka_unit_test(steps_beyond_the_stop_time_are_refused),
        cmocka_unit_test(an_overflowing_step_is_discarded_and_leaves_the_state),
        cmocka_unit_test(status_questions_have_their_answers),
        cmocka_unit_test(directional_derivatives_need_their_arrays),
        cmocka_unit_test(shifts_are_logged_on_demand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
