/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Passport and page of a component from results of verifications.
 */
#include "bake/accuracy.h"
#include "bake/passport.h"

#include "base/alloc.h"
#include "example_map.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define GUID "{01234567-89ab-cdef-0123-456789abcdef}"

static const char steady_form[] =
    "{\"measured\": {\"map_hash\": \"%s\", \"description_sha256\": \"%s\", \"fmu_guid\": "
    "\"%s\"},\n\"points\": 100, \"seed\": 7, \"max_relative\": 0.0500, \"rms_relative\": "
    "1e-2,\n\"cases\": [{\"path\": \"odd\", \"gear\": 3, \"direction\": \"forward\", "
    "\"points\": 100, \"largest_loss_Nm\": 2, \"max_Nm\": 0.1, \"rms_Nm\": 0.02, "
    "\"max_relative\": 0.0500, \"rms_relative\": 1e-2, \"worst\": {\"speed_rpm\": 1000, "
    "\"torque_Nm\": -50}}], \"groups\": {}, \"elapsed_s\": 3}";

static const char cycle_form[] =
    "{\"measured\": {\"map_hash\": \"%s\", \"description_sha256\": \"%s\", \"fmu_guid\": "
    "\"%s\"},\n\"cycle\": \"hill\", \"duration_s\": 14, \"detailed\": {\"cpu_s\": 1, "
    "\"real_time_factor\": 14},\n\"reduced\": {\"fidelity\": \"rigid\", "
    "\"communication_step_s\": 0.001, \"cpu_s\": 0.1, \"real_time_factor\": 140}, "
    "\"cpu_saved\": 0.9, \"errors\": {\"loss_energy_relative\": 0.002}}";

typedef struct example {
    gm_map *map;
    char steady[1024], cycle[1024];
} example;

static example make_example(void)
{
    example e = {.map = example_map(2)};
    const gm_map *m = e.map;
    (void)snprintf(e.steady, sizeof e.steady, steady_form, m->content_hash,
                   m->input_sha256, GUID);
    (void)snprintf(e.cycle, sizeof e.cycle, cycle_form, m->content_hash, m->input_sha256,
                   GUID);
    return e;
}

static gm_status read(const example *e, gm_passport *passport, gm_error *error)
{
    const gm_bake_result results[] = {{"steady.json", e->steady},
                                      {"cycle.json", e->cycle}};
    return gm_passport_read(2, results, e->map, GUID, passport, error);
}

static gm_passport_component component_of(const example *e)
{
    return (gm_passport_component){e->map, GUID, "linear", "abc"};
}

/* The document of a passport; the caller destroys it. */
static json_t *document_of(const gm_passport *passport, const example *e)
{
    const gm_passport_component component = component_of(e);
    gm_buffer text = {0};
    json_t *root = NULL;
    gm_error error = {GM_OK, ""};
    gm_passport_write(passport, &component, &text);
    assert_false(text.failed);
    if (gm_document_read("passport.json", text.data, &root, &error) != GM_OK)
        fail_msg("%s", error.message);
    gm_buffer_clear(&text);
    return root;
}

static void the_document_has_every_result(void **state)
{
    (void)state;
    const example e = make_example();
    gm_passport passport;
    assert_int_equal(read(&e, &passport, NULL), GM_OK);
    json_t *root = document_of(&passport, &e);
    const json_t *steady = json_object_get(root, "steady");
    assert_true(gm_member_number(root, "passport") == 1.0);
    assert_string_equal(gm_member_text(json_object_get(root, "fmu"), "guid"), GUID);
    assert_true(gm_member_number(steady, "max_relative") == 0.05);
    assert_null(json_object_get(steady, "elapsed_s")); /* times differ */
    const json_t *cycles = json_object_get(root, "cycles");
    const json_t *runs = json_object_get(json_array_get(cycles, 0), "reduced");
    const json_t *run = json_array_get(runs, 0);
    assert_string_equal(gm_member_text(run, "fidelity"), "rigid");
    assert_true(gm_member_number(run, "cpu_saved") == 0.9);
    assert_non_null(json_object_get(run, "errors"));
    assert_int_equal(json_array_size(cycles), 1);
    assert_int_equal(json_array_size(runs), 1);
    json_decref(root);
    gm_passport_clear(&passport);
    gm_map_destroy(e.map);
}

