/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The state of the FMU kept, restored and made into bytes: a resumed run is the
 * uninterrupted one to the last bit, and what is no state of this FMU is refused.
 */
#include "fmi2_fixture.h"
#include "gm_saved.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* No gaps: the members are all there is. */
_Static_assert(sizeof(gm_saved_path) == 4 * sizeof(gm_real) + 4 * sizeof(int32_t),
               "gm_saved_path has gaps");
_Static_assert(sizeof(gm_saved) == 2 * sizeof(uint32_t) + 2 * sizeof(uint64_t) +
                                       GM_VARIABLES * GM_MAX_PATHS * sizeof(gm_real) +
                                       9 * sizeof(gm_real) +
                                       GM_MAX_PATHS * sizeof(gm_saved_path) +
                                       14 * sizeof(int32_t),
               "gm_saved has gaps");

/* ---- a drive of random commands, the same ones whenever it is repeated ---- */

enum { STEPS = 3000, POINTS = 100, RESUMED = 150 };
static const double dt = 1.0 / 128; /* binary: times are exact */

static uint32_t draw(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* -1 .. 1 */
static double spread(uint32_t *seed)
{
    return (double)draw(seed) / 8388608.0 - 1.0;
}

static void set_slope(fmi2Component c, gm_variable_id id, int p, double rate)
{
    unsigned vr = reference(id, p);
    assert_int_equal(fmi2SetRealInputDerivatives(c, &vr, 1, &(int){1}, &rate), fmi2OK);
}

/* What the host sets before step i: now and then a torque with its slope, a gear (also
 * one that does not exist), a parameter; else things go on as they are. */
static void command(fmi2Component c, int i)
{
    static const int gears[2][4] = {{0, 1, 3, 9}, {0, -1, 2, 9}};
    uint32_t seed = (uint32_t)i * 2654435761u + 7u;
    for (int k = 0; k < 4; k++)
        (void)draw(&seed);
    int p = (int)(draw(&seed) >> 12) % 2;
    switch ((draw(&seed) >> 10) % 32) {
    case 0:
        set_integer(c, GM_PATH_GEAR, p, gears[p][(draw(&seed) >> 10) % 4]);
        break;
    case 1:
    case 2:
        set(c, GM_PATH_TAU, p, 60 * spread(&seed));
        set_slope(c, GM_PATH_TAU, p, 40 * spread(&seed));
        break;
    case 3:
        set(c, GM_OUTPUT_TAU, 0, 200 * spread(&seed));
        set_slope(c, GM_OUTPUT_TAU, 0, 100 * spread(&seed));
        break;
    case 4:
        set(c, GM_LOSS_SCALE, 0, 1.5 + spread(&seed));
        break;
    case 5:
        set(c, GM_PATH_SYNC_TORQUE, p, 6 + 5 * spread(&seed));
        break;
    default:
        break;
    }
}

typedef struct snapshot {
    double real[GM_VARIABLES][2];
    int integer[GM_VARIABLES][2];
} snapshot;

static snapshot look(fmi2Component c)
{
    snapshot s;
    memset(&s, 0, sizeof s);
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < (gm_variables[id].scope == GM_SCOPE_PATH ? 2 : 1); p++)
            switch (gm_variable_carrier(gm_variables[id].type)) {
            case GM_TYPE_REAL:
                s.real[id][p] = get(c, (gm_variable_id)id, p);
                break;
            case GM_TYPE_BOOLEAN:
                s.integer[id][p] = get_boolean(c, (gm_variable_id)id, p);
                break;
            default:
                s.integer[id][p] = get_integer(c, (gm_variable_id)id, p);
            }
    return s;
}

static void step(fmi2Component c, int i)
{
    assert_true(fmi2DoStep(c, i * dt, dt, fmi2False) <= fmi2Warning);
}

