/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inner forces of the motion as the flanges see them, by laws that hold in any state; and
 * what the motion gives a component: names, modes, factors.
 */
#include "model/gm_motion_flanges.h"
#include "model/gm_motion_variables.h"

#include "base/alloc.h"
#include "core/gm_reduced.h"
#include "jacobian_fixture.h"
#include "motion_fixture.h"
#include "property.h"

#include <stdlib.h>
#include <string.h>

#define DCT GM_SOURCE_DIR "/examples/dct7.yaml"
#define AUTOMATIC GM_SOURCE_DIR "/examples/at4_ravigneaux.yaml"

static gm_motion_flanges *flanges_of(moving *m)
{
    gm_motion_flanges *f = NULL;
    gm_error error;
    if (gm_motion_flanges_create(m->motion, &f, &error) != GM_OK ||
        gm_motion_flanges_update(f, &error) != GM_OK)
        fail_msg("%s", error.message);
    return f;
}

/* A random state; deflections within a few times what closes the backlash. */
static void shake(moving *m, uint64_t *seed)
{
    for (int i = 0; i < m->n; i++)
        m->x[i] = random_between(seed, -1.0, 1.0) *
                  (gm_motion_state_name(m->motion, i)[0] == 'b' ? 100.0 : 1e-4);
}

/* Twist is linear in the deflections, so the twist of their rates is its rate. */
static void check_twist(moving *m, int p, uint64_t *seed)
{
    gm_motion_flanges *f = flanges_of(m);
    double *dx = calloc((size_t)m->n, sizeof *dx);
    for (int k = 0; k < 20; k++) {
        shake(m, seed);
        assert_int_equal(gm_motion_rates(m->motion, &m->input, m->x, dx), 0);
        double ratio = gm_motion_flanges_ratio(f, p);
        double w_p = m->x[gm_motion_speed_state(m->motion, 1 + p)];
        double w_o = m->x[gm_motion_speed_state(m->motion, 0)];
        double rate = gm_motion_flanges_twist(f, p, dx);
        assert_true(ratio != 0.0);
        /* rounding of sums of speeds of hundreds of rad/s times ratios of ten */
        assert_true(fabs(rate - (w_p - ratio * w_o)) <=
                    1e-10 * (fabs(w_p) + fabs(ratio * w_o) + 100.0));
    }
    free(dx);
    gm_motion_flanges_destroy(f);
}

static void twist_is_the_integral_of_the_slip(void **state)
{
    (void)state;
    static const double speed[GM_MAX_FLANGES] = {10.0, 20.0, 30.0};
    uint64_t seed = 7;
    moving m;
    for (int gear = 1; gear <= 7; gear += 2) {
        moving_read(&m, DCT);
        m.input = (gm_motion_input){.gear = {gear, 2}};
        moving_start(&m, speed);
        check_twist(&m, 0, &seed);
        check_twist(&m, 1, &seed);
        moving_clear(&m);
    }
    moving_read_twisting(&m, DCT);
    m.input = (gm_motion_input){.gear = {3, 4}};
    moving_start(&m, speed);
    check_twist(&m, 0, &seed);
    moving_clear(&m);
    for (int gear = 1; gear <= 4; gear++) {
        moving_read(&m, AUTOMATIC);
        m.input = (gm_motion_input){.gear = {gear, 0}};
        moving_start(&m, speed);
        check_twist(&m, 0, &seed);
        moving_clear(&m);
    }
}

/* Where nothing slips elastically, all power of friction passes the flanges. */
static void check_losses(const char *path, const int gear[2])
{
    static const double speed[GM_MAX_FLANGES] = {40.0, 90.0, 60.0};
    moving m;
    double loss[GM_MAX_FLANGES], power = 0.0;
    moving_read(&m, path);
    m.input =
        (gm_motion_input){.gear = {gear[0], gear[1]}, .torque = {-100.0, 50.0, 0.0}};
    moving_start(&m, speed);
    gm_motion_flanges *f = flanges_of(&m);
    gm_motion_view view = moving_view(&m);
    gm_motion_flanges_losses(f, &m.input, m.x, loss);
    for (int i = 0; i <= m.d->n_paths; i++)
        power += loss[i] * view.speed[i];
    check_close("power of losses", power, view.loss_power, 1e-9);
    gm_motion_view again = moving_view(&m); /* asking has changed nothing */
    assert_memory_equal(&again, &view, sizeof view);
    gm_motion_flanges_destroy(f);
    moving_clear(&m);
}

static void loss_torques_make_the_loss_power(void **state)
{
    (void)state;
    check_losses(DCT, (const int[]){0, 0});
    check_losses(DCT, (const int[]){3, 0});
    check_losses(DCT, (const int[]){3, 4});
    check_losses(DCT, (const int[]){0, 6});
    check_losses(AUTOMATIC, (const int[]){0, 0});
    check_losses(AUTOMATIC, (const int[]){2, 0});
    check_losses(GM_SOURCE_DIR "/examples/mt5.yaml", (const int[]){5, 0});
}

