/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Numbers and colours behind model.png; that it is a picture is tested on the FMU.
 */
#include "bake/picture.h"
#include "example_map.h"

#include "base/alloc.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* At nodes of the example map, from its formulas: parasitic 6 + 0.012 w + 1e-5 w2 at the
 * output, load loss 0.02 |tau| (1 + w / 2000). */
static void efficiency_is_what_the_losses_leave(void **state)
{
    gm_map_view *view = NULL;
    (void)state;
    gm_map *map = example_map(2);
    assert_int_equal(gm_map_view_create(map, &view, NULL), GM_OK);
    const gm_reduced_map *reduced = gm_map_view_reduced(view);
    for (int p = 0; p < 2; p++)
        for (int g = 0; g < map->paths[p].n_gears; g++) {
            double r = map->paths[p].gears[g].ratio < 0 ? -map->paths[p].gears[g].ratio
                                                        : map->paths[p].gears[g].ratio;
            double w_o = 60, w = 60 * r, tau = 200;
            double loss =
                0.02 * tau * (1 + w / 2000) + (6 + 0.012 * w_o + 1e-5 * w_o * w_o) / r;
            double error =
                gm_picture_efficiency(reduced, p, g, w, tau) - (1 - loss / tau);
            assert_true(error < 1e-12 && error > -1e-12); /* D is linear in w and tau */
        }
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static void efficiency_is_never_negative(void **state)
{
    gm_map_view *view = NULL;
    (void)state;
    gm_map *map = example_map(1);
    assert_int_equal(gm_map_view_create(map, &view, NULL), GM_OK);
    assert_true(gm_picture_efficiency(gm_map_view_reduced(view), 0, 0, 800, 1e-3) == 0);
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static double brightness(double efficiency)
{
    unsigned char c[3];
    gm_picture_colour(efficiency, c);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; /* ITU-R BT.709 */
}

static void better_is_brighter(void **state)
{
    (void)state;
    for (double e = GM_PICTURE_LOW; e < GM_PICTURE_HIGH - 0.005; e += 0.005)
        assert_true(brightness(e + 0.005) > brightness(e));
    assert_true(brightness(0.1) == brightness(GM_PICTURE_LOW));
    assert_true(brightness(1) == brightness(GM_PICTURE_HIGH));
}

static void without_memory_there_is_no_picture(void **state)
{
    gm_map_view *view = NULL;
    gm_status status = GM_ERR_MEMORY;
    (void)state;
    gm_map *map = example_map(1);
    assert_int_equal(gm_map_view_create(map, &view, NULL), GM_OK);
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_buffer picture = {0};
        gm_alloc_fail_after(k);
        status = gm_picture_write(map, gm_map_view_reduced(view), &picture, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        gm_buffer_clear(&picture);
    }
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(efficiency_is_what_the_losses_leave),
        cmocka_unit_test(efficiency_is_never_negative),
        cmocka_unit_test(better_is_brighter),
        cmocka_unit_test(without_memory_there_is_no_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
