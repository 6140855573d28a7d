/* SPDX-License-Identifier: BSD-2-Clause */
#include "bearing_cases.h"

#include "model/bearing_models.h"

#include <stdio.h>

static const gm_oil oil = {.nu = 15e-6, .bearing_mu_ehl = 0.05};

/* The law cannot be made; the sentence contains the part, and *law is untouched. */
static void check_refused(gm_bearing_data data, const char *part)
{
    gm_bearing_law law, before;
    memset(&law, 7, sizeof law);
    memcpy(&before, &law, sizeof law);
    gm_error error = {0};
    assert_int_equal(gm_bearing_law_make(&data, &oil, &law, &error), GM_ERR_MODEL);
    assert_memory_equal(&law, &before, sizeof law);
    if (strstr(error.message, part) == NULL)
        fail_msg("\"%s\" lacks \"%s\"", error.message, part);
    assert_null(strchr(error.message, '\n'));
}

static void catalogue_has_6206(void **state)
{
    (void)state;
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .designation = "6206",
                            .f0 = 3.,
                            .f1 = (double)NAN};
    assert_int_equal(gm_bearing_data_complete(&data, NULL), GM_OK);
    check_close("d", data.d, 0.030, 1e-14);
    check_close("D", data.D, 0.062, 1e-14);
    check_close("B", data.B, 0.016, 1e-14);
    check_close("C0", data.C0, 11200., 1e-14);
    assert_string_equal(data.series, "62");
    /* Palmgren's f_0 is no matter of the catalogue */
    assert_true(data.f0 == 3. && isnan(data.f1));
}

/* ISO 15: from 04 on the last two digits times 5 are the bore in mm, 03 is 17 mm; the
 * series are known to the friction tables; larger series have larger outside diameters.
 */
static void catalogue_follows_the_designation_system(void **state)
{
    (void)state;
    static const char *const series[] = {"618", "619", "160", "60", "62", "63"};
    int found = 0;
    for (int bore = 3; bore <= 12; bore++) {
        double D = 0.;
        for (size_t i = 0; i < sizeof series / sizeof series[0]; i++) {
            gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL};
            sprintf(data.designation, "%s%02d", series[i], bore);
            if (gm_bearing_data_complete(&data, NULL) != GM_OK)
                continue;
            found++;
            check_close("d", data.d, bore == 3 ? 17e-3 : 5e-3 * bore, 1e-14);
            assert_true(data.D >= D && data.D > data.d && data.B < data.d);
            assert_true(data.C0 > 1e3);
            assert_string_equal(data.series, series[i]);
            D = data.D;
            const gm_skf_row *row;
            assert_int_equal(gm_skf_find(data.type, data.series, &row, NULL), GM_OK);
        }
    }
    assert_int_equal(found, 25);
}

static void unknown_designations_are_refused(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_DEEP_GROOVE_BALL, GM_FRICTION_SKF);
    strcpy(data.designation, "6206Z");
    check_refused(data, "no bearing \"6206Z\"; did you mean \"6206\"?");
    strcpy(data.designation, "XJ-900-special");
    check_refused(data, "give its dimensions");
    data.type = GM_BEARING_TAPERED_ROLLER;
    strcpy(data.designation, "30206");
    check_refused(data, "tapered roller bearing \"30206\"");
    gm_bearing_data before = data;
    assert_int_equal(gm_bearing_data_complete(&data, NULL), GM_ERR_MODEL);
    assert_memory_equal(&data, &before, sizeof data);
}

static void unknown_series_are_refused(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_DEEP_GROOVE_BALL, GM_FRICTION_SKF);
    strcpy(data.series, "62x");
    check_refused(data, "no series \"62x\" of deep groove ball bearings; did you mean");
    data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_SKF);
    strcpy(data.series, "something");
    check_refused(data, "302, 303, 313 X");
    data.series[0] = '\0';
    check_refused(data, "needs its series");
    data = bearing_of(GM_BEARING_CYLINDRICAL_ROLLER, GM_FRICTION_PALMGREN);
    strcpy(data.series, "all_full_kompl");
    check_refused(data, "no series \"all_full_kompl\" of cylindrical roller bearings");
    data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_SKF);
    data.series[0] = '\0';
    /* the longest list is not cut: the last name is in it */
    check_refused(data, "all_other");
}

static void missing_numbers_are_refused(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_DEEP_GROOVE_BALL, GM_FRICTION_SKF);
    data.D = 25e-3;
    check_refused(data, "bore_mm must be less than outer_mm; found 30 and 25");
    data.D = (double)NAN;
    check_refused(data, "a deep groove ball bearing with friction skf needs bore_mm and "
                        "outer_mm, or its designation");
    data = bearing_of(GM_BEARING_DEEP_GROOVE_BALL, GM_FRICTION_SKF);
    data.C0 = (double)NAN;
    check_refused(data,
                  "a deep groove ball bearing with friction skf needs static_load_N, "
                  "its static load rating C0");
    data.friction = GM_FRICTION_PALMGREN;
    check_refused(data, "a deep groove ball bearing with friction palmgren needs "
                        "static_load_N, its static load rating C0, or f1");
    data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_PALMGREN);
    data.Y = 0.;
    check_refused(data, "a tapered roller bearing with friction palmgren needs "
                        "axial_factor, its Y");
}

static void series_are_found_without_case_and_blanks(void **state)
{
    (void)state;
    const gm_skf_row *row, *same;
    assert_int_equal(gm_skf_find(GM_BEARING_TAPERED_ROLLER, "320 X", &row, NULL), GM_OK);
    assert_int_equal(gm_skf_find(GM_BEARING_TAPERED_ROLLER, "320x", &same, NULL), GM_OK);
    assert_ptr_equal(row, same);
}

/* Every row of the tables gives a law, with positive constants. */
static void every_series_gives_a_law(void **state)
{
    (void)state;
    for (int type = 0; type < 5; type++) {
        int n;
        const gm_skf_row *rows = gm_skf_rows((gm_bearing_type)type, &n);
        assert_true(n >= 7);
        for (int i = 0; i < n; i++) {
            gm_bearing_data data = bearing_of((gm_bearing_type)type, GM_FRICTION_SKF);
            strcpy(data.series, rows[i].series);
            gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
            assert_true(law.skf.k_rr > 0. && law.skf.k_sl > 0. && law.skf.rs > 0.);
            const gm_skf_row *row;
            assert_int_equal(gm_skf_find(data.type, data.series, &row, NULL), GM_OK);
            if (type != GM_BEARING_NEEDLE_ROLLER)
                assert_ptr_equal(row, &rows[i]);
        }
    }
}

static void support_alone_has_no_friction(void **state)
{
    (void)state;
    gm_bearing_data data = {.friction = GM_FRICTION_NONE};
    bearing_point p = {bearing_in_oil(data, 15., 0.05), 100., 1000., 1000.};
    gm_bearing_torque M = torque_at(&p);
    assert_true(M.value == 0. && M.d_speed == 0. && M.d_radial == 0. && M.d_axial == 0.);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(catalogue_has_6206),
        cmocka_unit_test(catalogue_follows_the_designation_system),
        cmocka_unit_test(unknown_designations_are_refused),
        cmocka_unit_test(unknown_series_are_refused),
        cmocka_unit_test(missing_numbers_are_refused),
        cmocka_unit_test(series_are_found_without_case_and_blanks),
        cmocka_unit_test(every_series_gives_a_law),
        cmocka_unit_test(support_alone_has_no_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
