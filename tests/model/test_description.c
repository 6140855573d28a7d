/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The description reader: the example as the values that its file states, files that are
 * no descriptions, and memory running out at every allocation.
 */
#include "description_fixture.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "model/check.h"
#include "model/gm_description.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define BAD GM_SOURCE_DIR "/tests/model/bad/"
#define CHANGED GM_BINARY_DIR "/test_description_changed.yaml"
#define PI 3.14159265358979323846

static const gm_wheel *wheel(const gm_description *d, const char *name)
{
    for (int i = 0; i < d->n_wheels; i++)
        if (strcmp(d->wheels[i].id.name, name) == 0)
            return &d->wheels[i];
    fail_msg("no gear %s", name);
    return NULL;
}

static const gm_bearing *bearing(const gm_description *d, const char *name)
{
    for (int i = 0; i < d->n_bearings; i++)
        if (strcmp(d->bearings[i].id.name, name) == 0)
            return &d->bearings[i];
    fail_msg("no bearing %s", name);
    return NULL;
}

/* One rounding more than the literal: units are one multiplication and one division. */
static void near(double value, double expected)
{
    assert_true(fabs(value - expected) <= 2.0 * DBL_EPSILON * fabs(expected));
}

static void example_has_the_values_of_its_file(void **state)
{
    (void)state;
    gm_description *d = gm_test_read(EXAMPLE);
    char sha[GM_SHA256_TEXT];
    assert_int_equal(gm_sha256_file(EXAMPLE, sha, NULL), GM_OK);
    assert_string_equal(d->sha256, sha);
    assert_string_equal(d->file, EXAMPLE);
    assert_string_equal(d->name, "dct7");
    assert_int_equal(d->format, 1);
    near(d->speed_max, 6500.0 * PI / 30.0);
    near(d->torque_max, 250.0);
    near(d->oil.viscosity_40, 30.8e-6);
    near(d->oil.density_15, 845.0);
    near(d->oil.temperature, 353.15);
    near(d->oil.level, -0.2028);
    near(d->oil.volume, 1.7e-3);
    assert_int_equal(d->n_shafts, 7);
    assert_int_equal(d->n_wheels, 20);
    assert_int_equal(d->n_meshes, 12);
    assert_int_equal(d->n_bearings, 15);
    assert_string_equal(d->shafts[d->output].id.name, "differential");
    near(d->shafts[d->output].inertia, 0.008);
    assert_true(isnan(d->shafts[0].inertia) && isnan(d->shafts[0].mass));
    assert_int_equal(d->shafts[1].n_segments, 4);
    near(d->shafts[1].segments[3].bore, 0.0254);
    gm_description_destroy(d);
}

static void example_gears_and_bearings_are_complete(void **state)
{
    (void)state;
    gm_description *d = gm_test_read(EXAMPLE);
    const gm_wheel *g = wheel(d, "g1_driven");
    assert_int_equal(g->teeth, 64);
    near(g->normal_module, 1.75e-3);
    near(g->helix, -27.632888 * PI / 180.0);
    near(g->pressure_angle, 20.0 * PI / 180.0);
    near(g->roughness, 0.5e-6);
    near(g->position, 0.25);
    assert_true(g->idles && !g->internal && g->churning == GM_CHURNING_CHANGENET_VELEX);
    near(g->bore, 0.042);                    /* outer diameter of its needle bearing */
    near(wheel(d, "g1_drive")->bore, 0.028); /* diameter of its shaft */
    near(wheel(d, "ring")->bore, 0.110);     /* given */
    assert_int_equal(g->bearing.type, GM_BEARING_NEEDLE_ROLLER);
    assert_int_equal(g->bearing.friction, GM_FRICTION_SKF);
    const gm_bearing *b = bearing(d, "input_odd_rear");
    near(b->data.d, 0.030);
    near(b->data.D, 0.072);
    near(b->data.C0, 16000.0);
    assert_string_equal(b->data.series, "63");
    assert_true(b->locating && b->on == GM_HOUSING);
    near(b->radial_stiffness, 300e6);
    assert_int_equal(bearing(d, "input_odd_pilot")->data.friction, GM_FRICTION_NONE);
    assert_string_equal(d->shafts[bearing(d, "reverse_idler_rear")->on].id.name,
                        "output_2");
    near(d->meshes[0].minimum_line_load, 150e3);
    assert_int_equal(d->meshes[0].loss, GM_MESH_TEMPERATURE_DEPENDENT);
    gm_description_destroy(d);
}

