/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gm_tables.h: what the C compiler makes of it is the map, bit for bit.
 */
#include "bake/tables.h"

#include "bake/compile.h"
#include "base/alloc.h"
#include "example_map.h"

#include <dlfcn.h>
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void same_axis(const gm_axis *a, const gm_axis *b)
{
    assert_int_equal(a->n, b->n);
    assert_memory_equal(a->x, b->x, (size_t)a->n * sizeof *a->x);
}

static void same1(const gm_table1 *a, const gm_table1 *b)
{
    assert_int_equal(a->value != NULL, b->value != NULL);
    if (!a->value)
        return;
    same_axis(&a->x, &b->x);
    assert_memory_equal(a->value, b->value, (size_t)a->x.n * sizeof *a->value);
}

static void same2(const gm_table2 *a, const gm_table2 *b)
{
    same_axis(&a->x, &b->x);
    same_axis(&a->y, &b->y);
    assert_memory_equal(a->value, b->value,
                        (size_t)a->x.n * (size_t)a->y.n * sizeof *a->value);
}

static void same3(const gm_table3 *a, const gm_table3 *b)
{
    assert_int_equal(a->value != NULL, b->value != NULL);
    if (!a->value)
        return;
    same_axis(&a->x, &b->x);
    same_axis(&a->y, &b->y);
    same_axis(&a->z, &b->z);
    assert_memory_equal(a->value, b->value,
                        (size_t)a->x.n * (size_t)a->y.n * (size_t)a->z.n *
                            sizeof *a->value);
}

static void same_path(const gm_path *a, const gm_path *b)
{
    assert_true(a->inertia == b->inertia);
    assert_true(a->sync_torque == b->sync_torque ||
                (a->sync_torque == 1e30 && isinf(b->sync_torque)));
    assert_int_equal(a->n_gears, b->n_gears);
    assert_int_equal(a->n_lines, b->n_lines);
    for (int d = 0; d < 2; d++) {
        for (int g = 0; g < a->n_gears; g++) {
            assert_int_equal(a->gears[g].number, b->gears[g].number);
            assert_true(a->gears[g].ratio == b->gears[g].ratio);
            assert_true(a->gears[g].inertia_extra == b->gears[g].inertia_extra);
            same2(&a->gears[g].load_loss[d], &b->gears[g].load_loss[d]);
            assert_true(a->gears[g].stiffness == b->gears[g].stiffness);
            assert_true(a->gears[g].damping == b->gears[g].damping);
            assert_true(a->gears[g].loose_damping == b->gears[g].loose_damping);
            assert_true(a->gears[g].lash == b->gears[g].lash);
            assert_true(a->gears[g].film == b->gears[g].film);
            same1(&a->gears[g].pin[d], &b->gears[g].pin[d]);
        }
        for (int l = 0; l < a->n_lines; l++) {
            assert_true(a->lines[l].ratio == b->lines[l].ratio);
            same1(&a->lines[l].jump[d], &b->lines[l].jump[d]);
        }
        for (int e = 0; e < 2; e++) {
            same2(&a->drag[d][e], &b->drag[d][e]);
            same2(&a->reaction[d][e], &b->reaction[d][e]);
        }
    }
}

static void same_map(const gm_reduced_map *a, const gm_reduced_map *b)
{
    assert_int_equal(a->n_paths, b->n_paths);
    assert_int_equal(a->n_configurations, b->n_configurations);
    assert_true(a->inertia_output == b->inertia_output);
    assert_true(a->oil_temperature == b->oil_temperature);
    for (int p = 0; p < a->n_paths; p++)
        same_path(&a->path[p], &b->path[p]);
    for (int i = 0; i < a->n_configurations; i++) {
        const gm_configuration *c = &a->configurations[i], *d = &b->configurations[i];
        assert_int_equal(c->gear[0], d->gear[0]);
        assert_int_equal(c->gear[1], d->gear[1]);
        for (int k = 0; k < 2; k++) {
            same1(&c->parasitic[k], &d->parasitic[k]);
            same3(&c->both_loaded[k], &d->both_loaded[k]);
        }
    }
    same1(&a->coupling, &b->coupling);
}

static void write_text(const char *folder, const char *name, const char *text)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* Compile the tables into a library of one function and load it. */
static void *load(const char *folder, const char *tables)
{
    static const char *const files[] = {"core/gm_reduced.h", "core/gm_interp.h",
                                        "core/gm_real.h", "core/gm_config.h"};
    const char *source = "unit.c";
    char command[64], path[512];
    gm_compiler compiler;
    gm_error error;
    write_text(folder, "gm_tables.h", tables);
    write_text(
        folder, "unit.c",
        "#include \"gm_tables.h\"\n"
        "__attribute__((visibility(\"default\"))) const gm_reduced_map *map(void);\n"
        "const gm_reduced_map *map(void) { return &gm_tables_map; }\n");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        snprintf(path, sizeof path, GM_SOURCE_DIR "/src/%s", files[i]);
        snprintf(command, sizeof command, "%s", strrchr(files[i], '/') + 1);
        char target[600];
        snprintf(target, sizeof target, "%s/%s", folder, command);
        assert_int_equal(symlink(path, target), 0);
    }
    if (gm_compiler_find(NULL, &compiler, &error) != GM_OK ||
        gm_compile(&compiler, folder, 1, &source, "unit.so", &error) != GM_OK)
        fail_msg("%s", error.message);
    snprintf(path, sizeof path, "%s/unit.so", folder);
    void *library = dlopen(path, RTLD_NOW);
    assert_non_null(library);
    return library;
}

