/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random calls that set and get values.
 */
#include "random_calls.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_VALUES = 4 };

static void assert_number(const random_run *r, unsigned vr, double value)
{
    if (!oracle_is_number(value))
        fail_msg("value reference %u is %g in state %d", vr, value, r->oracle.state);
}

/* While a solver moves the states only continuous inputs may change; that others are
 * taken too, for the next event, is kind to simulators that set all inputs at once. */
static void mark_change(random_run *r, const gm_variable *v)
{
    r->oracle.update_due = true;
    if (r->oracle.state == CONTINUOUS && v &&
        (v->causality != GM_CAUSALITY_INPUT ||
         v->variability != GM_VARIABILITY_CONTINUOUS))
        r->open = true;
}

/* References and numbers for a call that sets; *legal becomes false at the first that
 * may not be. Returns their number. */
static unsigned fill_to_set(random_run *r, gm_type type, unsigned vr[MOST_VALUES],
                            double x[MOST_VALUES], bool *legal)
{
    unsigned n = random_draw(r, MOST_VALUES + 1);
    for (unsigned i = 0; i < n; i++) {
        vr[i] = random_useful_reference(r, type, true);
        x[i] = type == GM_TYPE_REAL ? random_number(r)
                                    : (double)((int)random_draw(r, 12) - 3);
        *legal = *legal && oracle_may_set(&r->oracle, vr[i], type, x[i]);
        mark_change(r, oracle_variable(vr[i]));
    }
    if (type == GM_TYPE_REAL)
        for (unsigned i = 0; i < n; i++)
            random_note_size(r, x[i]);
    return n;
}

fmi2Status random_set_real(random_run *r, bool *legal)
{
    unsigned vr[MOST_VALUES];
    double x[MOST_VALUES];
    *legal = random_is_in(r, TO_SET);
    unsigned n = fill_to_set(r, GM_TYPE_REAL, vr, x, legal);
    bool missing = n > 0 && random_chance(r, 100);
    *legal = *legal && !missing;
    return fmi2SetReal(random_handle(r, legal), vr, n, missing ? NULL : x);
}

fmi2Status random_set_integer(random_run *r, bool *legal)
{
    unsigned vr[MOST_VALUES];
    double x[MOST_VALUES];
    int value[MOST_VALUES] = {0};
    bool boolean = random_chance(r, 8);
    *legal = random_is_in(r, TO_SET);
    unsigned n =
        fill_to_set(r, boolean ? GM_TYPE_BOOLEAN : GM_TYPE_INTEGER, vr, x, legal);
    for (unsigned i = 0; i < n; i++)
        value[i] = (int)x[i];
    fmi2Component c = random_handle(r, legal);
    return boolean ? fmi2SetBoolean(c, vr, n, value) : fmi2SetInteger(c, vr, n, value);
}

fmi2Status random_get_real(random_run *r, bool *legal)
{
    unsigned vr[MOST_VALUES], n = random_draw(r, MOST_VALUES + 1);
    double value[MOST_VALUES];
    *legal = random_is_in(r, TO_GET);
    for (unsigned i = 0; i < n; i++) {
        vr[i] = random_useful_reference(r, GM_TYPE_REAL, false);
        value[i] = (double)NAN;
        *legal = *legal && oracle_may_get(vr[i], GM_TYPE_REAL);
    }
    fmi2Status status = fmi2GetReal(random_handle(r, legal), vr, n, value);
    for (unsigned i = 0; i < n && status <= fmi2Warning; i++)
        assert_number(r, vr[i], value[i]);
    return status;
}

fmi2Status random_get_integer(random_run *r, bool *legal)
{
    unsigned vr[MOST_VALUES], n = random_draw(r, MOST_VALUES + 1);
    int value[MOST_VALUES];
    gm_type type = random_chance(r, 3) ? GM_TYPE_BOOLEAN : GM_TYPE_INTEGER;
    *legal = random_is_in(r, TO_GET);
    for (unsigned i = 0; i < n; i++) {
        vr[i] = random_useful_reference(r, type, false);
        *legal = *legal && oracle_may_get(vr[i], type);
    }
    fmi2Component c = random_handle(r, legal);
    return type == GM_TYPE_BOOLEAN ? fmi2GetBoolean(c, vr, n, value)
                                   : fmi2GetInteger(c, vr, n, value);
}