static fmi2FMUstate save(fmi2Component c)
{
    fmi2FMUstate saved = NULL;
    assert_int_equal(fmi2GetFMUstate(c, &saved), fmi2OK);
    assert_non_null(saved);
    return saved;
}

static void drop(fmi2Component c, fmi2FMUstate saved)
{
    assert_int_equal(fmi2FreeFMUstate(c, &saved), fmi2OK);
    assert_null(saved);
}

/* The uninterrupted run with the states kept on the way. Every other one is kept between
 * the commands and the step, so that gear changes and slopes are pending. */
typedef struct record {
    snapshot after[STEPS];
    int point[POINTS];
    fmi2FMUstate saved[POINTS];
    int synchronising, pending; /* how many of the states are so */
} record;
static record run;

static int is_pending(fmi2Component c, const snapshot *commanded)
{
    gm_saved *s = save(c);
    int pending = 0;
    for (int p = 0; p < 2; p++) {
        int g = s->path[p].gear;
        int now = g < 0 ? 0 : gm_model_map()->path[p].gears[g].number;
        pending |= commanded->integer[GM_PATH_GEAR][p] != now;
    }
    drop(c, s);
    return pending;
}

static void keep_state(fmi2Component c, int k)
{
    snapshot s = look(c);
    run.saved[k] = save(c);
    run.synchronising += s.integer[GM_PATH_STATE][0] == GM_PATH_SYNCHRONISING ||
                         s.integer[GM_PATH_STATE][1] == GM_PATH_SYNCHRONISING;
    run.pending += is_pending(c, &s);
}

static void drive_and_keep(fmi2Component c)
{
    uint32_t seed = 11;
    int k = 0;
    memset(&run, 0, sizeof run);
    for (int i = 0; i < STEPS; i++) {
        int left = STEPS - RESUMED - i;
        /* choose POINTS of the steps, each set of them being as likely */
        int here =
            k < POINTS && left > 0 && (int)(draw(&seed) % (uint32_t)left) < POINTS - k;
        if (here && k % 2 == 0)
            keep_state(c, k);
        command(c, i);
        if (here && k % 2 == 1)
            keep_state(c, k);
        if (here)
            run.point[k++] = i;
        step(c, i);
        run.after[i] = look(c);
    }
    assert_int_equal(k, POINTS);
    assert_true(run.synchronising >= 5 && run.pending >= 5);
}

static void resume(fmi2Component c, int k)
{
    int first = run.point[k];
    assert_int_equal(fmi2SetFMUstate(c, run.saved[k]), fmi2OK);
    for (int i = first; i < first + RESUMED; i++) {
        if (i > first || k % 2 == 0)
            command(c, i);
        step(c, i);
        snapshot s = look(c);
        if (memcmp(&s, &run.after[i], sizeof s) != 0)
            fail_msg("state %d, kept at step %d: step %d differs", k, first, i);
    }
}

static void a_resumed_run_is_the_uninterrupted_one(void **state)
{
    host h, other;
    (void)state;
    fmi2Component c = host_start(&h);
    drive_and_keep(c);
    for (int k = POINTS - 1; k >= 0; k--) {
        if (k % 3 == 0)
            assert_int_equal(fmi2Reset(c), fmi2OK);
        resume(c, k);
        if (k % 5 == 0) { /* in an instance that was never initialised */
            fmi2Component fresh = host_instantiate(&other);
            resume(fresh, k);
            fmi2FreeInstance(fresh);
        }
    }
    for (int k = 0; k < POINTS; k++)
        drop(c, run.saved[k]);
    fmi2FreeInstance(c);
    assert_int_equal(fixture_blocks(), 0);
}

