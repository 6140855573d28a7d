/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Model Exchange resumed from states that were kept on the way, as bytes: whatever the
 * solver does, what follows is the same to the last bit. In both fidelities.
 */
#include "fmi2_fixture.h"
#include "gm_saved.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { NX = 10, NZ = 6, STEPS = 3000, POINTS = 100, RESUMED = 150 };
#define H (1.0 / 65536) /* explicit steps that follow the springs of lash */

typedef struct look {
    double x[NX], rates[NX], z[NZ], loss;
} look;

static unsigned draw(uint64_t *random, unsigned n)
{
    *random = *random * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*random >> 33) % n;
}

static void update(fmi2Component c)
{
    fmi2EventInfo info;
    assert_true(fmi2NewDiscreteStates(c, &info) <= fmi2Warning); /* the map is left */
    assert_int_equal(fmi2EnterContinuousTimeMode(c), fmi2OK);
}

static fmi2Component start(host *h, int fidelity)
{
    fmi2Component c = host_instantiate_as(h, fmi2ModelExchange);
    set_integer(c, GM_FIDELITY, 0, fidelity);
    assert_int_equal(fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    update(c);
    return c;
}

/* Before step i, from its number alone: now and then another gear or torque. */
static void command(fmi2Component c, int i)
{
    static const int gears[2][3] = {{0, 1, 3}, {0, 2, 4}};
    uint64_t random = (uint64_t)i * 0x9e3779b97f4a7c15u;
    int p = (int)draw(&random, 2);
    if (draw(&random, 40) > 0)
        return;
    assert_int_equal(fmi2EnterEventMode(c), fmi2OK);
    set(c, GM_PATH_TAU, p, draw(&random, 100) - 50.0);
    set(c, GM_OUTPUT_TAU, 0, draw(&random, 800) - 400.0);
    set_integer(c, GM_PATH_GEAR, p, gears[p][draw(&random, 3)]);
    update(c);
}

/* A step of Euler's; an event when an indicator has changed its sign. */
static void step(fmi2Component c, int i, look *l)
{
    double before[NZ];
    int event = 0;
    command(c, i);
    assert_int_equal(fmi2GetEventIndicators(c, before, NZ), fmi2OK);
    assert_int_equal(fmi2GetContinuousStates(c, l->x, NX), fmi2OK);
    assert_int_equal(fmi2GetDerivatives(c, l->rates, NX), fmi2OK);
    for (int k = 0; k < NX; k++)
        l->x[k] += H * l->rates[k];
    assert_int_equal(fmi2SetTime(c, (i + 1) * H), fmi2OK);
    assert_int_equal(fmi2SetContinuousStates(c, l->x, NX), fmi2OK);
    assert_int_equal(fmi2GetEventIndicators(c, l->z, NZ), fmi2OK);
    for (int k = 0; k < NZ; k++)
        event |= (before[k] > 0) != (l->z[k] > 0);
    if (event) {
        assert_int_equal(fmi2EnterEventMode(c), fmi2OK);
        update(c);
    }
    l->loss = get(c, GM_LOSS_ENERGY, 0);
}

static void runs_are_resumed(int fidelity)
{
    static look looks[STEPS];
    static char bytes[POINTS][sizeof(gm_saved)];
    int first[POINTS];
    uint64_t random = 1;
    host h, other;
    fmi2FMUstate saved = NULL;
    fmi2Component c = start(&h, fidelity), d = start(&other, fidelity);
    for (int i = 0, n = 0; i < STEPS; i++) {
        if (n < POINTS && draw(&random, STEPS - RESUMED) < 2 * POINTS &&
            i < STEPS - RESUMED) {
            assert_int_equal(fmi2GetFMUstate(c, &saved), fmi2OK);
            assert_int_equal(fmi2SerializeFMUstate(c, saved, bytes[n], sizeof bytes[n]),
                             fmi2OK);
            first[n++] = i;
        }
        step(c, i, &looks[i]);
        assert_true(i < STEPS - 1 || n == POINTS);
    }
    for (int n = POINTS; n-- > 0;) {
        assert_int_equal(fmi2DeSerializeFMUstate(d, bytes[n], sizeof bytes[n], &saved),
                         fmi2OK);
        assert_int_equal(fmi2SetFMUstate(d, saved), fmi2OK);
        for (int i = first[n]; i < first[n] + RESUMED; i++) {
            look again;
            step(d, i, &again);
            assert_memory_equal(&again, &looks[i], sizeof again);
        }
    }
    assert_int_equal(fmi2FreeFMUstate(d, &saved), fmi2OK);
    fmi2FreeInstance(c);
    fmi2FreeInstance(d);
}

static void rigid_runs_are_resumed(void **state)
{
    (void)state;
    runs_are_resumed(GM_RIGID);
}

static void lash_runs_are_resumed(void **state)
{
    (void)state;
    runs_are_resumed(GM_LASH);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rigid_runs_are_resumed),
        cmocka_unit_test(lash_runs_are_resumed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
