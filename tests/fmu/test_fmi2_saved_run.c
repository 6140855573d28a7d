/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Every member of a run is kept, also those that only tell whether a warning is due, how
 * exactly the next step must follow, or what is evaluated when it is read.
 */
#include "gm_model.h"
#include "gm_saved.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static double next; /* a number that no other member has */

static gm_real number(void)
{
    next += 1;
    return next / 3; /* all 53 bits in use */
}

static int count(void)
{
    next += 1;
    return -(int)next;
}

static void fill_component(gm_component *c, bool yes)
{
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < GM_MAX_PATHS; p++)
            if (gm_variables[id].type == GM_TYPE_REAL)
                c->value[id][p].real = number();
            else
                c->value[id][p].integer = count();
    c->output_rate = number();
    c->flags = count();
    c->start_pending = yes;
    c->outputs_pending = yes;
    c->state.phi_o = number();
    c->state.w_o = number();
    c->state.brake = number();
    c->state.work = number();
    c->state.loss_energy = number();
}

static void fill(gm_run *run, bool yes)
{
    memset(run, 0, sizeof *run);
    fill_component(&run->component, yes);
    run->phase = yes ? GM_PHASE_STEP_FAILED : GM_PHASE_TERMINATED;
    run->experiment_set = yes;
    run->stop_defined = yes;
    run->time = number();
    run->stop_time = number();
    run->last_step = number();
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        run->component.path_rate[p] = number();
        run->component.state.path[p] =
            (gm_path_state){number(), number(), number(), count(), count(), 0};
        run->gear_reported[p] = yes;
        run->reported_gear[p] = count();
    }
}

static void assert_same_component(const gm_component *a, const gm_component *b)
{
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < GM_MAX_PATHS; p++)
            if (gm_variables[id].type == GM_TYPE_REAL)
                assert_true(a->value[id][p].real == b->value[id][p].real);
            else
                assert_int_equal(a->value[id][p].integer, b->value[id][p].integer);
    assert_true(a->output_rate == b->output_rate);
    assert_int_equal(a->flags, b->flags);
    assert_int_equal(a->start_pending, b->start_pending);
    assert_int_equal(a->outputs_pending, b->outputs_pending);
    assert_true(a->state.phi_o == b->state.phi_o);
    assert_true(a->state.w_o == b->state.w_o);
    assert_true(a->state.brake == b->state.brake);
    assert_true(a->state.work == b->state.work);
    assert_true(a->state.loss_energy == b->state.loss_energy);
}

static void assert_same_path(const gm_run *a, const gm_run *b, int p)
{
    const gm_path_state *x = &a->component.state.path[p],
                        *y = &b->component.state.path[p];
    assert_true(a->component.path_rate[p] == b->component.path_rate[p]);
    assert_true(x->phi == y->phi);
    assert_true(x->w == y->w);
    assert_true(x->twist == y->twist);
    assert_int_equal(x->mode, y->mode);
    assert_int_equal(x->gear, y->gear);
    assert_int_equal(a->gear_reported[p], b->gear_reported[p]);
    assert_int_equal(a->reported_gear[p], b->reported_gear[p]);
}

static void every_member_comes_back(void **state)
{
    (void)state;
    for (int yes = 0; yes < 2; yes++) {
        gm_run run, again;
        gm_saved saved;
        fill(&run, yes == 1);
        gm_saved_make(gm_model_guid(), &run, &saved);
        assert_int_equal(gm_saved_check(gm_model_guid(), &saved), GM_SAVED_OK);
        fill(&again, yes == 0);
        gm_saved_restore(&saved, &again);
        assert_same_component(&run.component, &again.component);
        for (int p = 0; p < GM_MAX_PATHS; p++)
            assert_same_path(&run, &again, p);
        assert_int_equal(run.phase, again.phase);
        assert_int_equal(run.experiment_set, again.experiment_set);
        assert_int_equal(run.stop_defined, again.stop_defined);
        assert_true(run.time == again.time);
        assert_true(run.stop_time == again.stop_time);
        assert_true(run.last_step == again.last_step);
    }
}

static void the_report_of_the_map_stays_with_the_instance(void **state)
{
    gm_run run;
    gm_saved saved;
    (void)state;
    fill(&run, true);
    run.map_left = false;
    gm_saved_make(gm_model_guid(), &run, &saved);
    run.map_left = true;
    gm_saved_restore(&saved, &run);
    assert_true(run.map_left);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_member_comes_back),
        cmocka_unit_test(the_report_of_the_map_stays_with_the_instance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