/* All members come back: the state of the restored instance has the same bytes. */
static void what_is_restored_is_saved_as_the_same_bytes(void **state)
{
    host h, other;
    (void)state;
    fmi2Component c = host_start(&h), d = host_instantiate(&other);
    for (int i = 0; i < 600; i++) {
        command(c, i);
        step(c, i);
        fmi2FMUstate first = save(c);
        assert_int_equal(fmi2SetFMUstate(d, first), fmi2OK);
        fmi2FMUstate second = save(d);
        assert_memory_equal(first, second, sizeof(gm_saved));
        drop(c, first);
        drop(d, second);
    }
    fmi2FreeInstance(c);
    fmi2FreeInstance(d);
}

/* Also before and in initialisation, where start values wait to be used. */
static void start_values_and_phases_are_kept(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_instantiate(&h);
    set(c, GM_OUTPUT_W_START, 0, 12);
    fmi2FMUstate instantiated = save(c);
    assert_int_equal(fmi2SetupExperiment(c, 0, 0, 3, fmi2True, 4), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    set(c, GM_OUTPUT_W_START, 0, 13);
    fmi2FMUstate initialising = save(c);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    assert_int_equal(fmi2Terminate(c), fmi2OK);
    assert_int_equal(fmi2SetFMUstate(c, initialising), fmi2OK);
    assert_true(get(c, GM_OUTPUT_W, 0) == 13);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    assert_int_equal(fmi2DoStep(c, 3, 1, fmi2True), fmi2OK);
    assert_refused(&h, fmi2DoStep(c, 4, 1, fmi2True), "stop time 4", NULL);
    assert_int_equal(fmi2SetFMUstate(c, instantiated), fmi2OK);
    assert_int_equal(fmi2SetupExperiment(c, 0, 0, 0, 0, 0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(c), fmi2OK);
    assert_true(get(c, GM_OUTPUT_W, 0) == 12);
    drop(c, instantiated);
    drop(c, initialising);
    fmi2FreeInstance(c);
    assert_int_equal(fixture_blocks(), 0);
}

static void an_earlier_state_is_a_way_out_of_an_error(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_start(&h);
    set(c, GM_OUTPUT_TAU, 0, 30);
    fmi2FMUstate saved = save(c);
    step(c, 0);
    snapshot before = look(c);
    assert_int_equal(fmi2DoStep(c, 5, dt, fmi2True), fmi2Error);
    assert_int_equal(fmi2SetFMUstate(c, saved), fmi2OK);
    step(c, 0);
    snapshot after = look(c);
    assert_memory_equal(&before, &after, sizeof before);
    drop(c, saved);
    fmi2FreeInstance(c);
}

/* The host goes back before each step; the warning does not come with each. */
static void leaving_the_map_is_told_once_per_instance(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set(c, GM_OUTPUT_W_START, 0, 600);
    fmi2FMUstate saved = save(c);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    assert_int_equal(fmi2GetFMUstate(c, &saved), fmi2OK);
    assert_int_equal(fmi2DoStep(c, 0, dt, fmi2False), fmi2Warning);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(fmi2SetFMUstate(c, saved), fmi2OK);
        assert_int_equal(fmi2DoStep(c, 0, dt, fmi2False), fmi2OK);
        assert_int_equal(get_boolean(c, GM_OUT_OF_MAP, 0), fmi2True);
    }
    drop(c, saved);
    fmi2FreeInstance(c);
}

/* ---- memory ---- */

static void the_block_of_the_host_is_used_again(void **state)
{
    host h;
    char bytes[sizeof(gm_saved)];
    (void)state;
    fmi2Component c = host_start(&h);
    fmi2FMUstate saved = save(c), block = saved;
    int taken = fixture_allocations();
    for (int i = 0; i < 10; i++) {
        step(c, i);
        assert_int_equal(fmi2GetFMUstate(c, &saved), fmi2OK);
        assert_int_equal(fmi2SetFMUstate(c, saved), fmi2OK);
        assert_int_equal(fmi2SerializeFMUstate(c, saved, bytes, sizeof bytes), fmi2OK);
        assert_int_equal(fmi2DeSerializeFMUstate(c, bytes, sizeof bytes, &saved), fmi2OK);
    }
    assert_ptr_equal(saved, block);
    assert_int_equal(fixture_allocations(), taken);
    drop(c, saved);
    drop(c, NULL);
    assert_int_equal(fmi2FreeFMUstate(c, NULL), fmi2OK);
    fmi2FreeInstance(c);
    assert_int_equal(fixture_blocks(), 0);
}

/* Keep, make bytes and back, with the k-th allocation failing. */
static int goes_well(host *h, fmi2Component c, int k)
{
    fmi2FMUstate saved = NULL, again = NULL;
    char bytes[sizeof(gm_saved)];
    if (k == 0)
        fixture_fail_allocation();
    fmi2Status status = fmi2GetFMUstate(c, &saved);
    if (status == fmi2OK) {
        assert_int_equal(fmi2SerializeFMUstate(c, saved, bytes, sizeof bytes), fmi2OK);
        if (k == 1)
            fixture_fail_allocation();
        status = fmi2DeSerializeFMUstate(c, bytes, sizeof bytes, &again);
    }
    if (status != fmi2OK)
        assert_refused(h, status, "out of memory", NULL);
    assert_true((k == 0) == (saved == NULL) && (k < 2) == (again == NULL));
    drop(c, saved);
    drop(c, again);
    assert_int_equal(fixture_blocks(), 1);
    return status == fmi2OK;
}

static void failing_allocations_are_errors_without_a_leak(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        host h;
        fmi2Component c = host_start(&h);
        assert_int_equal(goes_well(&h, c, k), k == 2);
        assert_true(get(c, GM_OUTPUT_W, 0) == 0); /* still readable */
        fmi2FreeInstance(c);
    }
    assert_int_equal(fixture_blocks(), 0);
}

