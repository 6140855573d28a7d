/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The random gearsets that tests/variations.py wrote into the build tree, in motion: each
 * can be made to move, and its Jacobian is exact. One third of them as they are, one with
 * shafts that twist, one with elastic bearings.
 */
#include "jacobian_fixture.h"
#include "property.h"

#include <stdio.h>

enum { VARIATIONS = 200 }; /* of those that tests/model/CMakeLists.txt asks for */

static void every_variation_moves_with_an_exact_jacobian(void **state)
{
    (void)state;
    void (*const read[3])(moving * m, const char *path) = {
        moving_read, moving_read_twisting, moving_read_holding};
    uint64_t seed = 77;
    tally sum = {0, 0};
    for (int i = 0; i < VARIATIONS; i++) {
        char path[512];
        moving m;
        (void)snprintf(path, sizeof path, GM_BINARY_DIR "/variations/variation_%04d.yaml",
                       i);
        read[i % 3](&m, path);
        tally count = compare_jacobian(&m, &seed, 4);
        sum.compared += count.compared;
        sum.kinks += count.kinks;
        moving_clear(&m);
    }
    print_message("%ld derivatives, %ld beside kinks\n", sum.compared, sum.kinks);
    assert_true(sum.kinks < sum.compared / 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_variation_moves_with_an_exact_jacobian),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