static void paths_are_ordered(void **state)
{
    (void)state;
    static const int even[] = {-1, 2, 4, 6}, odd[] = {1, 3, 5, 7};
    char *text = gm_test_slurp(EXAMPLE);
    /* even first in the file, and its gears out of order */
    char *a = gm_test_replaced(text, "\n  odd:\n", "\n  swap:\n");
    char *b = gm_test_replaced(a, "\n  even:\n", "\n  odd:\n");
    char *c = gm_test_replaced(b, "\n  swap:\n", "\n  even:\n");
    gm_test_spill(CHANGED, c);
    gm_error error = {GM_OK, ""};
    gm_description *d = NULL;
    assert_int_equal(gm_description_read(EXAMPLE, &d, &error), GM_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(d->paths[0].gears[i].number, odd[i]);
        assert_int_equal(d->paths[1].gears[i].number, even[i]);
    }
    near(d->paths[1].gears[0].ratio, -17.402);
    assert_string_equal(d->shafts[d->paths[0].shaft].id.name, "input_odd");
    gm_description_destroy(d);
    d = gm_test_read(CHANGED);
    assert_string_equal(d->paths[0].id.name, "odd");
    assert_string_equal(d->shafts[d->paths[0].shaft].id.name, "input_even");
    assert_int_equal(d->paths[0].gears[0].number, -1);
    gm_description_destroy(d);
    free(a);
    free(b);
    free(c);
    free(text);
}

/* Root circles and tip circles of gears in one plane that do not mesh must not touch. */
static int meshes(const gm_description *d, int a, int b)
{
    for (int i = 0; i < d->n_meshes; i++) {
        const int *w = d->meshes[i].wheel;
        if ((w[0] == a && w[1] == b) || (w[0] == b && w[1] == a))
            return 1;
    }
    return 0;
}

static double tip_radius(const gm_wheel *w)
{
    return 0.5 * w->teeth * w->normal_module / cos(w->helix) +
           w->normal_module * (1.0 + w->profile_shift);
}

static void example_gears_do_not_collide(void **state)
{
    (void)state;
    gm_description *d = gm_test_read(EXAMPLE);
    int compared = 0;
    for (int a = 0; a < d->n_wheels; a++)
        for (int b = 0; b < a; b++) {
            const gm_wheel *p = &d->wheels[a], *q = &d->wheels[b];
            double overlap =
                0.5 * (p->width + q->width) - fabs(p->position - q->position);
            double distance = gm_shaft_distance(d, p->shaft, q->shaft);
            if (distance < 1e-3 || overlap <= 0.0 || meshes(d, a, b))
                continue;
            compared++;
            if (distance < tip_radius(p) + tip_radius(q) + 1e-3)
                fail_msg("%s touches %s", p->id.name, q->id.name);
        }
    assert_true(compared >= 4); /* final drives and the planes with three gears */
    gm_description_destroy(d);
}

/* What a shaft touches: every gear passes every other shaft. */
static void example_gears_pass_the_other_shafts(void **state)
{
    (void)state;
    gm_description *d = gm_test_read(EXAMPLE);
    for (int a = 0; a < d->n_wheels; a++)
        for (int s = 0; s < d->n_shafts; s++) {
            const gm_wheel *w = &d->wheels[a];
            double distance = gm_shaft_distance(d, w->shaft, s);
            const gm_segment *at = gm_shaft_segment(&d->shafts[s], w->position);
            if (distance < 1e-3 || !at)
                continue;
            double reach = tip_radius(w) + 0.5 * at->diameter;
            if (distance >= reach)
                continue;
            /* only a mate's own shaft may be nearer: its pinion is cut on it */
            int mate = 0;
            for (int b = 0; b < d->n_wheels; b++)
                mate |= d->wheels[b].shaft == s && meshes(d, a, b);
            if (!mate)
                fail_msg("%s touches shaft %s", w->id.name, d->shafts[s].id.name);
        }
    gm_description_destroy(d);
}

typedef struct file_case {
    const char *name;
    const char *message; /* after the path */
    gm_status status;
} file_case;

