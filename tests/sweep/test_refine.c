/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Refinements of known functions: the tolerance holds at points that no refinement saw,
 * with fewer samples than a uniform grid needs, and the result does not depend on how it
 * was computed.
 */
#include "sweep/refine.h"

#include "base/alloc.h"
#include "sweep/memo.h"
#include "sweep/verify_points.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define CHECKED 20000 /* points */

typedef double (*law)(const double *x);

/* Friction over the speed: a rise at rest, a kink, then v^-0.2. */
static double stribeck(const double *x)
{
    return 1.0 + 0.5 * exp(-x[0] / 3.0) + 0.4 * pow(fmax(x[0], 20.0) / 20.0, -0.2);
}

static double kink(const double *x)
{
    return fabs(x[0] - 33.3);
}

static double constant(const double *x)
{
    (void)x;
    return 7.0;
}

/* Loss over speed and torque: kinks where meshes reverse, which move with the speed. */
static double loss(const double *x)
{
    double reverse = 0.3 + 0.001 * x[0];
    return 0.2 + 0.05 * pow(x[0], 0.6) +
           0.02 * fabs(x[1] - reverse) * (1.0 + 0.3 / (1.0 + 0.02 * x[0])) +
           0.0001 * x[1] * x[1];
}

/* The same over a third axis, such as the temperature. */
static double warm_loss(const double *x)
{
    return loss(x) * (1.0 + 1.5 * exp(-x[2] / 30.0));
}

/* An edge across both axes, which no grid follows. */
static double across(const double *x)
{
    return fabs(x[0] / 600.0 - (x[1] + 200.0) / 400.0);
}

static double at_two(const double *x)
{
    return loss(x) - 0.2;
}

typedef struct subject {
    law value[GM_REFINE_VALUES];
    gm_refine_spec spec;
} subject;

static gm_refine_axis axis_over(double low, double high, int n)
{
    gm_refine_axis axis = {.start = {.n = n}, .n_max = 200};
    for (int i = 0; i < n; i++)
        axis.start.x[i] = low + (high - low) * i / (n - 1);
    axis.start.x[n - 1] = high;
    axis.cut[0] = axis.fixed[0] = low;
    axis.cut[1] = axis.fixed[1] = axis.start.x[n / 2];
    axis.cut[2] = axis.fixed[2] = high;
    axis.n_cuts = axis.n_fixed = 3;
    axis.shortest = 1e-5 * (high - low);
    return axis;
}

static subject subject_of(law value, int n_axes)
{
    subject s = {.value = {value}};
    s.spec.n_axes = n_axes;
    s.spec.n_values = 1;
    s.spec.share = 0.005;
    s.spec.noise[0] = s.spec.noise[1] = 1e-9;
    s.spec.seed = 42;
    s.spec.axis[0] = axis_over(0.0, 600.0, 9);
    s.spec.axis[1] = axis_over(-200.0, 200.0, 11);
    s.spec.axis[2] = axis_over(-10.0, 100.0, 5);
    return s;
}

static gm_sample sample_of(const subject *s, const double *x)
{
    gm_sample sample = {{0.0}, {0.0}};
    for (int k = 0; k < s->spec.n_values; k++) {
        sample.value[k] = s->value[k](x);
        sample.size[k] = fabs(sample.value[k]);
    }
    return sample;
}

/* Forward or backward through what is wanted; returns the number of samples. */
static int run(const subject *s, int backward, gm_refine **made)
{
    int samples = 0;
    assert_int_equal(gm_refine_create(&s->spec, made, NULL), GM_OK);
    for (int n; (n = gm_refine_wanted(*made)) > 0; samples += n) {
        for (int i = 0; i < n; i++) {
            int at = backward ? n - 1 - i : i;
            gm_sample sample = sample_of(s, gm_refine_point(*made, at));
            gm_refine_tell(*made, at, &sample);
        }
        assert_int_equal(gm_refine_advance(*made, NULL), GM_OK);
    }
    return samples;
}

typedef struct grid {
    gm_axis axis[GM_MAX_AXES];
    double *value;
} grid;

