/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The FMI functions of the detailed gearset driven from C, so that sanitizers see them:
 * life, a run with a shift, states kept and restored, failing allocations, wrong calls.
 */
#include "fmi2Functions.h"
#include "gm_detailed.h"

#include "base/alloc.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { STATES_MAX = 256 };

typedef struct fixture {
    char folder[64], uri[80], guid[GM_MOTION_GUID_SIZE];
    int n_states, n_events, errors;
} fixture;

static void count(fmi2ComponentEnvironment environment, fmi2String name,
                  fmi2Status status, fmi2String category, fmi2String message, ...)
{
    fixture *f = environment;
    (void)name;
    (void)category;
    assert_non_null(message);
    f->errors += status == fmi2Error;
}

static void copy_file(const char *from, const char *to)
{
    FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
    assert_non_null(in);
    assert_non_null(out);
    for (int c = fgetc(in); c != EOF; c = fgetc(in))
        fputc(c, out);
    fclose(in);
    assert_int_equal(fclose(out), 0);
}

static int setup(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    char file[128];
    gm_detailed *d = NULL;
    gm_error error;
    assert_non_null(f);
    strcpy(f->folder, "/tmp/gm_detailed_XXXXXX");
    assert_non_null(mkdtemp(f->folder));
    (void)snprintf(f->uri, sizeof f->uri, "file://%s", f->folder);
    (void)snprintf(file, sizeof file, "%s/gearset.yaml", f->folder);
    copy_file(GM_SOURCE_DIR "/examples/dct7.yaml", file);
    assert_int_equal(gm_detailed_create(file, &d, &error), GM_OK);
    strcpy(f->guid, d->guid);
    f->n_states = d->n_states;
    f->n_events = d->n_events;
    assert_true(f->n_states < STATES_MAX && f->n_events < STATES_MAX);
    gm_detailed_destroy(d);
    *state = f;
    return 0;
}

static int teardown(void **state)
{
    fixture *f = *state;
    char file[128];
    (void)snprintf(file, sizeof file, "%s/gearset.yaml", f->folder);
    (void)unlink(file);
    (void)rmdir(f->folder);
    free(f);
    return 0;
}

static fmi2CallbackFunctions host_of(fixture *f)
{
    f->errors = 0;
    return (fmi2CallbackFunctions){.logger = count, .componentEnvironment = f};
}

static fmi2Component make(fixture *f, const fmi2CallbackFunctions *host)
{
    return fmi2Instantiate("x", fmi2ModelExchange, f->guid, f->uri, host, fmi2False,
                           fmi2True);
}

static unsigned reference(gm_variable_id id, int slot)
{
    return GM_SLOTS * (unsigned)id + (unsigned)slot;
}

static void set_real(fmi2Component c, unsigned vr, double value)
{
    assert_int_equal(fmi2SetReal(c, &vr, 1, &value), fmi2OK);
}

static void set_gear(fmi2Component c, int slot, int gear)
{
    unsigned vr = reference(GM_PATH_GEAR, slot);
    assert_int_equal(fmi2SetInteger(c, &vr, 1, &gear), fmi2OK);
}

static void settle(fmi2Component c)
{
    fmi2EventInfo info;
    assert_int_equal(fmi2NewDiscreteStates(c, &info), fmi2OK);
    assert_false(info.newDiscreteStatesNeeded);
    assert_int_equal(fmi2EnterContinuousTimeMode(c), fmi2OK);
}