/* A folder in the build tree that the tests of this program share and empty. */
static void remove_all(const char *folder)
{
    static const char *const names[] = {"gm_tables.h",  "unit.c",      "unit.so",
                                        "gm_reduced.h", "gm_interp.h", "gm_real.h",
                                        "gm_config.h"};
    char path[512];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    assert_int_equal(rmdir(folder), 0);
}

static void compiled_tables_are_the_map(void **state)
{
    (void)state;
    for (int n_paths = 1; n_paths <= 2; n_paths++) {
        char folder[] = "/tmp/test_tables-XXXXXX";
        const gm_reduced_map *(*function)(void);
        gm_map_view *view;
        gm_error error;
        gm_buffer text = {0};
        gm_map *map = example_map(n_paths);
        /* values that lose bits in any other way of writing: */
        map->tables[0].value[1] = 0.1 + 0.2;
        map->tables[0].value[2] = 4.9e-324;
        map->tables[0].value[3] = -1.0 / 3.0 * 1e-12;
        assert_non_null(mkdtemp(folder));
        assert_int_equal(gm_map_view_create(map, &view, &error), GM_OK);
        const gm_reduced_map *reduced = gm_map_view_reduced(view);
        assert_int_equal(gm_tables_write(map, reduced, "{0}", &text, &error), GM_OK);
        void *library = load(folder, text.data);
        void *symbol = dlsym(library, "map");
        memcpy(&function, &symbol, sizeof symbol);
        same_map(function(), reduced);
        dlclose(library);
        remove_all(folder);
        gm_buffer_clear(&text);
        gm_map_view_destroy(view);
        gm_map_destroy(map);
    }
}

static void equal_arrays_are_written_once(void **state)
{
    gm_map_view *view;
    gm_error error;
    gm_buffer text = {0};
    gm_map *map = example_map(2);
    int n = 0;
    (void)state;
    assert_int_equal(gm_map_view_create(map, &view, &error), GM_OK);
    assert_int_equal(
        gm_tables_write(map, gm_map_view_reduced(view), "{0}", &text, &error), GM_OK);
    for (const char *at = text.data; (at = strstr(at, "static const gm_real")); at++)
        n++;
    /* axes: path speed, torque, output speed, relative speed; values: D, N forward and
       backward, R likewise, two jumps, P, X, C, pins of the gears where they differ */
    assert_int_equal(n, 18);
    gm_buffer_clear(&text);
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static void numbers_do_not_follow_the_locale(void **state)
{
    char text[GM_NUMBER_TEXT];
    (void)state;
    assert_string_equal(gm_number_text(-1234.5, 17, text), "-1234.5");
    if (!setlocale(LC_NUMERIC, "de_DE.UTF-8"))
        skip(); /* no such locale here */
    gm_number_text(-1234.5, 17, text);
    setlocale(LC_NUMERIC, "C");
    assert_string_equal(text, "-1234.5");
}

static void written_numbers_read_back_to_the_same_bits(void **state)
{
    uint64_t seed = 1;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        char text[GM_NUMBER_TEXT];
        double x, y;
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        memcpy(&x, &seed, sizeof x);
        if (!isfinite(x))
            continue;
        y = strtod(gm_number_text(x, 17, text), NULL);
        assert_memory_equal(&x, &y, sizeof x);
    }
}

static void a_failed_allocation_is_an_error_and_leaves_nothing(void **state)
{
    gm_map_view *view;
    gm_error error;
    gm_map *map = example_map(2);
    gm_status status = GM_ERR_MEMORY;
    int k = 1;
    (void)state;
    assert_int_equal(gm_map_view_create(map, &view, &error), GM_OK);
    for (; status != GM_OK && k < 1000; k++) {
        gm_buffer text = {0};
        gm_alloc_fail_after(k);
        status = gm_tables_write(map, gm_map_view_reduced(view), "{0}", &text, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        gm_buffer_clear(&text);
    }
    assert_true(k > 3 && status == GM_OK);
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compiled_tables_are_the_map),
        cmocka_unit_test(equal_arrays_are_written_once),
        cmocka_unit_test(numbers_do_not_follow_the_locale),
        cmocka_unit_test(written_numbers_read_back_to_the_same_bits),
        cmocka_unit_test(a_failed_allocation_is_an_error_and_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
