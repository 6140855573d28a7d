/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "vehicle/driver.h"

#include <math.h>
#include <string.h>

static double random_between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* Road load of the reference car, computed from its coefficients by hand:
 * 0.009 x 1416 x 9.81 + 0.5 x 1.2 x 0.6078 v2. */
static void road_load_has_known_values(void **state)
{
    (void)state;
    gm_vehicle car = gm_vehicle_reference();
    double slope;
    assert_true(fabs(gm_road_load(&car, 50.0 / 3.6, &slope) - 195.366) < 0.01);
    assert_true(fabs(gm_road_load(&car, 120.0 / 3.6, &slope) - 530.219) < 0.01);
    assert_true(gm_road_load(&car, 0.0, &slope) == 0.0);
    car.drag_area = 0.60775; /* and with this: worked examples of seven digits */
    const double table[][2] = {{15., 131.3494},
                               {32., 153.8305},
                               {50., 195.3601},
                               {100., 406.3844},
                               {120., 530.1853}};
    for (int i = 0; i < 5; i++) {
        double load = gm_road_load(&car, table[i][0] / 3.6, &slope);
        assert_true(fabs(load / table[i][1] - 1.0) < 1e-6);
    }
    assert_true(fabs(gm_road_load(&car, -10.0, &slope) +
                     gm_road_load(&car, 10.0, &slope)) < 1e-12);
}

static void engine_keeps_its_limits(void **state)
{
    (void)state;
    gm_vehicle car = gm_vehicle_reference();
    double d, dw;
    assert_true(gm_engine_target(&car, 1e4, 200.0, &d, &dw) == 200.0 && d == 0.0);
    assert_true(fabs(gm_engine_target(&car, -1e4, 200.0, &d, &dw) + 16.0) < 1e-9);
    assert_true(gm_engine_target(&car, 50.0, 200.0, &d, &dw) == 50.0 && d == 1.0);
    assert_true(fabs(gm_engine_target(&car, -50.0, 70.0, &d, &dw) - 25.0) < 1e-9);
    assert_true(fabs(gm_engine_target(&car, 500.0, 0.0, &d, &dw) - 100.0) < 1e-9);
    assert_true(gm_clutch_capacity(&car, 80.0, &d) == 0.0);
    assert_true(fabs(gm_clutch_capacity(&car, 132.0, &d) - 100.0) < 1e-9);
    assert_true(gm_clutch_capacity(&car, 400.0, &d) == 300.0);
}

/* By hand, engine at 132 rad/s (capacity 100 N.m) with 12 N.m: without slip all of it; at
 * a slip of 30 rad/s the smaller of 100 and 13 + 30/2, rounded off, and next to nothing
 * of the rest. */
static void clutch_holds_what_a_shift_needs(void **state)
{
    (void)state;
    gm_vehicle car = gm_vehicle_reference();
    double held = 100.0 * 28.0 / sqrt(100.0 * 100.0 + 28.0 * 28.0);
    assert_true(fabs(gm_clutch_grip_at(&car, 132.0, 12.0, 0.0).value - 100.0) < 1e-9);
    assert_true(fabs(gm_clutch_grip_at(&car, 132.0, 12.0, 30.0).value -
                     (held + (100.0 - held) / 901.0)) < 1e-9);
    assert_true(gm_clutch_grip_at(&car, 80.0, 12.0, 10.0).value == 0.0);
}

/* Central differences: curvature over 1e-4 of a width of 1 rad/s. */
static void derivatives_of_the_grip_are_exact(void **state)
{
    uint64_t seed = 5;
    gm_vehicle car = gm_vehicle_reference();
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const double h = 1e-4, w = random_between(&seed, 83.0, 160.0);
        const double torque = random_between(&seed, -40.0, 200.0);
        const double slip = random_between(&seed, -60.0, 60.0);
        const gm_clutch_grip grip = gm_clutch_grip_at(&car, w, torque, slip);
        const double by[3] = {
            gm_clutch_grip_at(&car, w + h, torque, slip).value -
                gm_clutch_grip_at(&car, w - h, torque, slip).value,
            gm_clutch_grip_at(&car, w, torque + h, slip).value -
                gm_clutch_grip_at(&car, w, torque - h, slip).value,
            gm_clutch_grip_at(&car, w, torque, slip + h).value -
                gm_clutch_grip_at(&car, w, torque, slip - h).value,
        };
        assert_true(fabs(by[0] / (2.0 * h) - grip.by_w) < 1e-5);
        assert_true(fabs(by[1] / (2.0 * h) - grip.by_torque) < 1e-5);
        assert_true(fabs(by[2] / (2.0 * h) - grip.by_slip) < 1e-4);
    }
}

