/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the standard allows: the state of an instance as its host must see it, and whether
 * a call with given arguments is legal then. Written from FMI 2.0.3 (section 2.1.7 on
 * values, the tables of sections 3.2.3 and 4.2.4 on the order of calls) and the
 * variables' list, not from the component's code.
 */
#ifndef CALL_ORACLE_H
#define CALL_ORACLE_H

#include "fmi2Functions.h"
#include "gm_variables.h"

#include <stdbool.h>
#include <stdint.h>

/* Bits, as columns of the table: a set of states is a mask. */
enum {
    INSTANTIATED = 1,
    INITIALISATION = 2,
    STEP_COMPLETE = 4,
    STEP_FAILED = 8,
    TERMINATED = 16,
    BROKEN = 32, /* "error" in the tables */
    EVENT = 64,
    CONTINUOUS = 128,
    EXCHANGE = EVENT | CONTINUOUS,
    BEFORE_START = INSTANTIATED | INITIALISATION,
    ANYWHERE = 255,
    TO_SET = BEFORE_START | STEP_COMPLETE | EXCHANGE,
    TO_GET = INITIALISATION | STEP_COMPLETE | STEP_FAILED | TERMINATED | BROKEN | EXCHANGE
};

typedef struct oracle {
    int state;
    bool exchange; /* instantiated for Model Exchange */
    bool experiment_set, stop_defined;
    double time, stop;
    bool huge;       /* was given numbers whose results may overflow */
    bool update_due; /* in an event: something changed since the last update */
} oracle;

/** May this number be given to a variable of the example in this state? type: the type
 *  that the function carries. */
bool oracle_may_set(const oracle *o, unsigned vr, gm_type type, double value);

/** May the variable be read by a function for this type (in a state to get)? */
bool oracle_may_get(unsigned vr, gm_type type);

/** The variable behind a value reference of a gearset with two paths, or NULL. */
const gm_variable *oracle_variable(unsigned vr);

/** Is the number neither NaN nor infinite? */
bool oracle_is_number(double x);

#endif
