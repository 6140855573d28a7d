/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The Jacobian of the motion: exact over the examples in random gears and states, with
 * shafts that twist and with elastic bearings.
 */
#include "jacobian_fixture.h"
#include "property.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void (*reader)(moving *m, const char *path);

static void check_example(const char *name, reader read, uint64_t seed)
{
    moving m;
    char path[512];
    assert_true(snprintf(path, sizeof path, MOTION_EXAMPLES "%s", name) < 512);
    read(&m, path);
    tally count = compare_jacobian(&m, &seed, 60);
    print_message("%s: %ld derivatives, %ld beside kinks\n", name, count.compared,
                  count.kinks);
    /* few differences may be lost to kinks */
    assert_true(count.kinks < count.compared / 100);
    moving_clear(&m);
}

/* Every gearset in examples/; vehicles have files of their own. */
static void the_examples_have_exact_derivatives(void **state)
{
    (void)state;
    int files = 0;
    DIR *folder = opendir(MOTION_EXAMPLES);
    assert_non_null(folder);
    for (struct dirent *file = readdir(folder); file; file = readdir(folder)) {
        const char *end = strrchr(file->d_name, '.');
        if (!end || strcmp(end, ".yaml") != 0 ||
            strncmp(file->d_name, "vehicle_", 8) == 0)
            continue;
        check_example(file->d_name, moving_read, 1);
        files++;
    }
    (void)closedir(folder);
    assert_true(files >= 3);
}

static void so_have_shafts_that_twist_and_elastic_bearings(void **state)
{
    (void)state;
    check_example("dct7.yaml", moving_read_twisting, 2);
    check_example("dct7.yaml", moving_read_holding, 5);
}

static void its_pattern_has_the_diagonal_and_columns_ascend(void **state)
{
    (void)state;
    moving m;
    sparse s;
    moving_read(&m, MOTION_EXAMPLES "dct7.yaml");
    sparse_make(&s, m.motion);
    assert_int_equal(s.column_start[0], 0);
    assert_int_equal(s.column_start[s.n], s.entries);
    for (int j = 0; j < s.n; j++) {
        int diagonal = 0;
        for (int k = s.column_start[j]; k < s.column_start[j + 1]; k++) {
            assert_in_range(s.row[k], 0, s.n - 1);
            assert_true(k == s.column_start[j] || s.row[k] > s.row[k - 1]);
            diagonal |= s.row[k] == j;
        }
        assert_true(diagonal);
    }
    sparse_clear(&s);
    moving_clear(&m);
}

/* A torque on a flange turns its own body and nothing else at once. */
static void the_torque_column_is_a_difference_too(void **state)
{
    (void)state;
    moving m;
    double speed[GM_MAX_FLANGES] = {20., 100., 150.};
    moving_read(&m, MOTION_EXAMPLES "dct7.yaml");
    m.input.gear[0] = 3;
    moving_start(&m, speed);
    double *work = calloc(3 * (size_t)m.n, sizeof *work);
    assert_non_null(work);
    for (int f = 0; f <= m.d->n_paths; f++) {
        double *low = work, *high = work + m.n, *column = work + 2 * m.n;
        assert_int_equal(gm_motion_torque_column(m.motion, &m.input, m.x, f, column), 0);
        m.input.torque[f] = -1.;
        (void)gm_motion_rates(m.motion, &m.input, m.x, low);
        m.input.torque[f] = 1.;
        (void)gm_motion_rates(m.motion, &m.input, m.x, high);
        m.input.torque[f] = 0.;
        for (int i = 0; i < m.n; i++)
            assert_true(fabs(column[i] - 0.5 * (high[i] - low[i])) <=
                        1e-10 * (1. + fabs(column[i]))); /* linear: rounding only */
        assert_true(column[gm_motion_speed_state(m.motion, f)] > 0.);
    }
    free(work);
    moving_clear(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_examples_have_exact_derivatives),
        cmocka_unit_test(so_have_shafts_that_twist_and_elastic_bearings),
        cmocka_unit_test(its_pattern_has_the_diagonal_and_columns_ascend),
        cmocka_unit_test(the_torque_column_is_a_difference_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