static gm_driver_view random_view(uint64_t *seed)
{
    return (gm_driver_view){.v_ref = random_between(seed, 0.0, 2.0),
                            .a_ref = random_between(seed, -1.0, 1.0),
                            .v = random_between(seed, -0.5, 2.5),
                            .integral = random_between(seed, -8.0, 8.0),
                            .w_engine = random_between(seed, 60.0, 400.0),
                            .ratio = random_between(seed, 3.0, 17.0),
                            .hill = random_between(seed, -2e3, 2e3)};
}

static int near(double exact, double difference, double scale)
{
    return fabs(exact - difference) <= 1e-5 * scale + 1e-5 * fabs(exact);
}

/* Central differences; scale: their rounding, from forces of 1e4 N. */
static void derivatives_are_exact(void **state)
{
    (void)state;
    gm_vehicle car = gm_vehicle_reference();
    uint64_t seed = 7;
    for (int i = 0; i < 2000; i++) {
        gm_driver_view at = random_view(&seed), up = at, down = at;
        gm_driver_act a = gm_driver(&car, &at);
        const double h = 1e-6;
        up.v += h, down.v -= h;
        gm_driver_act u = gm_driver(&car, &up), d = gm_driver(&car, &down);
        assert_true(near(a.torque_v, (u.torque - d.torque) / (2 * h), 1e3));
        assert_true(near(a.brake_v, (u.brake - d.brake) / (2 * h), 1e4));
        up = down = at;
        up.integral += h, down.integral -= h;
        u = gm_driver(&car, &up), d = gm_driver(&car, &down);
        assert_true(near(a.torque_i, (u.torque - d.torque) / (2 * h), 1e3));
        assert_true(near(a.brake_i, (u.brake - d.brake) / (2 * h), 1e4));
        assert_true(near(a.rate_i, (u.integral_rate - d.integral_rate) / (2 * h), 1.0));
        up = down = at;
        up.w_engine += h, down.w_engine -= h;
        u = gm_driver(&car, &up), d = gm_driver(&car, &down);
        assert_true(near(a.brake_w, (u.brake - d.brake) / (2 * h), 1e4));
    }
}

static void a_standing_cycle_asks_for_nothing_but_the_brake(void **state)
{
    (void)state;
    gm_vehicle car = gm_vehicle_reference();
    gm_driver_view stands = {.integral = 3.0, .w_engine = 80.0, .ratio = 16.7};
    gm_driver_act a = gm_driver(&car, &stands);
    assert_true(a.torque == 0.0 && a.brake == 0.0 && a.integral_rate < 0.0);
    stands.v = 0.5; /* rolls on */
    a = gm_driver(&car, &stands);
    assert_true(a.torque == 0.0 && a.brake > 1000.0);
    stands = (gm_driver_view){.w_engine = 80.0, .ratio = 16.7, .hill = 800.0};
    a = gm_driver(&car, &stands); /* carries the hill and no more */
    assert_true(a.torque == 0.0 && a.brake == -800.0);
}

static void a_vehicle_with_a_wrong_number_is_refused(void **state)
{
    (void)state;
    gm_vehicle car = gm_vehicle_reference();
    gm_error error;
    assert_int_equal(gm_vehicle_check(&car, &error), GM_OK);
    car.wheel_radius = 0.0;
    assert_int_equal(gm_vehicle_check(&car, &error), GM_ERR_ARGUMENT);
    assert_non_null(strstr(error.message, "wheel_radius"));
    car = gm_vehicle_reference();
    car.flywheel_damping = (double)NAN;
    assert_int_equal(gm_vehicle_check(&car, &error), GM_ERR_ARGUMENT);
    car = gm_vehicle_reference();
    car.full_load.point[1].speed = 0.0;
    assert_int_equal(gm_vehicle_check(&car, &error), GM_ERR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(road_load_has_known_values),
        cmocka_unit_test(engine_keeps_its_limits),
        cmocka_unit_test(clutch_holds_what_a_shift_needs),
        cmocka_unit_test(derivatives_of_the_grip_are_exact),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(a_standing_cycle_asks_for_nothing_but_the_brake),
        cmocka_unit_test(a_vehicle_with_a_wrong_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