/* ---- what is refused ---- */

/* Every bit of the bytes matters. */
static void damaged_bytes_are_refused(void **state)
{
    host h;
    char bytes[sizeof(gm_saved)];
    fmi2FMUstate back = NULL;
    (void)state;
    fmi2Component c = host_start(&h);
    for (int i = 0; i < 400; i++) {
        command(c, i);
        step(c, i);
    }
    fmi2FMUstate saved = save(c);
    assert_int_equal(fmi2SerializeFMUstate(c, saved, bytes, sizeof bytes), fmi2OK);
    int taken = fixture_allocations();
    snapshot before = look(c);
    for (size_t bit = 0; bit < 8 * sizeof bytes; bit++) {
        char mask = (char)(1u << (bit % 8));
        h.messages = 0;
        bytes[bit / 8] = (char)(bytes[bit / 8] ^ mask);
        assert_refused(&h, fmi2DeSerializeFMUstate(c, bytes, sizeof bytes, &back),
                       "fmi2DeSerializeFMUstate", "state", NULL);
        assert_null(back);
        bytes[bit / 8] = (char)(bytes[bit / 8] ^ mask);
    }
    snapshot after = look(c);
    assert_memory_equal(&before, &after, sizeof before);
    assert_int_equal(fixture_allocations(), taken);
    assert_int_equal(fmi2DeSerializeFMUstate(c, bytes, sizeof bytes, &back), fmi2OK);
    assert_int_equal(fmi2SetFMUstate(c, back), fmi2OK); /* and out of the error */
    step(c, 400);
    drop(c, saved);
    drop(c, back);
    fmi2FreeInstance(c);
}

