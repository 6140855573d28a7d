/* SPDX-License-Identifier: BSD-2-Clause */
#include "fmi2_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int blocks, allocations, must_fail;

int fixture_blocks(void)
{
    return blocks;
}

int fixture_allocations(void)
{
    return allocations;
}

void fixture_fail_allocation(void)
{
    must_fail = 1;
}

static void *take(size_t count, size_t size)
{
    if (must_fail) {
        must_fail = 0;
        return NULL;
    }
    blocks++;
    allocations++;
    return calloc(count, size);
}

static void give_back(void *block)
{
    blocks -= block != NULL;
    free(block);
}

static void keep(fmi2ComponentEnvironment environment, fmi2String instance,
                 fmi2Status status, fmi2String category, fmi2String message, ...)
{
    host *h = environment;
    va_list arguments;
    h->messages++;
    h->status = status;
    snprintf(h->category, sizeof h->category, "%s", category);
    snprintf(h->instance, sizeof h->instance, "%s", instance);
    va_start(arguments, message);
    vsnprintf(h->text, sizeof h->text, message, arguments);
    va_end(arguments);
}

void host_init(host *h)
{
    memset(h, 0, sizeof *h);
    h->callbacks = (fmi2CallbackFunctions){keep, take, give_back, NULL, h};
}

fmi2Component host_instantiate(host *h)
{
    return host_instantiate_as(h, fmi2CoSimulation);
}

fmi2Component host_instantiate_as(host *h, fmi2Type type)
{
    host_init(h);
    fmi2Component c = fmi2Instantiate("gearset", type, gm_model_guid(), NULL,
                                      &h->callbacks, fmi2False, fmi2False);
    assert_non_null(c);
    return c;
}

fmi2Component host_initialise(host *h)
{
    fmi2Component c = host_instantiate(h);
    assert_int_equal(fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    return c;
}

fmi2Component host_start(host *h)
{
    fmi2Component c = host_initialise(h);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    return c;
}

unsigned reference(gm_variable_id id, int p)
{
    return GM_SLOTS * (unsigned)id +
           (gm_variables[id].scope == GM_SCOPE_PATH ? 1u + (unsigned)p : 0u);
}

double get(fmi2Component c, gm_variable_id id, int p)
{
    double value;
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2GetReal(c, &vr, 1, &value), fmi2OK);
    return value;
}

int get_integer(fmi2Component c, gm_variable_id id, int p)
{
    int value;
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2GetInteger(c, &vr, 1, &value), fmi2OK);
    return value;
}

int get_boolean(fmi2Component c, gm_variable_id id, int p)
{
    int value;
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2GetBoolean(c, &vr, 1, &value), fmi2OK);
    return value;
}

void set(fmi2Component c, gm_variable_id id, int p, double value)
{
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2SetReal(c, &vr, 1, &value), fmi2OK);
}

void set_integer(fmi2Component c, gm_variable_id id, int p, int value)
{
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2SetInteger(c, &vr, 1, &value), fmi2OK);
}

void assert_refused(host *h, fmi2Status status, ...)
{
    va_list words;
    const char *word;
    assert_int_equal(status, fmi2Error);
    assert_int_equal(h->messages, 1);
    assert_int_equal(h->status, fmi2Error);
    assert_string_equal(h->category, "logStatusError");
    va_start(words, status);
    while ((word = va_arg(words, const char *)) != NULL)
        if (!strstr(h->text, word))
            fail_msg("\"%s\" does not say \"%s\"", h->text, word);
    va_end(words);
    h->messages = 0;
}
