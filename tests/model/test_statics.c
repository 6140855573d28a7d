/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "model/statics.h"

#include <math.h>
#include <string.h>

/* A helical pinion on a shaft with two bearings, as one would compute it by hand:
 * F_t, F_r, F_a at the pitch point +r e; the tangential plane is a simple beam, the
 * radial plane has the tilting moment F_a r on top. */
#define A_POSITION 0.0
#define B_POSITION 0.160
#define GEAR_POSITION 0.060
#define R_W 0.03233162
#define F_T 3092.948
#define F_R 1126.067
#define F_A 1785.714

static gm_bearing bearing_at(double x, int locating)
{
    return (gm_bearing){.shaft = 0,
                        .on = GM_HOUSING,
                        .position = x,
                        .locating = locating,
                        .radial_stiffness = 2e8,
                        .axial_stiffness = 1e8};
}

/* Mesh with e = +y, t = +z on the only shaft; force +1 stands for all components. */
static gm_static_mesh hand_mesh(void)
{
    gm_contact contact = {.signed_part = {F_A, 0.0, F_T},
                          .magnitude_part = {0.0, -F_R, 0.0},
                          .point = {GEAR_POSITION, R_W, 0.0}};
    gm_static_mesh mesh = {.shaft = {0, 0}, .contact = {contact}};
    return mesh; /* the mate does nothing: its contact is zero */
}

/* Radial and axial load, or the vector, of each bearing. */
static void solve(gm_bearing *bearings, int n, double F, double (*load)[2],
                  double (*vector)[3])
{
    gm_shaft shaft = {.y = 0.0, .z = 0.0};
    gm_description d = {.file = (char *)"test",
                        .n_shafts = 1,
                        .shafts = &shaft,
                        .n_bearings = n,
                        .bearings = bearings};
    gm_static_mesh mesh = hand_mesh();
    gm_load_row rows[4];
    assert_int_equal(gm_statics_solve(&d, 1, &mesh, 0, NULL, rows, NULL), GM_OK);
    for (int i = 0; i < n; i++) {
        if (load)
            gm_load_row_at(&rows[i], &F, &load[i][0], &load[i][1], NULL, NULL);
        if (vector)
            gm_load_row_vector(&rows[i], &F, vector[i]);
        gm_load_row_clear(&rows[i]);
    }
}

static void loads(gm_bearing *bearings, int n, double F, double (*load)[2])
{
    solve(bearings, n, F, load, NULL);
}

static void near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%.10g instead of %.10g", value, expected);
}

/* |A| = 1963.278 N, |B| = 1399.479 N: beam equations with the forces above. The printed
 * inputs carry seven digits, hence 1e-6. */
static void helical_pinion_on_two_bearings(void **state)
{
    (void)state;
    gm_bearing bearings[2] = {bearing_at(A_POSITION, 1), bearing_at(B_POSITION, 0)};
    double load[2][2];
    loads(bearings, 2, 1.0, load);
    near(load[0][0], 1963.278, 1e-6);
    near(load[1][0], 1399.479, 1e-6);
    near(load[0][1], F_A, 1e-9); /* the locating bearing takes all of it */
    assert_true(load[1][1] < 1e-6);
    double v[2][3]; /* tangential along z, separating along -y */
    solve(bearings, 2, 1.0, NULL, v);
    near(v[0][2], 1933.092, 1e-6);
    near(v[0][1], -342.948, 2e-6); /* a difference of two loads, six digits printed */
    near(v[1][2], 1159.855, 1e-6);
    near(v[1][1], -783.119, 1e-6);
}

/* Reversing the load turns F_t and F_a, not F_r: in the radial plane the moment F_a r now
 * acts the other way. */
static void reversed_load_keeps_the_separating_force(void **state)
{
    (void)state;
    gm_bearing bearings[2] = {bearing_at(A_POSITION, 1), bearing_at(B_POSITION, 0)};
    double load[2][2];
    loads(bearings, 2, -1.0, load);
    double length = B_POSITION - A_POSITION;
    double B_t = F_T * GEAR_POSITION / length, A_t = F_T - B_t;
    double B_e = (F_R * GEAR_POSITION - F_A * R_W) / length, A_e = F_R - B_e;
    near(load[0][0], hypot(A_t, A_e), 1e-9);
    near(load[1][0], hypot(B_t, B_e), 1e-9);
}

