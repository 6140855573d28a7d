/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The schema's tables agree with themselves, and docs/description.md with them.
 */
#include "model/gm_description.h"
#include "model/schema.h"

#include "common/schema_page.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define DOCS GM_SOURCE_DIR "/docs/description.md"

static void docs_have_the_schema(void **state)
{
    (void)state;
    schema_page_check(gm_description_help, DOCS, "description_fields.md");
}

static int count_fields(const gm_section *section)
{
    int n = 0;
    for (const gm_field *f = section->fields; f->key; f++)
        n += f->type == GM_FIELD_INLINE ? count_fields(f->section) : 1;
    return n;
}

static void check_field(const gm_section *section, const gm_field *f)
{
    if (f->type == GM_FIELD_NUMBER || f->type == GM_FIELD_INTEGER)
        assert_true(f->low <= f->high);
    if (f->type == GM_FIELD_CHOICE)
        assert_non_null(f->choices);
    if (f->need == GM_NEED_DEFAULT && f->type != GM_FIELD_GROUP)
        assert_non_null(f->fallback);
    if (f->type == GM_FIELD_ITEMS)
        assert_true(f->count_offset > 0 && f->section->size > 0);
    if (f->type == GM_FIELD_REFERENCE || f->type == GM_FIELD_REFERENCES)
        assert_non_null(f->section->collection);
    assert_true(f->help != NULL && section->help != NULL);
    /* keys say their unit in lower case with _, so that the suffix is found */
    assert_null(strpbrk(f->key, " -."));
}

static void check_section(const gm_section *section)
{
    const char *keys[GM_MAX_KEYS + 1];
    int n = gm_schema_keys(section, keys, GM_MAX_KEYS + 1);
    assert_true(n > 0 && n <= GM_MAX_KEYS);
    assert_int_equal(n, count_fields(section));
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(keys[i], keys[k]);
    for (const gm_field *f = section->fields; f->key; f++) {
        check_field(section, f);
        if (f->type == GM_FIELD_GROUP || f->type == GM_FIELD_ITEMS ||
            f->type == GM_FIELD_INLINE)
            check_section(f->section);
    }
}

static void tables_are_sound(void **state)
{
    (void)state;
    check_section(gm_schema_root());
}

static void units_follow_from_the_key(void **state)
{
    (void)state;
    static const struct {
        const char *key, *unit;
        double value, si;
    } cases[] = {
        {"width_mm", "mm", 30.0, 0.03},
        {"roughness_um", "um", 0.5, 0.5e-6},
        {"helix_deg", "deg", 180.0, 3.14159265358979323846},
        {"input_speed_max_rpm", "rpm", 30.0, 3.14159265358979323846},
        {"input_torque_max_Nm", "N.m", 250.0, 250.0},
        {"static_load_N", "N", 11200.0, 11200.0},
        {"radial_stiffness_N_um", "N/um", 300.0, 300e6},
        {"minimum_line_load_N_mm", "N/mm", 150.0, 150e3},
        {"inertia_kgm2", "kg.m2", 0.01, 0.01},
        {"mass_kg", "kg", 2.0, 2.0},
        {"density_15_kg_m3", "kg/m3", 845.0, 845.0},
        {"viscosity_40_mm2_s", "mm2/s", 30.8, 30.8e-6},
        {"temperature_degC", "degC", 80.0, 353.15},
        {"thermal_expansion_1_K", "1/K", 7e-4, 7e-4},
        {"volume_l", "l", 1.7, 1.7e-3},
        {"profile_shift", "", 0.1, 0.1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const gm_unit *unit = gm_schema_unit(cases[i].key);
        assert_string_equal(unit->name, cases[i].unit);
        /* one multiplication and one division of rounding */
        assert_true(fabs(gm_unit_to_si(unit, cases[i].value) - cases[i].si) <=
                    4e-16 * cases[i].si);
    }
}

static void expectations_are_sentences(void **state)
{
    (void)state;
    char text[256];
    const gm_field between = {.key = "x_mm",
                              .type = GM_FIELD_NUMBER,
                              .low = 0.0,
                              .high = 1.0,
                              .open = (gm_open)(GM_OPEN_LOW | GM_OPEN_HIGH)};
    gm_schema_expectation(&between, text, sizeof text);
    assert_string_equal(text, "a number in mm greater than 0 and less than 1");
    const gm_field whole = {
        .key = "n", .type = GM_FIELD_INTEGER, .low = -1.0, .high = 9.0};
    gm_schema_expectation(&whole, text, sizeof text);
    assert_string_equal(text, "a whole number from -1 to 9");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(docs_have_the_schema),
        cmocka_unit_test(tables_are_sound),
        cmocka_unit_test(units_follow_from_the_key),
        cmocka_unit_test(expectations_are_sentences),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
