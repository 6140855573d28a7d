/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A host for the component compiled into the test: counts memory, keeps messages.
 */
#ifndef FMI2_FIXTURE_H
#define FMI2_FIXTURE_H

#include "fmi2Functions.h"
#include "gm_model.h"
#include "gm_variables.h"

typedef struct host {
    fmi2CallbackFunctions callbacks;
    int messages; /* received so far */
    fmi2Status status;
    char category[64], text[512], instance[64];
} host;

/** Blocks taken and not given back, and all taken, by callbacks of this thread's hosts.
 */
int fixture_blocks(void);
int fixture_allocations(void);
/** The next allocation fails. */
void fixture_fail_allocation(void);

/** Callbacks into h. */
void host_init(host *h);

/** New instance of the compiled-in gearset, for Co-Simulation or as told. */
fmi2Component host_instantiate(host *h);
fmi2Component host_instantiate_as(host *h, fmi2Type type);

/** In initialisation mode at t = 0 without stop time; in step mode. */
fmi2Component host_initialise(host *h);
fmi2Component host_start(host *h);

/** Value reference of a variable of path p (0 where it belongs to none). */
unsigned reference(gm_variable_id id, int p);

/** Shorthands that stop the test unless the status is fmi2OK. */
double get(fmi2Component c, gm_variable_id id, int p);
int get_integer(fmi2Component c, gm_variable_id id, int p);
int get_boolean(fmi2Component c, gm_variable_id id, int p);
void set(fmi2Component c, gm_variable_id id, int p, double value);
void set_integer(fmi2Component c, gm_variable_id id, int p, int value);

/** The call failed with a message of category logStatusError that has all of the words
 *  (NULL-terminated) in it. Forgets the message. */
void assert_refused(host *h, fmi2Status status, ...);

#endif
