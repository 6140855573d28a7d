/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "elastic_gearset.h"
#include "vehicle/car.h"
#include "vehicle/trip.h"

#include <math.h>
#include <string.h>

#define N_MAX 32

static const gm_transmission one_gear = {
    .n_paths = 1, .n_gears = 1, .gear = {{1, 0, 8.0}}};

typedef struct fixture {
    gm_vehicle vehicle;
    gm_cycle *cycle;
    gm_gear_plan *plan;
    elastic_gearset gearset;
    gm_dynamics dynamics;
    gm_trip_parts parts;
    gm_trip *trip;
} fixture;

static void set_up(fixture *f, const char *cycle, double ratio, double grade,
                   int with_jacobian)
{
    gm_error error;
    *f = (fixture){.vehicle = gm_vehicle_reference(),
                   .gearset = {ratio, 0.01, 0.05, 2e4, 20.0, 0.3, with_jacobian}};
    assert_int_equal(gm_cycle_named(cycle, &f->cycle, &error), GM_OK);
    f->vehicle.grade = grade;
    if (grade > 0.0) { /* uphill: with all options */
        f->vehicle.tyre_stiffness = 1e5;
        f->vehicle.tyre_force_max = 7000.0;
        f->vehicle.mount_inertia = 12.0;
        f->vehicle.mount_stiffness = 47000.0;
        f->vehicle.mount_damping = 150.0;
    }
    assert_int_equal(
        gm_gear_plan_create(f->cycle, &f->vehicle, &one_gear, &f->plan, &error), GM_OK);
    f->dynamics = elastic_gearset_dynamics(&f->gearset);
    f->parts = (gm_trip_parts){.vehicle = &f->vehicle,
                               .cycle = f->cycle,
                               .plan = f->plan,
                               .gearset = &f->dynamics,
                               .forward = ratio > 0.0 ? 1.0 : -1.0};
    assert_int_equal(gm_trip_create(&f->parts, &f->trip, &error), GM_OK);
}

static void tear_down(fixture *f)
{
    gm_trip_destroy(f->trip);
    gm_gear_plan_destroy(f->plan);
    gm_cycle_destroy(f->cycle);
}

static double random_between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* Central differences of the whole system against its Jacobian; accounts stay out: their
 * rows are left empty, since nothing depends on them. */
static void check_jacobian(fixture *f, uint64_t *seed)
{
    gm_transient_system s = gm_trip_system(f->trip);
    double x[N_MAX], up[N_MAX], down[N_MAX], value[N_MAX * N_MAX];
    int n = s.n_states;
    double t = random_between(seed, 0.0, 190.0);
    for (int i = 0; i < GM_CAR_STATES; i++)
        x[i] = gm_car_typical[i] * random_between(seed, 0.1, 1.0);
    x[GM_CAR_STATES] = x[GM_CAR_DRUM_SPEED] + random_between(seed, -1.0, 1.0);
    x[GM_CAR_STATES + 1] = random_between(seed, -30.0, 30.0);
    x[GM_CAR_STATES + 2] = random_between(seed, -1e-2, 1e-2);
    assert_int_equal(s.jacobian(s.user, t, x, value), 0);
    for (int k = 0; k < n; k++) {
        double h = 1e-6 * (k < GM_CAR_STATES ? gm_car_typical[k] : 1e-2);
        double moved[N_MAX];
        memcpy(moved, x, sizeof moved);
        moved[k] = x[k] + h;
        assert_int_equal(s.rates(s.user, t, moved, up), 0);
        moved[k] = x[k] - h;
        assert_int_equal(s.rates(s.user, t, moved, down), 0);
        double exact[N_MAX] = {0.0};
        for (int e = s.column_start[k]; e < s.column_start[k + 1]; e++)
            exact[s.row[e]] = value[e];
        for (int i = 0; i < n; i++) {
            if (i >= GM_CAR_DYNAMIC && i < GM_CAR_STATES)
                continue;
            double slope = (up[i] - down[i]) / (2.0 * h);
            /* rounding of rates of 1e5 over h, and curvature of tanh over h */
            assert_true(fabs(exact[i] - slope) <=
                        1e-4 * fabs(slope) + 1e-10 * fabs(up[i]) / h + 1e-6);
        }
    }
}

static void jacobian_is_that_of_the_rates(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int with = 0; with < 2; with++) {
        fixture f;
        set_up(&f, "ece15", with ? 8.0 : -8.0, with ? 0.03 : 0.0, with);
        for (int i = 0; i < 200; i++)
            check_jacobian(&f, &seed);
        tear_down(&f);
    }
}

/* The car follows the cycle, and what the engine did is all accounted for. */
static void drives(const char *cycle, double ratio, double grade)
{
    fixture f;
    gm_error error;
    gm_transient *transient = NULL;
    gm_trip_view view;
    set_up(&f, cycle, ratio, grade, 1);
    gm_transient_system system = gm_trip_system(f.trip);
    gm_transient_options options = {.tolerance = 1e-6};
    assert_int_equal(gm_transient_create(&system, &options, &transient, &error), GM_OK);
    assert_int_equal(gm_transient_start(transient, 0.0, &error), GM_OK);
    double end = gm_cycle_duration(f.cycle), worst = 0.0;
    for (double t = 0.1; t <= end; t += 0.1) {
        assert_int_equal(gm_transient_advance(transient, t, &error), GM_OK);
        gm_trip_look(f.trip, t, gm_transient_state(transient), &view);
        worst = fmax(worst, fabs(view.speed - view.cycle_speed));
    }
    /* 2 km/h: what UN Regulation 83 allows a driver */
    assert_true(worst < 2.0 / 3.6);
    assert_true(fabs(view.speed) < 0.02);
    double rise = sin(atan(grade));
    assert_true(fabs(view.height - rise * view.distance) < 1e-4 * view.distance);
    assert_true(fabs(view.distance - gm_cycle_distance(f.cycle)) <
                0.01 * gm_cycle_distance(f.cycle));
    gm_transient_energy e = gm_transient_account(transient);
    assert_true(fabs(e.residual) < 1e-5 * e.through);
    /* the states of the account say the same as the solver's own account */
    assert_true(fabs(view.engine_work - e.work) < 1e-5 * e.through);
    double gearset_loss = view.gearset_work - view.gearset_stored;
    double lost = view.clutch_loss + view.damper_loss + view.road_loss + view.brake_loss +
                  gearset_loss;
    assert_true(fabs(lost - e.dissipated) < 1e-4 * e.through);
    assert_true(gearset_loss > 0.0 && view.brake_loss > 0.0 && view.clutch_loss > 0.0);
    gm_transient_destroy(transient);
    tear_down(&f);
}

static void the_car_drives_the_cycles(void **state)
{
    (void)state;
    drives("ece15", 8.0, 0.0);
    drives("ece15", -8.0, 0.0);
}

static void the_car_drives_up_and_down(void **state)
{
    (void)state;
    drives("ece15", 8.0, 0.04);
    drives("ece15", 8.0, -0.04);
}

static void no_memory_is_an_error(void **state)
{
    (void)state;
    fixture f;
    gm_error error;
    gm_trip *trip = NULL;
    gm_status status = GM_ERR_MEMORY;
    set_up(&f, "ece15", 8.0, 0.0, 1);
    for (int k = 1; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_trip_create(&f.parts, &trip, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !trip));
        assert_true(k < 40);
    }
    gm_trip_destroy(trip);
    tear_down(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(jacobian_is_that_of_the_rates),
        cmocka_unit_test(the_car_drives_the_cycles),
        cmocka_unit_test(the_car_drives_up_and_down),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