static grid grid_of(const subject *s, const gm_nodes *const *nodes, int k)
{
    grid g = {.value = NULL};
    int size = 1;
    for (int a = 0; a < s->spec.n_axes; a++) {
        g.axis[a] = (gm_axis){nodes[a]->n, nodes[a]->x};
        size *= nodes[a]->n;
    }
    g.value = gm_calloc((size_t)size, sizeof *g.value);
    assert_non_null(g.value);
    for (int i = 0; i < size; i++) {
        double x[GM_MAX_AXES] = {0.0};
        for (int a = s->spec.n_axes - 1, rest = i; a >= 0; a--) {
            x[a] = nodes[a]->x[rest % nodes[a]->n];
            rest /= nodes[a]->n;
        }
        g.value[i] = s->value[k](x);
    }
    return g;
}

static double read_grid(const subject *s, const grid *g, const double *x)
{
    gm_table1 t1 = {.x = g->axis[0], .value = g->value, .monotone = s->spec.monotone};
    gm_table2 t2 = {.x = g->axis[0],
                    .y = g->axis[1],
                    .value = g->value,
                    .monotone = s->spec.monotone};
    gm_table3 t3 = {.x = g->axis[0], .y = g->axis[1], .z = g->axis[2], .value = g->value};
    gm_cell1 c1 = {0};
    gm_cell2 c2 = {0};
    return s->spec.n_axes == 1   ? gm_table1_at(&t1, 1, &c1, x[0]).value
           : s->spec.n_axes == 2 ? gm_table2_at(&t2, 1, &c2, x[0], x[1]).value
                                 : gm_table3_at(&t3, x[0], x[1], x[2]).value;
}

/* Largest error at random points, of the largest value. */
static double error_on(const subject *s, const gm_nodes *const *nodes, int k)
{
    uint64_t dice = 4711; /* another sequence than any refinement's */
    grid g = grid_of(s, nodes, k);
    double largest = 0.0, worst = 0.0;
    for (int i = 0; i < CHECKED; i++) {
        double x[GM_MAX_AXES] = {0.0};
        for (int a = 0; a < s->spec.n_axes; a++) {
            const gm_nodes *n = nodes[a];
            x[a] = gm_random_between(&dice, n->x[0], n->x[n->n - 1]);
        }
        double value = s->value[k](x);
        largest = fmax(largest, fabs(value));
        worst = fmax(worst, fabs(read_grid(s, &g, x) - value));
    }
    gm_free(g.value);
    return worst / largest;
}

static double error_of(const subject *s, const gm_refine *refine, int k)
{
    const gm_nodes *nodes[GM_MAX_AXES];
    for (int a = 0; a < s->spec.n_axes; a++)
        nodes[a] = gm_refine_nodes(refine, a);
    return error_on(s, nodes, k);
}

/* ---- what it promises ---- */

static void the_tolerance_holds_at_points_never_seen(void **state)
{
    (void)state;
    const struct {
        law value;
        int n_axes;
    } cases[] = {{stribeck, 1}, {kink, 1}, {constant, 1}, {loss, 2}, {warm_loss, 3}};
    const double tolerance[] = {0.02, 0.005, 0.001};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (int t = 0; t < (cases[c].n_axes == 3 ? 2 : 3); t++) {
            subject s = subject_of(cases[c].value, cases[c].n_axes);
            gm_refine *refine;
            s.spec.share = tolerance[t];
            (void)run(&s, 0, &refine);
            assert_true(gm_refine_state_of(refine).reached);
            double error = error_of(&s, refine, 0);
            /* a corner of a cell that hundreds of held-out points missed may be a little
               outside */
            if (!(error <= 1.1 * tolerance[t]))
                fail_msg("case %d: %g instead of %g", (int)c, error, tolerance[t]);
            gm_refine_destroy(refine);
        }
}

static int uniform_nodes(const subject *s, double error)
{
    static gm_nodes axis[2];
    const gm_nodes *nodes[2] = {&axis[0], &axis[1]};
    for (int n = 3; n < 400; n++) {
        for (int a = 0; a < 2; a++)
            axis[a] = axis_over(a ? -200.0 : 0.0, a ? 200.0 : 600.0, n).start;
        if (error_on(s, nodes, 0) <= error)
            return n * n;
    }
    return 400 * 400;
}