static void without_results_nothing_was_measured(void **state)
{
    (void)state;
    const example e = make_example();
    gm_passport passport;
    gm_buffer page = {0};
    assert_int_equal(gm_passport_read(0, NULL, e.map, GUID, &passport, NULL), GM_OK);
    json_t *root = document_of(&passport, &e);
    assert_true(json_is_null(json_object_get(root, "steady")));
    assert_int_equal(json_array_size(json_object_get(root, "cycles")), 0);
    gm_accuracy_write(&passport, &page);
    assert_non_null(strstr(page.data, "Not measured"));
    gm_buffer_clear(&page);
    json_decref(root);
    gm_passport_clear(&passport);
    gm_map_destroy(e.map);
}

static void texts_that_are_no_utf8_become_so(void **state)
{
    (void)state;
    const example e = make_example();
    gm_passport passport;
    memcpy(e.map->title, "\xff \x01 \"\\ \xc3\xa4", 10);
    assert_int_equal(read(&e, &passport, NULL), GM_OK);
    json_t *root = document_of(&passport, &e);
    assert_string_equal(gm_member_text(json_object_get(root, "model"), "title"),
                        "\xef\xbf\xbd \x01 \"\\ \xc3\xa4");
    json_decref(root);
    gm_passport_clear(&passport);
    gm_map_destroy(e.map);
}

static void the_page_names_the_communication_step(void **state)
{
    (void)state;
    const example e = make_example();
    gm_passport passport;
    gm_buffer page = {0};
    assert_int_equal(read(&e, &passport, NULL), GM_OK);
    gm_accuracy_write(&passport, &page);
    assert_non_null(strstr(page.data, ">rigid (CS, 1 ms)</th>"));
    assert_non_null(strstr(page.data, ">5 %</td>"));      /* max of the only gear */
    assert_non_null(strstr(page.data, ">1000 rpm</td>")); /* and where */
    gm_buffer_clear(&page);
    gm_passport_clear(&passport);
    gm_map_destroy(e.map);
}

static void results_of_others_are_refused(void **state)
{
    (void)state;
    example e = make_example();
    gm_passport passport = {.n = -1};
    gm_error error = {GM_OK, ""};
    e.map->content_hash[0] = e.map->content_hash[0] == '0' ? '1' : '0';
    assert_int_equal(read(&e, &passport, &error), GM_ERR_MODEL);
    assert_non_null(strstr(error.message, "steady.json: was measured with another map"));
    assert_int_equal(passport.n, -1);
    gm_map_destroy(e.map);
    e = make_example();
    const gm_bake_result result = {"steady.json", e.steady};
    assert_int_equal(gm_bake_check_result(&result, e.map, GUID, NULL), GM_OK);
    assert_int_equal(gm_bake_check_result(&result, e.map, "{}", &error), GM_ERR_MODEL);
    assert_non_null(strstr(error.message, "another component of this map"));
    gm_map_destroy(e.map);
}

static void no_memory(void **state)
{
    (void)state;
    const example e = make_example();
    const gm_passport_component component = component_of(&e);
    gm_passport passport;
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status != GM_OK; k++) {
        assert_int_equal(status, GM_ERR_MEMORY);
        gm_alloc_fail_after(k);
        status = read(&e, &passport, NULL);
    }
    for (long k = 1; k < 4; k++) {
        gm_buffer text = {0}, page = {0};
        gm_alloc_fail_after(k);
        gm_passport_write(&passport, &component, &text);
        gm_alloc_fail_after(k);
        gm_accuracy_write(&passport, &page);
        gm_alloc_fail_after(0);
        assert_true(text.failed && page.failed);
        gm_buffer_clear(&text);
        gm_buffer_clear(&page);
    }
    gm_passport_clear(&passport);
    gm_map_destroy(e.map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_document_has_every_result),
        cmocka_unit_test(without_results_nothing_was_measured),
        cmocka_unit_test(texts_that_are_no_utf8_become_so),
        cmocka_unit_test(the_page_names_the_communication_step),
        cmocka_unit_test(results_of_others_are_refused),
        cmocka_unit_test(no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
