/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Chance, and calls that steer the life of an instance and its steps.
 */
#include "random_calls.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- chance: the generator of Knuth's MMIX ---- */

unsigned random_draw(random_run *r, unsigned n)
{
    r->random = r->random * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(r->random >> 33) % n;
}

bool random_chance(random_run *r, unsigned one_in)
{
    return random_draw(r, one_in) == 0;
}

double random_number(random_run *r)
{
    static const double odd[] = {0.0,    -0.0,  1e-320, 1e30,     -1e107,    1e200,
                                 -1e300, 1e308, 1.0,    HUGE_VAL, -HUGE_VAL, (double)NAN};
    if (random_chance(r, 12))
        return odd[random_draw(r, sizeof odd / sizeof *odd)];
    double size = random_chance(r, 3) ? 400.0 : 5.0;
    return size * (random_draw(r, 20001) / 10000.0 - 1.0);
}

unsigned random_reference(random_run *r)
{
    return random_chance(r, 40) ? random_draw(r, 100000)
                                : random_draw(r, GM_SLOTS * GM_VARIABLES + 2);
}

/* Mostly one that makes the call worth while. */
unsigned random_useful_reference(random_run *r, gm_type type, bool to_set)
{
    unsigned vr = random_reference(r);
    for (int i = 0; i < 200 && !random_chance(r, 60); i++) {
        const gm_variable *v = oracle_variable(vr);
        if (v && oracle_may_get(vr, type) &&
            (!to_set || v->causality != GM_CAUSALITY_OUTPUT))
            break;
        vr = random_reference(r);
    }
    return vr;
}

fmi2Component random_handle(random_run *r, bool *legal)
{
    r->reached = !random_chance(r, 200);
    *legal = *legal && r->reached;
    return r->reached ? r->c : NULL;
}

bool random_is_in(const random_run *r, int states)
{
    return (r->oracle.state & states) != 0;
}

void random_note_size(random_run *r, double x)
{
    bool tiny = fabs(x) > 0 && fabs(x) < 1e-100; /* its inverse is huge */
    r->oracle.huge = r->oracle.huge || fabs(x) > 1e9 || tiny;
}

fmi2Status random_setup(random_run *r, bool *legal)
{
    static const double starts[] = {0.0, 5.0, -3.0, 1e5, (double)NAN, HUGE_VAL};
    bool stop = random_chance(r, 3);
    double from = starts[random_chance(r, 4) ? random_draw(r, 6) : 0];
    double until = random_chance(r, 8) ? random_number(r) : from + random_draw(r, 10);
    *legal = random_is_in(r, INSTANTIATED) && oracle_is_number(from) &&
             (!stop || until >= from);
    fmi2Component c = random_handle(r, legal);
    fmi2Status status =
        fmi2SetupExperiment(c, fmi2False, random_number(r), from, stop, until);
    if (*legal) {
        r->oracle.experiment_set = true;
        r->oracle.time = from;
        r->oracle.stop_defined = stop;
        r->oracle.stop = until;
    }
    return status;
}

fmi2Status random_enter(random_run *r, bool *legal)
{
    *legal = random_is_in(r, INSTANTIATED) && r->oracle.experiment_set;
    fmi2Status status = fmi2EnterInitializationMode(random_handle(r, legal));
    if (*legal)
        r->oracle.state = INITIALISATION;
    return status;
}

fmi2Status random_exit(random_run *r, bool *legal)
{
    *legal = random_is_in(r, INITIALISATION);
    fmi2Status status = fmi2ExitInitializationMode(random_handle(r, legal));
    if (*legal && status <= fmi2Warning)
        r->oracle.state = r->oracle.exchange ? EVENT : STEP_COMPLETE;
    r->oracle.update_due = true;
    return status;
}

fmi2Status random_terminate(random_run *r, bool *legal)
{
    *legal = random_is_in(r, STEP_COMPLETE | STEP_FAILED | EXCHANGE);
    fmi2Status status = fmi2Terminate(random_handle(r, legal));
    if (*legal)
        r->oracle.state = TERMINATED;
    return status;
}

fmi2Status random_reset(random_run *r, bool *legal)
{
    *legal = true;
    fmi2Status status = fmi2Reset(random_handle(r, legal));
    if (*legal)
        r->oracle = (oracle){.state = INSTANTIATED, .exchange = r->oracle.exchange};
    return status;
}

fmi2Status random_step(random_run *r, bool *legal)
{
    static const double sizes[] = {1e-6,  1e-3,        0.01,     0.1,  0.0,
                                   -1e-3, (double)NAN, HUGE_VAL, 1e200};
    const oracle *o = &r->oracle;
    double h = sizes[random_draw(r, random_chance(r, 10) ? 9 : 4)];
    double t = random_chance(r, 30) ? random_number(r) : o->time;
    if (oracle_is_number(t))
        t = fabs(t - o->time) > 0 ? o->time + 1e3 + t : t; /* no rounding questions */
    bool in_time = fabs(t - o->time) <= 0;
    if (o->stop_defined && h > 0 && fabs(t + h - o->stop) < 0.1 * h)
        h *= 0.5;
    *legal = random_is_in(r, STEP_COMPLETE) && h > 0 && oracle_is_number(h) && in_time &&
             !(o->stop_defined && t + h > o->stop);
    fmi2Component c = random_handle(r, legal);
    random_note_size(r, h);
    fmi2Status status = fmi2DoStep(c, t, h, fmi2True);
    if (*legal && status <= fmi2Warning)
        r->oracle.time = t + h;
    if (*legal && status == fmi2Discard) {
        assert_true(r->oracle.huge);
        r->oracle.state = STEP_FAILED;
    }
    return status;
}

fmi2Status random_logging(random_run *r, bool *legal)
{
    static const fmi2String names[] = {"logAll", "logEvents", "nonsense", NULL,
                                       "logStatusError"};
    size_t n = random_draw(r, 5);
    bool missing = n > 0 && random_chance(r, 20);
    *legal = !missing;
    return fmi2SetDebugLogging(random_handle(r, legal), (fmi2Boolean)random_draw(r, 2), n,
                               missing ? NULL : names);
}

fmi2Status random_status(random_run *r, bool *legal)
{
    fmi2StatusKind kind = (fmi2StatusKind)random_draw(r, 5);
    double time = (double)NAN;
    fmi2Boolean yes = 7;
    fmi2String text = NULL;
    *legal =
        !r->oracle.exchange && random_is_in(r, STEP_COMPLETE | STEP_FAILED | TERMINATED);
    fmi2Component c = random_handle(r, legal);
    fmi2Status value, status;
    switch (random_draw(r, 5)) {
    case 0:
        status = fmi2GetRealStatus(c, kind, &time);
        if (status == fmi2OK)
            assert_true(time == r->oracle.time);
        return status;
    case 1:
        status = fmi2GetBooleanStatus(c, kind, &yes);
        if (status == fmi2OK)
            assert_int_equal(yes, fmi2False);
        return status;
    case 2:
        return fmi2GetIntegerStatus(c, kind, &yes);
    case 3:
        return fmi2GetStringStatus(c, kind, &text);
    default:
        return fmi2GetStatus(c, kind, &value);
    }
}

fmi2Status random_cancel(random_run *r, bool *legal)
{
    *legal = false; /* no step is ever in progress */
    return fmi2CancelStep(random_handle(r, legal));
}

void random_assert_numbers(const random_run *r, const double *value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!oracle_is_number(value[i]))
            fail_msg("number %u of %u is %g in state %d", (unsigned)i, (unsigned)n,
                     value[i], r->oracle.state);
}