static void fewer_samples_than_a_uniform_grid_of_the_same_error(void **state)
{
    (void)state;
    subject s = subject_of(loss, 2);
    gm_refine *refine;
    s.spec.share = 0.002;
    int samples = run(&s, 0, &refine);
    int nodes = gm_refine_nodes(refine, 0)->n * gm_refine_nodes(refine, 1)->n;
    int uniform = uniform_nodes(&s, error_of(&s, refine, 0));
    assert_true(nodes < samples && samples < uniform);
    assert_true(4 * nodes < uniform);
    gm_refine_destroy(refine);
}

static void nodes_lie_close_where_curves_bend(void **state)
{
    (void)state;
    subject s = subject_of(stribeck, 1);
    gm_refine *refine;
    (void)run(&s, 0, &refine);
    const gm_nodes *n = gm_refine_nodes(refine, 0);
    assert_true(n->x[0] == 0.0 && n->x[n->n - 1] == 600.0);
    assert_true(n->x[1] < 2.0 && n->x[n->n - 1] - n->x[n->n - 2] > 50.0);
    gm_refine_destroy(refine);
    s = subject_of(constant, 2);
    (void)run(&s, 0, &refine);
    assert_int_equal(gm_refine_nodes(refine, 0)->n, 3); /* the fixed ones alone */
    gm_refine_destroy(refine);
}

static void a_kink_is_closed_in(void **state)
{
    (void)state;
    subject s = subject_of(kink, 1);
    gm_refine *refine;
    int near = 0;
    (void)run(&s, 0, &refine);
    const gm_nodes *n = gm_refine_nodes(refine, 0);
    for (int i = 0; i < n->n; i++)
        near += fabs(n->x[i] - 33.3) < 2.0 * 0.005 * 600.0;
    assert_true(near >= 1 && n->n <= 8);
    gm_refine_destroy(refine);
}

static void both_values_are_inside(void **state)
{
    (void)state;
    subject s = subject_of(loss, 2);
    gm_refine *refine;
    s.spec.n_values = 2;
    s.value[1] = at_two;
    (void)run(&s, 0, &refine);
    assert_true(error_of(&s, refine, 0) <= 0.0055 && error_of(&s, refine, 1) <= 0.0055);
    gm_refine_destroy(refine);
}

static void cubics_are_judged_as_cubics(void **state)
{
    (void)state;
    int nodes[2];
    for (int monotone = 0; monotone < 2; monotone++) {
        subject s = subject_of(loss, 2);
        gm_refine *refine;
        s.spec.monotone = monotone;
        s.spec.share = 0.001;
        (void)run(&s, 0, &refine);
        assert_true(gm_refine_state_of(refine).reached);
        assert_true(error_of(&s, refine, 0) <= 0.0011);
        nodes[monotone] = gm_refine_nodes(refine, 0)->n * gm_refine_nodes(refine, 1)->n;
        gm_refine_destroy(refine);
    }
    assert_true(nodes[1] < nodes[0]);
}

static void an_absolute_tolerance_counts_where_it_is_larger(void **state)
{
    (void)state;
    int n[3];
    const double absolute[] = {0.0, 1e-9, 0.05};
    for (int i = 0; i < 3; i++) {
        subject s = subject_of(stribeck, 1);
        gm_refine *refine;
        s.spec.absolute[0] = absolute[i];
        (void)run(&s, 0, &refine);
        n[i] = gm_refine_nodes(refine, 0)->n;
        assert_true(i < 2 || error_of(&s, refine, 0) * 1.9 <= 0.0505);
        gm_refine_destroy(refine);
    }
    assert_true(n[0] == n[1] && n[2] < n[0]);
}

static void what_cannot_be_reached_is_said(void **state)
{
    (void)state;
    subject s = subject_of(across, 2);
    gm_refine *refine;
    s.spec.share = 1e-3;
    s.spec.axis[0].n_max = s.spec.axis[1].n_max = 15;
    (void)run(&s, 0, &refine);
    gm_refine_state state_of = gm_refine_state_of(refine);
    assert_false(state_of.reached);
    assert_true(state_of.error > 1.0 && state_of.relative > 1e-3);
    assert_true(fabs(across(state_of.worst)) < 0.15); /* near the edge */
    assert_true(gm_refine_nodes(refine, 0)->n <= 15);
    assert_true(gm_refine_nodes(refine, 1)->n <= 15);
    gm_refine_destroy(refine);
}

