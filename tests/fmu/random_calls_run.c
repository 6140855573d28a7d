/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random sequences of legal and illegal calls with random, huge, infinite and NaN
 * arguments. Each answer is compared with what the standard allows (call_oracle.h):
 *   - an illegal call is answered fmi2Error, with a message;
 *   - a legal one is not, unless numbers were given that make results overflow;
 *   - what comes with fmi2OK or fmi2Warning is neither NaN nor infinite;
 *   - in the end all memory is given back.
 * That nothing crashes or is undefined is for the sanitizers to see.
 */
#include "random_calls.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { CALLS = 30 }; /* of a sequence */

/* weight: how often, relative to the others; states: where mostly. */
static const struct {
    const char *name;
    fmi2Status (*call)(random_run *r, bool *legal);
    unsigned weight;
    int states;
} calls[] = {
    {"fmi2SetupExperiment", random_setup, 6, INSTANTIATED},
    {"fmi2EnterInitializationMode", random_enter, 6, INSTANTIATED},
    {"fmi2ExitInitializationMode", random_exit, 6, INITIALISATION},
    {"fmi2Terminate", random_terminate, 1, STEP_COMPLETE | STEP_FAILED | EXCHANGE},
    {"fmi2Reset", random_reset, 1, STEP_FAILED | TERMINATED | BROKEN},
    {"fmi2DoStep", random_step, 24, STEP_COMPLETE},
    {"fmi2SetReal", random_set_real, 12, TO_SET},
    {"fmi2SetInteger, fmi2SetBoolean", random_set_integer, 8, TO_SET},
    {"fmi2GetReal", random_get_real, 12, TO_GET},
    {"fmi2GetInteger, fmi2GetBoolean", random_get_integer, 4, TO_GET},
    {"fmi2SetString, fmi2GetString", random_strings, 1, TO_GET},
    {"fmi2SetRealInputDerivatives", random_input_rates, 4, TO_SET},
    {"fmi2GetRealOutputDerivatives", random_output_rates, 4, TO_GET & ~INITIALISATION},
    {"fmi2SetDebugLogging", random_logging, 1, ANYWHERE},
    {"fmi2GetStatus and others", random_status, 2,
     STEP_COMPLETE | STEP_FAILED | TERMINATED},
    {"fmi2CancelStep", random_cancel, 1, STEP_COMPLETE},
    {"fmi2GetDirectionalDerivative", random_derivative, 6, TO_GET},
    {"fmi2EnterEventMode", random_enter_event, 4, CONTINUOUS},
    {"fmi2NewDiscreteStates", random_update, 8, EVENT},
    {"fmi2EnterContinuousTimeMode", random_enter_continuous, 8, EVENT},
    {"fmi2CompletedIntegratorStep", random_completed, 4, CONTINUOUS},
    {"fmi2SetTime", random_time, 4, EXCHANGE},
    {"fmi2SetContinuousStates", random_set_states, 8, CONTINUOUS},
    {"fmi2GetContinuousStates", random_get_states, 3, EXCHANGE},
    {"fmi2GetDerivatives", random_rates, 8, EXCHANGE},
    {"fmi2GetEventIndicators", random_indicators, 5, EXCHANGE},
    {"fmi2GetNominalsOfContinuousStates", random_nominals, 1, EXCHANGE},
    {"fmi2GetFMUstate", random_keep, 4, ANYWHERE},
    {"fmi2SetFMUstate", random_restore, 6, ANYWHERE},
    {"fmi2FreeFMUstate", random_forget, 1, ANYWHERE},
    {"fmi2DeSerializeFMUstate", random_bytes, 2, ANYWHERE},
};
enum { KINDS = sizeof calls / sizeof *calls };

static int choose_any(random_run *r)
{
    unsigned total = 0, at;
    int i = 0;
    for (int k = 0; k < KINDS; k++)
        total += calls[k].weight;
    for (at = random_draw(r, total); at >= calls[i].weight; i++)
        at -= calls[i].weight;
    return i;
}

/* One call in 25 at most is out of place. */
static int choose(random_run *r)
{
    int k = choose_any(r);
    while (!(calls[k].states & r->oracle.state) && !random_chance(r, 25))
        k = choose_any(r);
    return k;
}

/* Answers by kind of call and whether it was legal. */
static long answers[KINDS][2];

static void check(random_run *r, int k, bool legal, fmi2Status status, int messages)
{
    const char *name = calls[k].name;
    answers[k][legal]++;
    if (!legal && !r->open && status != fmi2Error)
        fail_msg("%s: illegal in state %d, answered %d", name, r->oracle.state, status);
    if (status == fmi2Error && r->reached && r->host.messages == messages)
        fail_msg("%s: refused without a message", name);
    if (legal && !r->open && status >= fmi2Error && !r->oracle.huge)
        fail_msg("%s: legal in state %d: %s", name, r->oracle.state, r->host.text);
    if (status == fmi2Error && r->reached)
        r->oracle.state = BROKEN;
}

/* Most sequences begin with what a simulator would do. */
static void begin(random_run *r)
{
    unsigned far = random_draw(r, 4);
    fmi2EventInfo info;
    r->oracle.exchange = random_chance(r, 2);
    r->c = host_instantiate_as(&r->host,
                               r->oracle.exchange ? fmi2ModelExchange : fmi2CoSimulation);
    r->oracle.state = INSTANTIATED;
    if (far == 0)
        return;
    assert_int_equal(fmi2SetupExperiment(r->c, 0, 0, 0, 0, 0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(r->c), fmi2OK);
    r->oracle.state = INITIALISATION;
    r->oracle.experiment_set = true;
    if (far == 1)
        return;
    assert_int_equal(fmi2ExitInitializationMode(r->c), fmi2OK);
    r->oracle.state = r->oracle.exchange ? EVENT : STEP_COMPLETE;
    r->oracle.update_due = true;
    if (!r->oracle.exchange || far == 2)
        return;
    assert_int_equal(fmi2NewDiscreteStates(r->c, &info), fmi2OK);
    assert_int_equal(fmi2EnterContinuousTimeMode(r->c), fmi2OK);
    r->oracle.state = CONTINUOUS;
    r->oracle.update_due = false;
}

static void one_sequence(uint64_t seed)
{
    random_run r = {.random = seed};
    begin(&r);
    for (int i = 0; i < CALLS; i++) {
        bool legal = false;
        int k = choose(&r), messages = r.host.messages;
        r.open = false;
        fmi2Status status = calls[k].call(&r, &legal);
        check(&r, k, legal, status, messages);
    }
    assert_int_equal(fmi2FreeFMUstate(r.c, &r.saved), fmi2OK);
    fmi2FreeInstance(r.c);
    assert_int_equal(fixture_blocks(), 0);
}

static long sequences = 20000;

static void every_answer_is_what_the_standard_allows(void **state)
{
    (void)state;
    for (long i = 0; i < sequences; i++)
        one_sequence((uint64_t)i * 0x9e3779b97f4a7c15u + 1);
}

/* The sequences are worth their name: no kind of call was only refused, or never. */
static void calls_of_all_kinds_were_made(void **state)
{
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        if (answers[k][0] < sequences / 1000)
            fail_msg("%s: %ld", calls[k].name, answers[k][0]);
        if (calls[k].call != random_cancel)
            if (answers[k][1] < sequences / 100)
                fail_msg("%s: %ld", calls[k].name, answers[k][1]);
    }
}

int random_main(int argc, char **argv)
{
    if (argc > 1)
        sequences = atol(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_answer_is_what_the_standard_allows),
        cmocka_unit_test(calls_of_all_kinds_were_made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
