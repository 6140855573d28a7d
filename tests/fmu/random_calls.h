/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Calls of FMI 2.0 functions with random arguments: each tells whether it is legal
 * (call_oracle.h), makes the call, keeps the oracle up to date and returns the answer.
 */
#ifndef RANDOM_CALLS_H
#define RANDOM_CALLS_H

#include "call_oracle.h"
#include "fmi2_fixture.h"

/* One instance with its host, its oracle and a state kept on the way. */
typedef struct random_run {
    uint64_t random;
    host host;
    fmi2Component c;
    oracle oracle, kept;
    fmi2FMUstate saved;
    bool reached; /* the call was made with the instance, not with NULL */
    bool open;    /* the standard leaves the answer open */
} random_run;

/** 0 .. n - 1; true once in so many. */
unsigned random_draw(random_run *r, unsigned n);
bool random_chance(random_run *r, unsigned one_in);

/** Of all sizes, now and then infinite or NaN. */
double random_number(random_run *r);

/** Any value reference, also of no variable; mostly one of this type, and to_set: one
 *  that can be set. */
unsigned random_reference(random_run *r);
unsigned random_useful_reference(random_run *r, gm_type type, bool to_set);

/** The instance, rarely NULL; *legal stays as it is or becomes false. */
fmi2Component random_handle(random_run *r, bool *legal);

/** Is the instance in one of these states? */
bool random_is_in(const random_run *r, int states);

/** Results may overflow from here on if the number is large. */
void random_note_size(random_run *r, double x);

fmi2Status random_setup(random_run *r, bool *legal);
fmi2Status random_enter(random_run *r, bool *legal);
fmi2Status random_exit(random_run *r, bool *legal);
fmi2Status random_terminate(random_run *r, bool *legal);
fmi2Status random_reset(random_run *r, bool *legal);
fmi2Status random_step(random_run *r, bool *legal);
fmi2Status random_set_real(random_run *r, bool *legal);
fmi2Status random_set_integer(random_run *r, bool *legal);
fmi2Status random_get_real(random_run *r, bool *legal);
fmi2Status random_get_integer(random_run *r, bool *legal);
fmi2Status random_strings(random_run *r, bool *legal);
fmi2Status random_input_rates(random_run *r, bool *legal);
fmi2Status random_output_rates(random_run *r, bool *legal);
fmi2Status random_logging(random_run *r, bool *legal);
fmi2Status random_status(random_run *r, bool *legal);
fmi2Status random_cancel(random_run *r, bool *legal);
fmi2Status random_derivative(random_run *r, bool *legal);
fmi2Status random_keep(random_run *r, bool *legal);
fmi2Status random_restore(random_run *r, bool *legal);
fmi2Status random_forget(random_run *r, bool *legal);
fmi2Status random_bytes(random_run *r, bool *legal);

/* Model Exchange */
fmi2Status random_enter_event(random_run *r, bool *legal);
fmi2Status random_update(random_run *r, bool *legal);
fmi2Status random_enter_continuous(random_run *r, bool *legal);
fmi2Status random_completed(random_run *r, bool *legal);
fmi2Status random_time(random_run *r, bool *legal);
fmi2Status random_set_states(random_run *r, bool *legal);
fmi2Status random_get_states(random_run *r, bool *legal);
fmi2Status random_rates(random_run *r, bool *legal);
fmi2Status random_indicators(random_run *r, bool *legal);
fmi2Status random_nominals(random_run *r, bool *legal);

/** The test: argv[1] sequences of calls, or as many as are usual. Returns what main does.
 */
int random_main(int argc, char **argv);

/** Stops the test unless all n values are numbers. */
void random_assert_numbers(const random_run *r, const double *value, size_t n);

#endif
