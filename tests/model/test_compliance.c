/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "base/alloc.h"
#include "model/stiffness.h"
#include "reducer_fixture.h"

/* One stage with a lock: at 1 N.m on the pinion shaft the mesh carries 1/r_b1 and the
 * dogs of the wheel u = 49/32, so by hand
 * 1/k = 1/(k_m r_b1^2) + u^2/k_d,  lash = j_bt / r_b1 + u j_d. */
static void one_stage_by_hand(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    r.meshes[0].flanks.stiffness = 3e8;
    r.meshes[0].flanks.backlash = 0.1e-3;
    gm_gearset *g = NULL;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    const gm_pair *pair = &g->meshes[0].pair;
    double r_b = 0.5 * pair->d_b[0], u = 49. / 32.;
    const gm_flanks *dogs = &r.synchroniser.dogs;
    gm_compliance c;
    assert_int_equal(gm_gearset_compliance(g, 0, 1, &c, NULL), GM_OK);
    double mesh = 1. / (3e8 * r_b * r_b), lock = u * u / dogs->stiffness;
    check_close("stiffness", c.stiffness, 1. / (mesh + lock), 1e-12);
    check_close("lash", c.lash, 0.1e-3 / cos(pair->beta_b) / r_b + u * dogs->backlash,
                1e-12);
    /* dampers d_m and d_d in series with their shares of the rate */
    double J[3];
    for (int b = 0; b < 3; b++)
        J[b] = g->bodies[b].inertia;
    double d_m =
        gm_mesh_contact_law(g, 0, gm_row_reduced_mass(&g->meshes[0].row, J)).damping;
    double m_d = 1. / (1. / J[1] + 1. / J[2]);
    double d_d = 2. * dogs->damping_ratio * sqrt(dogs->stiffness * m_d);
    double rate_m = 1. / (3e8 * r_b), rate_d = u / dogs->stiffness;
    check_close("damping", c.damping,
                c.stiffness * c.stiffness *
                    (d_m * rate_m * rate_m + d_d * rate_d * rate_d),
                1e-12);
    gm_gearset_destroy(g);
}

static void what_is_not_a_gear_is_refused(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    gm_gearset *g = NULL;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    gm_compliance c = {.lash = 3.};
    assert_int_equal(gm_gearset_compliance(g, 0, 0, &c, NULL), GM_ERR_ARGUMENT);
    assert_int_equal(gm_gearset_compliance(g, 0, 2, &c, NULL), GM_ERR_ARGUMENT);
    int k = 1;
    for (gm_status status = GM_ERR_MEMORY; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_gearset_compliance(g, 0, 1, &c, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && c.lash == 3.));
    }
    assert_true(k > 4);
    gm_gearset_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_stage_by_hand),
        cmocka_unit_test(what_is_not_a_gear_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