static void states_of_other_fmus_and_damaged_ones_are_refused(void **state)
{
    host h;
    gm_saved other, damaged;
    gm_run empty = {.phase = GM_PHASE_STEP};
    size_t size = 7;
    (void)state;
    fmi2Component c = host_start(&h);
    set(c, GM_OUTPUT_TAU, 0, 30);
    step(c, 0);
    snapshot before = look(c);
    gm_saved_make("{another}", &empty, &other);
    gm_saved_make(gm_model_guid(), &empty, &damaged);
    damaged.w_o += 1;
    fmi2FMUstate bad[] = {&other, &damaged, &(gm_saved){0}, NULL};
    const char *word[] = {"another FMU", "damaged", "not a state", "missing"};
    for (int i = 0; i < 4; i++) {
        h.messages = 0;
        assert_refused(&h, fmi2SetFMUstate(c, bad[i]), "fmi2SetFMUstate", word[i], NULL);
        assert_refused(&h, fmi2SerializedFMUstateSize(c, bad[i], &size), word[i], NULL);
        assert_refused(&h, fmi2SerializeFMUstate(c, bad[i], (char[1]){0}, 1), word[i],
                       NULL);
    }
    assert_int_equal(size, 7);
    for (int i = 0; i < 3; i += 2) { /* not memory to write to or to free */
        fmi2FMUstate kept = bad[i];
        assert_refused(&h, fmi2GetFMUstate(c, &kept), word[i], NULL);
        assert_refused(&h, fmi2FreeFMUstate(c, &kept), word[i], NULL);
        assert_ptr_equal(kept, bad[i]);
    }
    snapshot after = look(c);
    assert_memory_equal(&before, &after, sizeof before);
    fmi2FreeInstance(c);
}

static void missing_places_and_wrong_sizes_are_refused(void **state)
{
    host h;
    char bytes[sizeof(gm_saved) + 1];
    const size_t n = sizeof(gm_saved);
    fmi2FMUstate back = NULL;
    size_t size = 0;
    (void)state;
    fmi2Component c = host_start(&h);
    fmi2FMUstate s = save(c);
    assert_int_equal(fmi2SerializedFMUstateSize(c, s, &size), fmi2OK);
    assert_int_equal(size, n);
    assert_int_equal(fmi2SerializeFMUstate(c, s, bytes, n), fmi2OK);
    assert_refused(&h, fmi2GetFMUstate(c, NULL), "no place", NULL);
    assert_refused(&h, fmi2SerializedFMUstateSize(c, s, NULL), "no place", NULL);
    assert_refused(&h, fmi2SerializeFMUstate(c, s, NULL, n), "missing", NULL);
    assert_refused(&h, fmi2SerializeFMUstate(c, s, bytes, n - 1), "bytes", NULL);
    assert_refused(&h, fmi2SerializeFMUstate(c, s, bytes, n + 1), "bytes", NULL);
    assert_refused(&h, fmi2DeSerializeFMUstate(c, NULL, n, &back), "missing", NULL);
    assert_refused(&h, fmi2DeSerializeFMUstate(c, bytes, n - 1, &back), "bytes", NULL);
    assert_refused(&h, fmi2DeSerializeFMUstate(c, bytes, n + 1, &back), "bytes", NULL);
    assert_refused(&h, fmi2DeSerializeFMUstate(c, bytes, 0, &back), "bytes", NULL);
    assert_refused(&h, fmi2DeSerializeFMUstate(c, bytes, n, NULL), "no place", NULL);
    assert_null(back);
    drop(c, s);
    fmi2FreeInstance(c);
    assert_int_equal(fixture_blocks(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_resumed_run_is_the_uninterrupted_one),
        cmocka_unit_test(what_is_restored_is_saved_as_the_same_bytes),
        cmocka_unit_test(start_values_and_phases_are_kept),
        cmocka_unit_test(an_earlier_state_is_a_way_out_of_an_error),
        cmocka_unit_test(leaving_the_map_is_told_once_per_instance),
        cmocka_unit_test(the_block_of_the_host_is_used_again),
        cmocka_unit_test(failing_allocations_are_errors_without_a_leak),
        cmocka_unit_test(damaged_bytes_are_refused),
        cmocka_unit_test(states_of_other_fmus_and_damaged_ones_are_refused),
        cmocka_unit_test(missing_places_and_wrong_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
