/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the description says about drags arrives in the losses of the gearset.
 */
#include "description_fixture.h"

#include "model/gm_gearset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CHANGED GM_BINARY_DIR "/test_drags.yaml"
#define RING "ring: {shaft: differential, teeth: 71,"
#define JET "jets:\n  cooling: {gear: ring, flow_l_min: 2.5, speed_m_s: 0.4}\n\nseals:"

typedef struct found {
    double power; /* of the kind, W */
    int n;        /* elements of the kind */
    char name[GM_NAME_SIZE];
} found;

/* Losses of one kind in third gear of the example, changed. */
static found losses_of(const char *find, const char *replace, gm_loss_kind kind)
{
    gm_error error = {GM_OK, ""};
    char *text = gm_test_slurp(EXAMPLE), *changed = gm_test_replaced(text, find, replace);
    gm_test_spill(CHANGED, changed);
    gm_description *d = gm_test_read(CHANGED);
    gm_gearset *g = NULL;
    gm_balance *b = NULL;
    found f = {0};
    gm_steady_point point = {.gear = {3, 0}, .speed = {80., 0., 0.}};
    point.direction[0] = 1.;
    if (gm_gearset_create(d, d->oil.temperature, &g, &error) != GM_OK ||
        gm_balance_create(g, &b, &error) != GM_OK ||
        gm_balance_set_point(b, &point, &error) != GM_OK)
        fail_msg("%s", error.message);
    int n = gm_gearset_element_count(g);
    gm_element_loss *losses = calloc((size_t)n, sizeof *losses);
    double *x = calloc((size_t)gm_balance_size(b), sizeof *x);
    assert_true(losses && x);
    gm_balance_losses(b, x, losses);
    for (int i = 0; i < n; i++)
        if (losses[i].kind == kind) {
            f.power += losses[i].power, f.n++;
            strcpy(f.name, losses[i].name);
        }
    free(losses);
    free(x);
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
    gm_description_destroy(d);
    free(text);
    free(changed);
    return f;
}

static void every_churning_law_has_its_loss(void **state)
{
    (void)state;
    found one = losses_of(RING, RING " churning: changenet_velex,", GM_LOSS_CHURNING);
    found same = losses_of(RING, RING, GM_LOSS_CHURNING);
    assert_true(one.n > 0 && one.power > 0. && one.power == same.power);
    found none = losses_of(RING, RING " churning: none,", GM_LOSS_CHURNING);
    assert_true(none.n == one.n - 1 && none.power < one.power);
    found agma = losses_of(RING, RING " churning: iso14179_1,", GM_LOSS_CHURNING);
    assert_true(agma.n == one.n && agma.power > none.power && agma.power != one.power);
    /* the ring meshes with two pinions: one hydraulic torque for each mesh */
    found mauz = losses_of(RING, RING " churning: iso14179_2,", GM_LOSS_CHURNING);
    assert_true(mauz.n > none.n && mauz.power > none.power);
}

static void windage_and_jets_have_their_loss(void **state)
{
    (void)state;
    assert_int_equal(losses_of(RING, RING, GM_LOSS_WINDAGE).n, 0);
    found air = losses_of(RING, RING " windage: true,", GM_LOSS_WINDAGE);
    assert_true(air.n == 1 && air.power > 0.);
    assert_string_equal(air.name, "ring");
    found spray = losses_of("seals:", JET, GM_LOSS_JET);
    assert_true(spray.n == 1 && spray.power > 0.);
    assert_string_equal(spray.name, "cooling");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_churning_law_has_its_loss),
        cmocka_unit_test(windage_and_jets_have_their_loss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
