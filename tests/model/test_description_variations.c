/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The random variations that tests/variations.py wrote into the build tree: the reader
 * takes every one, and the ratios that the generator computed from the teeth are those of
 * the assembled model.
 */
#include "model/gm_gearset.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { VARIATIONS = 500 }; /* as many as tests/model/CMakeLists.txt asks for */

static void check_ratios(const gm_description *d)
{
    gm_gearset *gearset = NULL;
    gm_error error = {GM_OK, ""};
    if (gm_gearset_create(d, d->oil.temperature, &gearset, &error) != GM_OK)
        fail_msg("%s", error.message);
    for (int p = 0; p < d->n_paths; p++)
        for (int i = 0; i < d->paths[p].n_gears; i++) {
            int gear[GM_MAX_INPUT_PATHS] = {0};
            gm_kinematics kinematics;
            gear[p] = d->paths[p].gears[i].number;
            assert_int_equal(gm_gearset_kinematics(gearset, gear, &kinematics, &error),
                             GM_OK);
            /* the file has nine digits */
            assert_true(fabs(kinematics.ratio[p] / d->paths[p].gears[i].ratio - 1.0) <
                        1e-8);
        }
    gm_gearset_destroy(gearset);
}

static void every_variation_is_a_gearset_with_its_ratios(void **state)
{
    (void)state;
    for (int i = 0; i < VARIATIONS; i++) {
        char path[512];
        gm_description *d = NULL;
        gm_error error = {GM_OK, ""};
        (void)snprintf(path, sizeof path, GM_BINARY_DIR "/variations/variation_%04d.yaml",
                       i);
        if (gm_description_read(path, &d, &error) != GM_OK)
            fail_msg("%s", error.message);
        check_ratios(d);
        gm_description_destroy(d);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_variation_is_a_gearset_with_its_ratios),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