static void begin(fmi2Component c)
{
    assert_int_equal(fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    set_gear(c, 1, 1);
    set_real(c, reference(GM_OUTPUT_W_START, 0), 20.0);
    set_real(c, reference(GM_PATH_TAU, 1), 30.0);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    settle(c);
}

static void advance(const fixture *f, fmi2Component c, int steps)
{
    double x[STATES_MAX], dx[STATES_MAX];
    size_t n = (size_t)f->n_states;
    for (int k = 0; k < steps; k++) {
        assert_int_equal(fmi2GetContinuousStates(c, x, n), fmi2OK);
        assert_int_equal(fmi2GetDerivatives(c, dx, n), fmi2OK);
        for (size_t i = 0; i < n; i++)
            x[i] += 1e-8 * dx[i];
        assert_int_equal(fmi2SetContinuousStates(c, x, n), fmi2OK);
    }
}

static void shift(fmi2Component c, int slot, int gear)
{
    assert_int_equal(fmi2EnterEventMode(c), fmi2OK);
    set_gear(c, slot, gear);
    settle(c);
}

static void runs_and_shifts(void **state)
{
    fixture *f = *state;
    fmi2CallbackFunctions host = host_of(f);
    fmi2Component c = make(f, &host);
    fmi2Boolean event, end;
    double z[STATES_MAX];
    assert_non_null(c);
    begin(c);
    advance(f, c, 200);
    shift(c, 2, 2);
    assert_int_equal(fmi2GetEventIndicators(c, z, (size_t)f->n_events), fmi2OK);
    advance(f, c, 50);
    shift(c, 1, 0); /* dogs under load give up their energy */
    advance(f, c, 50);
    assert_int_equal(fmi2CompletedIntegratorStep(c, fmi2True, &event, &end), fmi2OK);
    assert_int_equal(fmi2Terminate(c), fmi2OK);
    assert_int_equal(f->errors, 0);
    fmi2FreeInstance(c);
}

static void keeps_and_restores_states(void **state)
{
    fixture *f = *state;
    fmi2CallbackFunctions host = host_of(f);
    fmi2Component c = make(f, &host);
    fmi2FMUstate kept = NULL, copy = NULL;
    double before[STATES_MAX], after[STATES_MAX];
    size_t n = (size_t)f->n_states, size = 0;
    begin(c);
    shift(c, 2, 4);
    assert_int_equal(fmi2GetFMUstate(c, &kept), fmi2OK);
    advance(f, c, 20);
    assert_int_equal(fmi2GetContinuousStates(c, before, n), fmi2OK);
    set_real(c, reference(GM_OIL_TEMPERATURE, 0), 300.0);
    shift(c, 2, 0);
    assert_int_equal(fmi2SerializedFMUstateSize(c, kept, &size), fmi2OK);
    char *bytes = malloc(size);
    assert_int_equal(fmi2SerializeFMUstate(c, kept, bytes, size), fmi2OK);
    assert_int_equal(fmi2DeSerializeFMUstate(c, bytes, size, &copy), fmi2OK);
    assert_int_equal(fmi2DeSerializeFMUstate(c, bytes, size, &copy), fmi2OK);
    assert_int_equal(fmi2SetFMUstate(c, copy), fmi2OK);
    advance(f, c, 20);
    assert_int_equal(fmi2GetContinuousStates(c, after, n), fmi2OK);
    assert_memory_equal(before, after, n * sizeof *before);
    assert_int_equal(fmi2FreeFMUstate(c, &kept), fmi2OK);
    assert_int_equal(fmi2FreeFMUstate(c, &copy), fmi2OK);
    free(bytes);
    assert_int_equal(f->errors, 0);
    fmi2FreeInstance(c);
}

/* Without memory there is no instance, and nothing is left of it. */
static void survives_failing_allocations(void **state)
{
    fixture *f = *state;
    fmi2CallbackFunctions host = host_of(f);
    long k = 0;
    for (fmi2Component c = NULL; !c;) {
        /* the first ones one by one, then in strides: there are thousands */
        k += k < 200 ? 1 : 37;
        gm_alloc_fail_after(k);
        c = make(f, &host);
        gm_alloc_fail_after(0);
        assert_true(c || f->errors > 0);
        fmi2FreeInstance(c);
    }
    assert_true(k > 200);
}

static void survives_failing_allocations_at_events(void **state)
{
    fixture *f = *state;
    fmi2CallbackFunctions host = host_of(f);
    fmi2EventInfo info;
    int failed = 0;
    for (long k = 1;; k += 11) {
        fmi2Component c = make(f, &host);
        begin(c);
        assert_int_equal(fmi2EnterEventMode(c), fmi2OK);
        set_real(c, reference(GM_OIL_TEMPERATURE, 0), 310.0);
        gm_alloc_fail_after(k);
        fmi2Status status = fmi2NewDiscreteStates(c, &info);
        gm_alloc_fail_after(0);
        fmi2FreeInstance(c);
        if (status == fmi2OK)
            break;
        failed++;
    }
    assert_true(failed > 3);
}

static void refuses_wrong_arguments(void **state)
{
    fixture *f = *state;
    fmi2CallbackFunctions host = host_of(f);
    assert_null(fmi2Instantiate("x", fmi2CoSimulation, f->guid, f->uri, &host, 0, 0));
    assert_null(fmi2Instantiate("", fmi2ModelExchange, f->guid, f->uri, &host, 0, 0));
    assert_null(fmi2Instantiate("x", fmi2ModelExchange, NULL, f->uri, &host, 0, 0));
    assert_null(fmi2Instantiate("x", fmi2ModelExchange, "{}", f->uri, &host, 0, 0));
    assert_null(fmi2Instantiate("x", fmi2ModelExchange, f->guid, NULL, &host, 0, 0));
    assert_null(
        fmi2Instantiate("x", fmi2ModelExchange, f->guid, "http://a/b", &host, 0, 0));
    assert_null(
        fmi2Instantiate("x", fmi2ModelExchange, f->guid, "file:///none", &host, 0, 0));
    assert_null(fmi2Instantiate("x", fmi2ModelExchange, f->guid, f->uri, NULL, 0, 0));
    assert_int_equal(f->errors, 7);
    assert_int_equal(fmi2Terminate(NULL), fmi2Error);
    assert_int_equal(fmi2GetDerivatives(NULL, NULL, 0), fmi2Error);
}

static void refuses_wrong_calls(void **state)
{
    fixture *f = *state;
    fmi2CallbackFunctions host = host_of(f);
    fmi2Component c = make(f, &host);
    double x[STATES_MAX] = {0.0};
    unsigned none = 4000, real = reference(GM_PATH_TAU, 1);
    int integer = 0;
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2Error);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    begin(c);
    assert_int_equal(fmi2SetContinuousStates(c, x, 3), fmi2Error);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    begin(c);
    assert_int_equal(fmi2GetReal(c, &none, 1, x), fmi2Error);
    assert_int_equal(fmi2GetInteger(c, &real, 1, &integer), fmi2Error);
    assert_int_equal(fmi2SetContinuousStates(c, x, (size_t)f->n_states), fmi2Error);
    assert_int_equal(fmi2Reset(c), fmi2OK);
    begin(c);
    x[0] = (double)NAN;
    assert_int_equal(fmi2SetReal(c, &real, 1, x), fmi2Error);
    assert_int_equal(f->errors, 6);
    fmi2FreeInstance(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_and_shifts),
        cmocka_unit_test(keeps_and_restores_states),
        cmocka_unit_test(survives_failing_allocations),
        cmocka_unit_test(survives_failing_allocations_at_events),
        cmocka_unit_test(refuses_wrong_arguments),
        cmocka_unit_test(refuses_wrong_calls),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