static void losses_scale(void **state)
{
    (void)state;
    moving m;
    static const double speed[GM_MAX_FLANGES] = {40.0, 90.0, 60.0};
    moving_read(&m, DCT);
    m.input = (gm_motion_input){.gear = {3, 0}};
    moving_start(&m, speed);
    double plain = moving_view(&m).loss_power;
    gm_motion_scale_losses(m.motion, 2.5);
    check_close("losses", moving_view(&m).loss_power, 2.5 * plain, 1e-12);
    gm_motion_scale_losses(m.motion, 0.0);
    assert_true(fabs(moving_view(&m).loss_power) < 1e-9); /* of rounding in dampers */
    moving_clear(&m);
}

static void the_jacobian_scales_with_them(void **state)
{
    (void)state;
    uint64_t seed = 11;
    moving m;
    moving_read_holding(&m, DCT);
    gm_motion_scale_losses(m.motion, 1.7);
    tally count = compare_jacobian(&m, &seed, 20);
    assert_true(count.kinks < count.compared / 100);
    moving_clear(&m);
}

static void modes_are_kept_and_set(void **state)
{
    (void)state;
    static const double speed[GM_MAX_FLANGES] = {40.0, 90.0, 60.0};
    moving m, other;
    int changed;
    gm_error error;
    moving_read(&m, DCT);
    moving_read(&other, DCT);
    m.input = (gm_motion_input){.gear = {3, 0}};
    moving_start(&m, speed);
    m.input.gear[1] = 4;
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, &error), GM_OK);
    int n = gm_motion_n_modes(m.motion);
    double *modes = calloc((size_t)n, sizeof *modes),
           *again = calloc((size_t)n, sizeof *again);
    double *dx = calloc(2 * (size_t)m.n, sizeof *dx);
    gm_motion_get_modes(m.motion, modes);
    assert_int_equal(gm_motion_set_modes(other.motion, modes), 0);
    gm_motion_get_modes(other.motion, again);
    assert_memory_equal(modes, again, (size_t)n * sizeof *modes);
    assert_int_equal(gm_motion_rates(m.motion, &m.input, m.x, dx), 0);
    assert_int_equal(gm_motion_rates(other.motion, &m.input, m.x, dx + m.n), 0);
    assert_memory_equal(dx, dx + m.n, (size_t)m.n * sizeof *dx);
    for (int i = 0; i < n; i++) { /* no number of them may be anything */
        double kept = modes[i];
        modes[i] = i + 1 < n ? 0.3 : -1.0;
        assert_int_equal(gm_motion_set_modes(other.motion, modes),
                         i < n - 3 || i == n - 1);
        modes[i] = kept;
    }
    free(modes);
    free(again);
    free(dx);
    moving_clear(&m);
    moving_clear(&other);
}

static const gm_motion_variable *find(const gm_motion_variables *list, const char *name)
{
    for (int i = 0; i < list->n; i++)
        if (strcmp(list->all[i].name, name) == 0)
            return &list->all[i];
    fail_msg("no variable %s", name);
    return NULL;
}

static void names_are_structured(void **state)
{
    (void)state;
    moving m;
    gm_error error;
    gm_motion_variables list;
    gm_description *d = NULL;
    assert_int_equal(gm_description_read(DCT, &d, &error), GM_OK);
    strcpy(d->meshes[0].id.name, "a.b-c");
    strcpy(d->meshes[1].id.name, "2nd");
    d->shafts[0].torsion = GM_TORSION_ELASTIC;
    moving_make(&m, d);
    assert_int_equal(gm_motion_variables_make(m.motion, &list, &error), GM_OK);
    assert_int_equal(find(&list, "mesh.'a.b-c'.deflection")->kind, GM_MOTION_STATE);
    assert_int_equal(find(&list, "der(mesh.'2nd'.deflection)")->kind, GM_MOTION_RATE);
    assert_string_equal(find(&list, "shaft.input_odd[1].torque")->unit, "N.m");
    assert_string_equal(find(&list, "shaft.input_odd[1].deflection")->unit, "rad");
    assert_int_equal(find(&list, "bearing.input_odd_pilot.radial")->kind,
                     GM_MOTION_SIGNAL);
    gm_motion_variables_clear(&list);
    moving_clear(&m);
    gm_description_destroy(d);
}

static void without_memory_nothing_is_left(void **state)
{
    (void)state;
    static const double speed[GM_MAX_FLANGES] = {40.0, 90.0, 60.0};
    moving m;
    gm_error error;
    gm_motion_flanges *f = NULL;
    gm_motion_variables list = {0};
    moving_read(&m, DCT);
    moving_start(&m, speed);
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_motion_flanges_create(m.motion, &f, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
    }
    status = GM_ERR_MEMORY;
    for (long k = 1; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_motion_flanges_update(f, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
    }
    status = GM_ERR_MEMORY;
    for (long k = 1; status != GM_OK; k += k < 20 ? 1 : 17) {
        gm_alloc_fail_after(k);
        status = gm_motion_variables_make(m.motion, &list, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !list.all));
    }
    gm_motion_variables_clear(&list);
    gm_motion_flanges_destroy(f);
    moving_clear(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(twist_is_the_integral_of_the_slip),
        cmocka_unit_test(loss_torques_make_the_loss_power),
        cmocka_unit_test(losses_scale),
        cmocka_unit_test(the_jacobian_scales_with_them),
        cmocka_unit_test(modes_are_kept_and_set),
        cmocka_unit_test(names_are_structured),
        cmocka_unit_test(without_memory_nothing_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