static void two_bearings_do_not_care_for_stiffness(void **state)
{
    (void)state;
    gm_bearing bearings[2] = {bearing_at(A_POSITION, 1), bearing_at(B_POSITION, 0)};
    double soft[2][2], stiff[2][2];
    bearings[0].radial_stiffness = 3e6;
    bearings[1].axial_stiffness = 1e3;
    loads(bearings, 2, 1.0, soft);
    bearings[0].radial_stiffness = 5e9;
    loads(bearings, 2, 1.0, stiff);
    for (int i = 0; i < 2; i++)
        near(soft[i][0], stiff[i][0], 1e-9);
}

/* Three equal springs under a rigid beam: by symmetry the middle one, under the load,
 * carries a third. */
static void three_bearings_share_by_stiffness(void **state)
{
    (void)state;
    gm_bearing bearings[3] = {bearing_at(GEAR_POSITION - 0.05, 1),
                              bearing_at(GEAR_POSITION, 0),
                              bearing_at(GEAR_POSITION + 0.05, 0)};
    double load[3][2];
    loads(bearings, 3, 1.0, load);
    near(load[1][0], hypot(F_T, F_R) / 3.0, 1e-9);
}

static void a_shaft_on_one_bearing_is_refused(void **state)
{
    (void)state;
    gm_shaft shaft = {.y = 0.0, .z = 0.0};
    gm_bearing bearing = bearing_at(0.0, 1);
    gm_description d = {.file = (char *)"box.yaml",
                        .n_shafts = 1,
                        .shafts = &shaft,
                        .n_bearings = 1,
                        .bearings = &bearing};
    gm_static_mesh mesh = hand_mesh();
    gm_load_row row;
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_statics_solve(&d, 1, &mesh, 0, NULL, &row, &error), GM_ERR_MODEL);
    assert_non_null(strstr(error.message, "box.yaml"));
}

static void weight_is_shared_by_lever(void **state)
{
    (void)state;
    gm_shaft shaft = {.y = 0.0, .z = 0.0};
    gm_bearing bearings[2] = {bearing_at(0.0, 1), bearing_at(0.1, 0)};
    gm_description d = {.file = (char *)"test",
                        .n_shafts = 1,
                        .shafts = &shaft,
                        .n_bearings = 2,
                        .bearings = bearings};
    gm_static_mass mass = {.shaft = 0, .position = 0.025, .mass = 4.0};
    gm_load_row rows[2];
    assert_int_equal(gm_statics_solve(&d, 0, NULL, 1, &mass, rows, NULL), GM_OK);
    near(rows[0].weight[2], -3.0 * 9.81, 1e-9);
    near(rows[1].weight[2], -1.0 * 9.81, 1e-9);
    gm_load_row_clear(&rows[0]);
    gm_load_row_clear(&rows[1]);
}

static void derivatives_are_those_of_the_loads(void **state)
{
    (void)state;
    gm_bearing bearings[2] = {bearing_at(A_POSITION, 1), bearing_at(B_POSITION, 0)};
    gm_shaft shaft = {.y = 0.0, .z = 0.0};
    gm_description d = {.file = (char *)"test",
                        .n_shafts = 1,
                        .shafts = &shaft,
                        .n_bearings = 2,
                        .bearings = bearings};
    gm_static_mesh mesh = hand_mesh();
    gm_static_mass mass = {.shaft = 0, .position = 0.025, .mass = 400.0};
    gm_load_row rows[2];
    assert_int_equal(gm_statics_solve(&d, 1, &mesh, 1, &mass, rows, NULL), GM_OK);
    for (int k = -1; k <= 1; k += 2)
        for (int i = 0; i < 2; i++) {
            double F = 0.7 * k, h = 1e-6, d_r, d_a, r, a, up[2], down[2];
            gm_load_row_at(&rows[i], &F, &r, &a, &d_r, &d_a);
            F += h;
            gm_load_row_at(&rows[i], &F, &up[0], &up[1], NULL, NULL);
            F -= 2.0 * h;
            gm_load_row_at(&rows[i], &F, &down[0], &down[1], NULL, NULL);
            /* 1e3 N over 1e-6: differences are good to about 1e-7 of the force scale */
            assert_true(fabs((up[0] - down[0]) / (2.0 * h) - d_r) < 1e-3);
            assert_true(fabs((up[1] - down[1]) / (2.0 * h) - d_a) < 1e-3);
        }
    gm_load_row_clear(&rows[0]);
    gm_load_row_clear(&rows[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(helical_pinion_on_two_bearings),
        cmocka_unit_test(reversed_load_keeps_the_separating_force),
        cmocka_unit_test(two_bearings_do_not_care_for_stiffness),
        cmocka_unit_test(three_bearings_share_by_stiffness),
        cmocka_unit_test(a_shaft_on_one_bearing_is_refused),
        cmocka_unit_test(weight_is_shared_by_lever),
        cmocka_unit_test(derivatives_are_those_of_the_loads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
