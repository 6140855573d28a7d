/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/drag.h"
#include "model/power.h"

static const double rpm = GM_PI / 30.;

static void seals_of_a_35_mm_shaft(void **state)
{
    (void)state;
    gm_oil oil = {.nu_40 = 30.8e-6, .temperature = 353.15};
    double w = 2000. * rpm;
    double T = gm_seal_torque(GM_SEAL_ISO14179_2, 35e-3, &oil, w).value;
    check_close("ISO/TR 14179-2", T, 0.0899568, 1e-6);
    check_close("ISO/TR 14179-2 power", T * w, 18.8405, 1e-6);
    T = gm_seal_torque(GM_SEAL_ISO14179_1_FPM, 35e-3, &oil, w).value;
    check_close("FPM", T, 0.130795, 1e-6);
    T = gm_seal_torque(GM_SEAL_ISO14179_1_NBR, 35e-3, &oil, w).value;
    check_close("NBR", T, 0.085015, 1e-6);
    T = gm_seal_torque(GM_SEAL_LINKE, 35e-3, &oil, w).value;
    check_close("Linke power", T * w, 19.25706, 1e-6);
}

static void seals_hold_their_torque_at_rest(void **state)
{
    (void)state;
    gm_oil oil = {.nu_40 = 30.8e-6, .temperature = 353.15};
    for (int model = GM_SEAL_ISO14179_2; model <= GM_SEAL_LINKE; model++) {
        gm_speed_torque rest = gm_seal_torque((gm_seal_model)model, 35e-3, &oil, 0.);
        gm_speed_torque fast = gm_seal_torque((gm_seal_model)model, 35e-3, &oil, 500.);
        assert_true(rest.value > 0. && rest.value == fast.value && rest.d_speed == 0.);
    }
    /* Linke's line crosses zero at some 130 degC: no seal drives its shaft */
    oil.temperature = 273.15 + 150.;
    assert_true(gm_seal_torque(GM_SEAL_LINKE, 35e-3, &oil, 100.).value == 0.);
}

static void petroff_gaps(void **state)
{
    (void)state;
    gm_oil oil = {.eta = 0.0075, .nu = 9e-6};
    gm_speed_torque T = gm_petroff_torque(18e-3, 25e-3, 30e-6, &oil, 100.);
    check_close("needle gap", T.value, 0.02290221, 1e-6);
    check_close("slope", T.d_speed, T.value / 100., 1e-14);
    T = gm_petroff_torque(30e-3, 8e-3, 0.15e-3, &oil, 100.);
    check_close("synchroniser cone", T.value, 0.006785840, 1e-6);
    assert_true(gm_petroff_torque(30e-3, 8e-3, 0.15e-3, &oil, 0.).value == 0.);
}

static const gm_plates plates = {
    .n = 8, .r_i = 45e-3, .r_o = 60e-3, .h = 0.15e-3, .feed = (double)INFINITY};
static const gm_oil fluid = {.eta = 8e-3, .rho = 800.};

static void full_films_of_a_clutch(void **state)
{
    (void)state;
    gm_speed_torque T = gm_plates_drag(&plates, &fluid, 100.);
    check_close("eight gaps", T.value, 0.5937610, 1e-6);
    check_close("slope", T.d_speed, T.value / 100., 1e-14);
    assert_true(gm_plates_drag(&plates, &fluid, 0.).value == 0.);
}

static double drag_of_slip(const void *data, double w)
{
    return gm_plates_drag(data, &fluid, w).value;
}

/* Slip at which drag is largest, by thirds. */
static double slip_of_largest_drag(const gm_plates *p)
{
    double low = 1., high = 1000.;
    while (high - low > 1e-9 * high) {
        double a = low + (high - low) / 3., b = high - (high - low) / 3.;
        if (drag_of_slip(p, a) < drag_of_slip(p, b))
            low = a;
        else
            high = b;
    }
    return low;
}

/* Pressure in the gap, from the mean radial speed u = feed / (n 2 pi r h) at slip w:
 * p' = 12 (rho r w^2 / 40 - eta u / h^2), integrated from the inner to the outer rim. */
static double pressure_difference(const gm_plates *p, double w)
{
    double sum = 0., dr = (p->r_o - p->r_i) / 1000.;
    for (int i = 0; i < 1000; i++) {
        double r = p->r_i + (i + 0.5) * dr;
        double u = p->feed / (p->n * 2. * GM_PI * r * p->h);
        sum += 12. * (fluid.rho * r * w * w / 40. - fluid.eta * u / (p->h * p->h)) * dr;
    }
    return sum;
}

/* Drag is largest where the gaps throw out just what is fed, without any pressure from
 * outside; from there it falls. */
static void films_shrink_when_the_feed_is_thrown_out(void **state)
{
    (void)state;
    gm_plates fed = plates;
    fed.feed = 2e-3 / 60.;
    double w = slip_of_largest_drag(&fed);
    check_close("full slip", gm_plates_full_slip(&fed, &fluid), w, 1e-8);
    assert_true(isinf(gm_plates_full_slip(&plates, &fluid)));
    double scale = fluid.rho * w * w * fed.r_o * (fed.r_o - fed.r_i);
    assert_true(fabs(pressure_difference(&fed, w)) <= 1e-6 * scale);
    assert_true(drag_of_slip(&fed, 0.999 * w) == drag_of_slip(&plates, 0.999 * w));
    assert_true(drag_of_slip(&fed, 4. * w) < 0.3 * drag_of_slip(&fed, w));
    check_continuous("drag", drag_of_slip, &fed, 0.1 * w, 10. * w);
    for (double x = 0.1; x < 10.; x *= 1.3)
        check_slope("drag", drag_of_slip, &fed, x * w,
                    gm_plates_drag(&fed, &fluid, x * w).d_speed);
}