static void other_nodes_are_taken_where_they_would_not_be_enough(void **state)
{
    (void)state;
    subject s = subject_of(loss, 2);
    gm_refine *refine;
    s.spec.share = 1e-4;
    for (int a = 0; a < 2; a++) {
        s.spec.axis[a].n_max = 5;
        s.spec.axis[a].otherwise =
            axis_over(a ? -200.0 : 0.0, a ? 200.0 : 600.0, 5).start;
    }
    (void)run(&s, 0, &refine);
    for (int a = 0; a < 2; a++)
        for (int i = 0; i < 5; i++)
            assert_true(gm_refine_nodes(refine, a)->x[i] ==
                        s.spec.axis[a].otherwise.x[i]);
    gm_refine_destroy(refine);
}

static void the_order_of_sampling_does_not_matter(void **state)
{
    (void)state;
    subject s = subject_of(loss, 2);
    gm_refine *refine[2];
    int samples[2];
    for (int i = 0; i < 2; i++)
        samples[i] = run(&s, i, &refine[i]);
    assert_int_equal(samples[0], samples[1]);
    for (int a = 0; a < 2; a++) {
        const gm_nodes *n[2] = {gm_refine_nodes(refine[0], a),
                                gm_refine_nodes(refine[1], a)};
        assert_int_equal(n[0]->n, n[1]->n);
        assert_memory_equal(n[0]->x, n[1]->x, (size_t)n[0]->n * sizeof(double));
    }
    gm_refine_destroy(refine[0]);
    gm_refine_destroy(refine[1]);
}

static gm_status run_with_failing_memory(const subject *s, long k)
{
    gm_refine *refine = NULL;
    gm_alloc_fail_after(k);
    gm_status status = gm_refine_create(&s->spec, &refine, NULL);
    for (int n; status == GM_OK && (n = gm_refine_wanted(refine)) > 0;) {
        for (int i = 0; i < n; i++) {
            gm_sample sample = sample_of(s, gm_refine_point(refine, i));
            gm_refine_tell(refine, i, &sample);
        }
        status = gm_refine_advance(refine, NULL);
    }
    gm_alloc_fail_after(0);
    gm_refine_destroy(refine);
    return status;
}

static void every_failing_allocation_is_a_status(void **state)
{
    (void)state;
    subject s = subject_of(loss, 2);
    gm_status status = GM_ERR_MEMORY;
    long k = 1;
    for (; status == GM_ERR_MEMORY; k++)
        status = run_with_failing_memory(&s, k);
    assert_int_equal(status, GM_OK);
    assert_true(k > 10);
}

/* ---- the memory of samples ---- */

static void a_memo_finds_what_was_put(void **state)
{
    (void)state;
    gm_memo *memo = gm_memo_create(2 * sizeof(double), sizeof(double));
    uint64_t dice = 1;
    assert_non_null(memo);
    for (int i = 0; i < 5000; i++) {
        double key[2] = {(double)i, gm_random_between(&dice, 0.0, 1.0)};
        assert_null(gm_memo_find(memo, key));
        double *value = gm_memo_add(memo, key);
        assert_true(value && *value == 0.0);
        *value = 3.0 * i;
    }
    assert_int_equal(gm_memo_count(memo), 5000);
    for (int i = 0; i < 5000; i++) { /* also after all growth, in the order of coming */
        const double *key = gm_memo_key(memo, i), *value = gm_memo_value(memo, i);
        assert_true(key[0] == i && *value == 3.0 * i);
        assert_ptr_equal(gm_memo_find(memo, key), value);
    }
    gm_memo_destroy(memo);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tolerance_holds_at_points_never_seen),
        cmocka_unit_test(fewer_samples_than_a_uniform_grid_of_the_same_error),
        cmocka_unit_test(nodes_lie_close_where_curves_bend),
        cmocka_unit_test(a_kink_is_closed_in),
        cmocka_unit_test(both_values_are_inside),
        cmocka_unit_test(cubics_are_judged_as_cubics),
        cmocka_unit_test(an_absolute_tolerance_counts_where_it_is_larger),
        cmocka_unit_test(what_cannot_be_reached_is_said),
        cmocka_unit_test(other_nodes_are_taken_where_they_would_not_be_enough),
        cmocka_unit_test(the_order_of_sampling_does_not_matter),
        cmocka_unit_test(every_failing_allocation_is_a_status),
        cmocka_unit_test(a_memo_finds_what_was_put),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
