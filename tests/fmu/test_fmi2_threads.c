/* SPDX-License-Identifier: BSD-2-Clause
 *
 * 64 instances in 8 threads, stepped in turn within each thread: the same bits as each of
 * them alone. Under ThreadSanitizer (preset tsan) also: nothing is shared.
 */
#include "fmi2Functions.h"
#include "gm_model.h"
#include "gm_variables.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { THREADS = 8, PER_THREAD = 8, STEPS = 1000 };
#define H (1.0 / 512)

/* One instance and what it has answered so far. The tests of cmocka are not for threads:
 * failures are counted. */
typedef struct rider {
    fmi2Component c;
    uint64_t random, hash;
    int failures;
} rider;

static void ignore(fmi2ComponentEnvironment environment, fmi2String instance,
                   fmi2Status status, fmi2String category, fmi2String message, ...)
{
    (void)environment;
    (void)instance;
    (void)status;
    (void)category;
    (void)message;
}

static const fmi2CallbackFunctions callbacks = {ignore, calloc, free, NULL, NULL};

static unsigned draw(rider *r, unsigned n)
{
    r->random = r->random * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(r->random >> 33) % n;
}

static unsigned slot(gm_variable_id id, unsigned p)
{
    return GM_SLOTS * (unsigned)id + 1 + p;
}

static void expect(rider *r, fmi2Status status)
{
    r->failures += status > fmi2Warning; /* unknown gears and a left map are warned of */
}

static void start(rider *r, int number)
{
    *r = (rider){.random = (uint64_t)number, .hash = 0xcbf29ce484222325u};
    r->c = fmi2Instantiate("rider", fmi2CoSimulation, gm_model_guid(), NULL, &callbacks,
                           fmi2False, fmi2True);
    expect(r, r->c ? fmi2OK : fmi2Error);
    expect(r, fmi2SetupExperiment(r->c, fmi2False, 0, 0, fmi2False, 0));
    expect(r, fmi2EnterInitializationMode(r->c));
    expect(r, fmi2ExitInitializationMode(r->c));
}

/* Now and then another torque or gear. */
static void command(rider *r)
{
    unsigned p = draw(r, 2), tau = slot(GM_PATH_TAU, p), gear = slot(GM_PATH_GEAR, p);
    unsigned out = GM_SLOTS * GM_OUTPUT_TAU;
    double torque = draw(r, 2001) / 10.0 - 100.0;
    int number = (int)draw(r, 10) - 1;
    switch (draw(r, 16)) {
    case 0:
        expect(r, fmi2SetInteger(r->c, &gear, 1, &number));
        break;
    case 1:
        expect(r, fmi2SetReal(r->c, &tau, 1, &torque));
        break;
    case 2:
        torque *= 5;
        expect(r, fmi2SetReal(r->c, &out, 1, &torque));
        break;
    default:
        break;
    }
}

static void add(rider *r, const void *bytes, size_t n)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < n; i++)
        r->hash = (r->hash ^ byte[i]) * 0x100000001b3u; /* FNV-1a */
}

static void look(rider *r)
{
    for (unsigned id = 0; id < GM_VARIABLES; id++) {
        if (gm_variables[id].type != GM_TYPE_REAL)
            continue;
        unsigned vr = gm_variables[id].scope == GM_SCOPE_PATH
                          ? slot((gm_variable_id)id, 0)
                          : GM_SLOTS * id;
        double x = 0;
        expect(r, fmi2GetReal(r->c, &vr, 1, &x));
        add(r, &x, sizeof x);
    }
}

static void advance(rider *r, int step)
{
    command(r);
    expect(r, fmi2DoStep(r->c, step * H, H, fmi2True));
    look(r);
}

static void *ride(void *argument)
{
    rider *riders = argument;
    int first = (int)riders[0].random;
    for (int i = 0; i < PER_THREAD; i++)
        start(&riders[i], first + i);
    for (int step = 0; step < STEPS; step++)
        for (int i = 0; i < PER_THREAD; i++)
            advance(&riders[i], step);
    for (int i = 0; i < PER_THREAD; i++)
        fmi2FreeInstance(riders[i].c);
    return NULL;
}

static uint64_t ride_alone(int number)
{
    rider r;
    start(&r, number);
    for (int step = 0; step < STEPS; step++)
        advance(&r, step);
    fmi2FreeInstance(r.c);
    assert_int_equal(r.failures, 0);
    return r.hash;
}

static void instances_in_threads_give_the_same_bits_as_alone(void **state)
{
    static rider riders[THREADS][PER_THREAD];
    pthread_t threads[THREADS];
    (void)state;
    for (int t = 0; t < THREADS; t++) {
        riders[t][0].random = (uint64_t)t * PER_THREAD;
        assert_int_equal(pthread_create(&threads[t], NULL, ride, riders[t]), 0);
    }
    for (int t = 0; t < THREADS; t++)
        assert_int_equal(pthread_join(threads[t], NULL), 0);
    for (int t = 0; t < THREADS; t++)
        for (int i = 0; i < PER_THREAD; i++) {
            assert_int_equal(riders[t][i].failures, 0);
            assert_true(riders[t][i].hash == ride_alone(t * PER_THREAD + i));
        }
    assert_true(riders[0][0].hash != riders[0][1].hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_in_threads_give_the_same_bits_as_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