static const gm_oil thin_oil = {.nu = 30e-6, .rho = 850., .eta = 30e-6 * 850.};
static const gm_dip gear = {.R_p = 0.09, .b = 0.03, .h = 0.03, .V_0 = 1.7e-3};

/* Below, at the end of and above the blend: Re_c is 4712, 9425 and 18850. */
static void churning_in_both_regimes(void **state)
{
    (void)state;
    const double table[][3] = {{500., 0.0899504, 4.70979},
                               {1000., 0.203869, 21.3491},
                               {2000., 0.354956, 74.3418}};
    for (int i = 0; i < 3; i++) {
        double w = table[i][0] * rpm;
        double T = gm_churning_torque(&gear, &thin_oil, w).value;
        check_close("T", T, table[i][1], PRINTED);
        check_close("P", T * w, table[i][2], PRINTED);
    }
}

/* Re_c = 7500: half of each formula, so the mean of two pure powers of speed. */
static void churning_blends_between_regimes(void **state)
{
    (void)state;
    double per_w = gear.R_p * gear.b / thin_oil.nu;
    double w_6 = 6000. / per_w, w_9 = 9000. / per_w, w = 7500. / per_w;
    double slow = gm_churning_torque(&gear, &thin_oil, w_6).value * pow(w / w_6, 0.59);
    double fast = gm_churning_torque(&gear, &thin_oil, w_9).value * pow(w / w_9, 0.80);
    double T = gm_churning_torque(&gear, &thin_oil, w).value;
    check_close("T", T, 0.5 * (slow + fast), 1e-12);
}

static void churning_needs_a_dip_and_is_limited_by_the_gear(void **state)
{
    (void)state;
    gm_dip dip = gear;
    dip.h = 0.;
    assert_true(gm_churning_torque(&dip, &thin_oil, 100.).value == 0.);
    dip.h = -0.02;
    assert_true(gm_churning_torque(&dip, &thin_oil, 100.).value == 0.);
    dip.h = 0.18;
    double full = gm_churning_torque(&dip, &thin_oil, 100.).value;
    dip.h = 5.;
    assert_true(gm_churning_torque(&dip, &thin_oil, 100.).value == full);
    /* fully immersed: both faces and the rim, 2 pi R^2 + 2 pi R b, against C2's area */
    double area = 2. * GM_PI * 0.09 * (0.09 + 0.03) / 0.0101172;
    double depth = pow(0.18 / 0.03, 0.45);
    double part = gm_churning_torque(&gear, &thin_oil, 100.).value;
    check_close("area", full / part, area * depth, PRINTED);
}

typedef struct churning_point {
    gm_dip dip;
    gm_oil oil;
    double w;
} churning_point;

static double churning_of_w(const void *data, double w)
{
    const churning_point *p = data;
    return gm_churning_torque(&p->dip, &p->oil, w).value;
}

static double churning_of_h(const void *data, double h)
{
    churning_point p = *(const churning_point *)data;
    p.dip.h = h;
    return gm_churning_torque(&p.dip, &p.oil, p.w).value;
}

static churning_point random_point(uint64_t *seed)
{
    churning_point p = {.oil = {.rho = random_between(seed, 780., 900.)}};
    p.oil.nu = random_scale(seed, 4e-6, 1e-3);
    p.dip.R_p = random_between(seed, 0.02, 0.2);
    p.dip.b = random_between(seed, 0.01, 0.05);
    p.dip.h = 2. * p.dip.R_p * random_between(seed, 0.02, 1.2);
    p.dip.V_0 = random_scale(seed, 3e-4, 5e-3);
    p.w = random_scale(seed, 1e-3, 1500.);
    return p;
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 12;
    for (int i = 0; i < 3000; i++) {
        churning_point p = random_point(&seed);
        gm_speed_torque T = gm_churning_torque(&p.dip, &p.oil, p.w);
        assert_true(T.value > 0. && isfinite(T.d_speed));
        check_slope("T(w)", churning_of_w, &p, p.w, T.d_speed);
    }
}

static void churning_has_no_jumps_and_rises_with_depth(void **state)
{
    (void)state;
    uint64_t seed = 13;
    for (int i = 0; i < 10; i++) {
        churning_point p = random_point(&seed);
        check_continuous("T(w)", churning_of_w, &p, 1e-6, 3000.);
        check_continuous("T(h)", churning_of_h, &p, 1e-6, 3. * p.dip.R_p);
        for (int k = 1; k < 50; k++) {
            double h = 2. * p.dip.R_p * k / 50.;
            assert_true(churning_of_h(&p, h) > churning_of_h(&p, 0.9 * h));
        }
        gm_speed_torque rest = gm_churning_torque(&p.dip, &p.oil, 0.);
        assert_true(rest.value == 0. && isfinite(rest.d_speed) && rest.d_speed > 0.);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seals_of_a_35_mm_shaft),
        cmocka_unit_test(seals_hold_their_torque_at_rest),
        cmocka_unit_test(petroff_gaps),
        cmocka_unit_test(full_films_of_a_clutch),
        cmocka_unit_test(films_shrink_when_the_feed_is_thrown_out),
        cmocka_unit_test(churning_in_both_regimes),
        cmocka_unit_test(churning_blends_between_regimes),
        cmocka_unit_test(churning_needs_a_dip_and_is_limited_by_the_gear),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(churning_has_no_jumps_and_rises_with_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