fmi2Status random_strings(random_run *r, bool *legal)
{
    unsigned vr = random_reference(r), n = random_draw(r, 2);
    fmi2String text = "text";
    bool set = random_chance(r, 2);
    *legal = random_is_in(r, set ? TO_SET : TO_GET) && n == 0;
    fmi2Component c = random_handle(r, legal);
    return set ? fmi2SetString(c, &vr, n, &text) : fmi2GetString(c, &vr, n, &text);
}

fmi2Status random_input_rates(random_run *r, bool *legal)
{
    unsigned vr = random_useful_reference(r, GM_TYPE_REAL, true);
    int order = random_chance(r, 10) ? (int)random_draw(r, 4) - 1 : 1;
    double rate = random_number(r);
    const gm_variable *v = oracle_variable(vr);
    *legal = !r->oracle.exchange && random_is_in(r, TO_SET) &&
             oracle_may_get(vr, GM_TYPE_REAL) && order == 1 &&
             v->causality == GM_CAUSALITY_INPUT && oracle_is_number(rate);
    random_note_size(r, rate);
    return fmi2SetRealInputDerivatives(random_handle(r, legal), &vr, 1, &order, &rate);
}

fmi2Status random_output_rates(random_run *r, bool *legal)
{
    unsigned vr = random_useful_reference(r, GM_TYPE_REAL, false);
    int order = random_chance(r, 10) ? (int)random_draw(r, 4) - 1 : 1;
    double rate = (double)NAN;
    const gm_variable *v = oracle_variable(vr);
    *legal = !r->oracle.exchange && random_is_in(r, TO_GET & ~INITIALISATION) &&
             oracle_may_get(vr, GM_TYPE_REAL) && v->causality == GM_CAUSALITY_OUTPUT;
    fmi2Status status =
        fmi2GetRealOutputDerivatives(random_handle(r, legal), &vr, 1, &order, &rate);
    if (status <= fmi2Warning)
        assert_number(r, vr, rate);
    return status;
}

/* Known in any state: continuous inputs; unknown: outputs. Whether more may be given
 * (states, start values) depends on the state: an open question here. */
fmi2Status random_derivative(random_run *r, bool *legal)
{
    unsigned of[MOST_VALUES], to[MOST_VALUES], n = random_draw(r, MOST_VALUES + 1),
                                               m = random_draw(r, MOST_VALUES + 1);
    double seed[MOST_VALUES], value[MOST_VALUES];
    *legal = random_is_in(r, TO_GET);
    for (unsigned i = 0; i < n; i++) {
        of[i] = random_useful_reference(r, GM_TYPE_REAL, false);
        value[i] = 0;
        const gm_variable *v = oracle_variable(of[i]);
        *legal = *legal && oracle_may_get(of[i], GM_TYPE_REAL) &&
                 v->causality == GM_CAUSALITY_OUTPUT;
    }
    for (unsigned i = 0; i < m; i++) {
        to[i] = random_useful_reference(r, GM_TYPE_REAL, true);
        seed[i] = random_number(r);
        random_note_size(r, seed[i]);
        const gm_variable *v = oracle_variable(to[i]);
        *legal =
            *legal && oracle_may_get(to[i], GM_TYPE_REAL) && oracle_is_number(seed[i]);
        r->open = r->open || (v && v->causality != GM_CAUSALITY_INPUT);
    }
    fmi2Status status =
        fmi2GetDirectionalDerivative(random_handle(r, legal), of, n, to, m, seed, value);
    if (status <= fmi2Warning)
        random_assert_numbers(r, value, n);
    return status;
}