static const file_case files[] = {
    {"alias.yaml",
     ":2: anchors, aliases and tags (& * !) are not allowed in a description",
     GM_ERR_FORMAT},
    {"anchor.yaml",
     ":1: anchors, aliases and tags (& * !) are not allowed in a description",
     GM_ERR_FORMAT},
    {"tag.yaml", ":1: anchors, aliases and tags (& * !) are not allowed in a description",
     GM_ERR_FORMAT},
    {"binary.yaml", ":2: not a text file; found the byte 0x00, expected YAML in UTF-8",
     GM_ERR_FORMAT},
    {"not_utf8.yaml", ":2: not a text file; found the byte 0xff, expected YAML in UTF-8",
     GM_ERR_FORMAT},
    {"comment.yaml", ":1: the file is empty; a description was expected", GM_ERR_FORMAT},
    {"empty.yaml", ":1: the file is empty; a description was expected", GM_ERR_FORMAT},
    {"complex_key.yaml", ":2: a key must be a word or a number", GM_ERR_FORMAT},
    {"deep.yaml", ":1: nested deeper than 12 levels; a description needs 6",
     GM_ERR_FORMAT},
    {"newer.yaml", ":1: format must be the number 1, found '2'", GM_ERR_FORMAT},
    {"scalar.yaml", ":1: expected a group of fields, found 'hello'", GM_ERR_FORMAT},
    {"tab.yaml", ":1: not YAML; found 'invalid multiline plain key'", GM_ERR_FORMAT},
    {"twice.yaml", ":3: the key 'format' stands twice, first in line 1", GM_ERR_FORMAT},
    {"two_documents.yaml", ":2: only one document (---) per file", GM_ERR_FORMAT},
    {"unclosed.yaml", ":3: not YAML; found 'flow sequence without a closing bracket'",
     GM_ERR_FORMAT},
    {"not_there.yaml", ": cannot be opened: No such file or directory", GM_ERR_IO},
    {"", ": cannot be read: Is a directory", GM_ERR_IO},
};

static void files_that_are_no_descriptions_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        char path[512], expected[GM_ERROR_MESSAGE_SIZE];
        gm_error error = {GM_OK, ""};
        gm_description *d = NULL;
        (void)snprintf(path, sizeof path, "%s%s", BAD, files[i].name);
        (void)snprintf(expected, sizeof expected, "%s%s", path, files[i].message);
        assert_int_equal(gm_description_read(path, &d, &error), files[i].status);
        assert_string_equal(error.message, expected);
        assert_int_equal(gm_description_read(path, &d, NULL), files[i].status);
        assert_null(d);
    }
}

static void a_file_too_large_is_refused(void **state)
{
    (void)state;
    gm_error error = {GM_OK, ""};
    gm_description *d = NULL;
    FILE *f = fopen(CHANGED, "wb");
    assert_non_null(f);
    for (int i = 0; i < 5 * 1024 * 1024 / 64; i++)
        (void)fprintf(f, "# %061d\n", i);
    assert_int_equal(fclose(f), 0);
    assert_int_equal(gm_description_read(CHANGED, &d, &error), GM_ERR_FORMAT);
    assert_string_equal(error.message, CHANGED ": too large; a description has at most "
                                               "4194304 bytes");
}

/* Every allocation of our own fails once; the leak check of the sanitizer does the rest.
 */
static void running_out_of_memory_leaks_nothing(void **state)
{
    (void)state;
    gm_status status = GM_ERR_MEMORY;
    long k = 0;
    while (status == GM_ERR_MEMORY) {
        gm_description *d = NULL;
        gm_error error = {GM_OK, ""};
        gm_alloc_fail_after(++k);
        status = gm_description_read(EXAMPLE, &d, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        if (status == GM_ERR_MEMORY) {
            assert_null(d);
            assert_string_equal(error.message, "out of memory");
        }
        gm_description_destroy(d);
    }
    assert_true(k > 500); /* the tree alone has more nodes */
    gm_description_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(example_has_the_values_of_its_file),
        cmocka_unit_test(example_gears_and_bearings_are_complete),
        cmocka_unit_test(paths_are_ordered),
        cmocka_unit_test(example_gears_do_not_collide),
        cmocka_unit_test(example_gears_pass_the_other_shafts),
        cmocka_unit_test(files_that_are_no_descriptions_are_refused),
        cmocka_unit_test(a_file_too_large_is_refused),
        cmocka_unit_test(running_out_of_memory_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
