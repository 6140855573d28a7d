/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random calls of Model Exchange, of two paths: 10 states, two less for each flange whose
 * motion is prescribed, and 6 event indicators.
 */
#include "random_calls.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { STATES = 10, INDICATORS = 6, ROOM = 12 };

static size_t n_states(void)
{
    size_t n = STATES;
    for (int k = 0; k <= GM_MAX_PATHS; k++)
        n -= gm_model_map()->prescribed[k] ? 2 : 0;
    return n;
}

static bool may(const random_run *r, int states)
{
    return r->oracle.exchange && random_is_in(r, states);
}

fmi2Status random_enter_event(random_run *r, bool *legal)
{
    *legal = may(r, EXCHANGE);
    fmi2Status status = fmi2EnterEventMode(random_handle(r, legal));
    if (*legal) {
        r->oracle.state = EVENT;
        r->oracle.update_due = true;
    }
    return status;
}

fmi2Status random_update(random_run *r, bool *legal)
{
    fmi2EventInfo info = {0};
    bool nowhere = random_chance(r, 50);
    *legal = may(r, EVENT) && !nowhere;
    fmi2Status status =
        fmi2NewDiscreteStates(random_handle(r, legal), nowhere ? NULL : &info);
    if (*legal && status <= fmi2Warning) {
        r->oracle.update_due = false;
        /* one update is enough for any event, and none is foreseen */
        assert_false(info.newDiscreteStatesNeeded);
        assert_false(info.nextEventTimeDefined || info.terminateSimulation);
    }
    return status;
}

/* Before the update of an event: the standard does not say that it is an error. */
fmi2Status random_enter_continuous(random_run *r, bool *legal)
{
    *legal = may(r, EVENT);
    r->open = *legal && r->oracle.update_due;
    fmi2Status status = fmi2EnterContinuousTimeMode(random_handle(r, legal));
    if (*legal && status <= fmi2Warning)
        r->oracle.state = CONTINUOUS;
    return status;
}

fmi2Status random_completed(random_run *r, bool *legal)
{
    fmi2Boolean enter = fmi2True, terminate = fmi2True;
    bool nowhere = random_chance(r, 50);
    *legal = may(r, CONTINUOUS) && !nowhere;
    return fmi2CompletedIntegratorStep(random_handle(r, legal), fmi2True,
                                       nowhere ? NULL : &enter, &terminate);
}

fmi2Status random_time(random_run *r, bool *legal)
{
    double time = r->oracle.time + fabs(random_number(r));
    *legal = may(r, EXCHANGE) && oracle_is_number(time);
    fmi2Status status = fmi2SetTime(random_handle(r, legal), time);
    if (*legal && status <= fmi2Warning)
        r->oracle.time = time;
    return status;
}

/* Mostly of the right length; *legal becomes false when it is not. */
static size_t length(random_run *r, size_t right, bool *legal)
{
    size_t n = random_chance(r, 30) ? random_draw(r, ROOM) : right;
    *legal = *legal && n == right;
    return n;
}

fmi2Status random_set_states(random_run *r, bool *legal)
{
    double x[ROOM];
    *legal = may(r, CONTINUOUS);
    size_t n = length(r, n_states(), legal);
    for (size_t i = 0; i < n; i++) {
        x[i] = random_chance(r, 20) ? random_number(r) : random_draw(r, 100) - 50.0;
        *legal = *legal && oracle_is_number(x[i]);
        random_note_size(r, x[i]);
    }
    return fmi2SetContinuousStates(random_handle(r, legal), x, n);
}

/* One of the functions that fill an array. */
static fmi2Status fill(random_run *r, bool *legal, int states, size_t right,
                       fmi2Status (*call)(fmi2Component c, fmi2Real x[], size_t n))
{
    double x[ROOM];
    *legal = may(r, states);
    size_t n = length(r, right, legal);
    fmi2Status status = call(random_handle(r, legal), x, n);
    if (status <= fmi2Warning)
        random_assert_numbers(r, x, n);
    return status;
}

enum { WHILE_OR_AFTER = EXCHANGE | TERMINATED | BROKEN };

fmi2Status random_get_states(random_run *r, bool *legal)
{
    return fill(r, legal, INITIALISATION | WHILE_OR_AFTER, n_states(),
                fmi2GetContinuousStates);
}

fmi2Status random_rates(random_run *r, bool *legal)
{
    return fill(r, legal, WHILE_OR_AFTER, n_states(), fmi2GetDerivatives);
}

fmi2Status random_indicators(random_run *r, bool *legal)
{
    return fill(r, legal, INITIALISATION | WHILE_OR_AFTER, INDICATORS,
                fmi2GetEventIndicators);
}

fmi2Status random_nominals(random_run *r, bool *legal)
{
    return fill(r, legal, INSTANTIATED | WHILE_OR_AFTER, n_states(),
                fmi2GetNominalsOfContinuousStates);
}
