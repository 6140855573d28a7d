/* SPDX-License-Identifier: BSD-2-Clause
 *
 * First gear at a constant 1500 rpm with 20 N.m and 60 N.m at 5 Hz upon it at the input:
 * the torque reverses ten times a second and load losses follow it. Energy lost in the
 * detailed gearset and in the component, over whole periods after the start has settled.
 *
 *   oscillating_torque description.yaml component.fmu
 *
 * Prints a line for each: name, energy lost [J], difference to the detailed [%].
 */
#include "model/gm_gearset.h"
#include "plant/gm_builtin.h"
#include "plant/gm_fmu_motion.h"
#include "solve/gm_driven.h"

#include <math.h>
#include <stdio.h>

#define PI 3.14159265358979323846
#define SPEED (1500.0 * PI / 30.0) /* of the input, rad/s */
#define MEAN 20.0                  /* N.m */
#define SWING 60.0                 /* N.m */
#define FREQUENCY 5.0              /* Hz */
#define SETTLED 1.0                /* s */
#define END 3.0                    /* s: 10 periods later */

static double enter(void *user, double t, int *jump)
{
    (void)user;
    (void)t;
    *jump = 0;
    return (double)INFINITY;
}

/* user: ratio of first gear. */
static void at(void *user, double t, gm_drive_point *point)
{
    const double *ratio = user;
    *point = (gm_drive_point){.speed = {SPEED / *ratio}};
    point->input.torque[1] = MEAN + SWING * sin(2.0 * PI * FREQUENCY * t);
    point->input.gear[0] = 1;
}

static double lost(const gm_transient *transient)
{
    gm_transient_energy e = gm_transient_account(transient);
    return e.dissipated + e.impulses;
}

static gm_status integrate(gm_transient *transient, double *energy, gm_error *error)
{
    double before = 0.0;
    gm_status status = gm_transient_start(transient, 0.0, error);
    if (status == GM_OK)
        status = gm_transient_advance(transient, SETTLED, error);
    before = lost(transient);
    if (status == GM_OK)
        status = gm_transient_advance(transient, END, error);
    *energy = lost(transient) - before;
    return status;
}

static gm_status run(const gm_dynamics *dynamics, double ratio, double *energy,
                     gm_error *error)
{
    const gm_drive drive = {&ratio, {1}, enter, at};
    const gm_transient_options options = {.tolerance = 1e-6};
    const double start[GM_MAX_FLANGES] = {SPEED / ratio, SPEED};
    gm_driven *driven = NULL;
    gm_transient *transient = NULL;
    gm_status status = gm_driven_create(dynamics, &drive, 0.0, start, &driven, error);
    if (status == GM_OK) {
        const gm_transient_system system = gm_driven_system(driven);
        status = gm_transient_create(&system, &options, &transient, error);
    }
    if (status == GM_OK)
        status = integrate(transient, energy, error);
    gm_transient_destroy(transient);
    gm_driven_destroy(driven);
    return status;
}

static gm_status run_component(const char *fmu, gm_fmu_fidelity fidelity, double ratio,
                               double detailed, gm_error *error)
{
    gm_fmu_plant *plant = NULL;
    double energy = 0.0;
    gm_status status = gm_fmu_plant_create(fmu, fidelity, &plant, error);
    if (status == GM_OK) {
        const gm_dynamics dynamics = gm_fmu_plant_dynamics(plant);
        status = run(&dynamics, ratio, &energy, error);
    }
    gm_fmu_plant_destroy(plant);
    if (status == GM_OK)
        printf("%s %.6g %.4f\n", fidelity == GM_FMU_RIGID ? "rigid" : "lash", energy,
               100.0 * (energy / detailed - 1.0));
    return status;
}

static gm_status compare(const gm_gearset *gearset, const gm_plant *plant,
                         const char *fmu, gm_error *error)
{
    const int gear[GM_MAX_INPUT_PATHS] = {1};
    const gm_dynamics dynamics = gm_builtin_dynamics(gearset);
    gm_kinematics kinematics;
    double detailed = 0.0;
    gm_status status = plant->is->kinematics(plant->self, gear, &kinematics, error);
    if (status == GM_OK)
        status = run(&dynamics, kinematics.ratio[0], &detailed, error);
    if (status == GM_OK)
        printf("detailed %.6g 0\n", detailed);
    if (status == GM_OK)
        status = run_component(fmu, GM_FMU_RIGID, kinematics.ratio[0], detailed, error);
    if (status == GM_OK)
        status = run_component(fmu, GM_FMU_LASH, kinematics.ratio[0], detailed, error);
    return status;
}

static gm_status compare_files(const char *file, const char *fmu, gm_error *error)
{
    gm_description *description = NULL;
    gm_gearset *gearset = NULL;
    gm_plant *plant = NULL;
    gm_status status = gm_description_read(file, &description, error);
    if (status == GM_OK)
        status =
            gm_gearset_create(description, description->oil.temperature, &gearset, error);
    if (status == GM_OK)
        status = gm_builtin_create(gearset, &plant, error);
    if (status == GM_OK)
        status = compare(gearset, plant, fmu, error);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    return status;
}

int main(int argc, char **argv)
{
    gm_error error = {0};
    if (argc == 3 && compare_files(argv[1], argv[2], &error) == GM_OK)
        return 0;
    fprintf(stderr, "%s\n", argc == 3 ? error.message : "needs a description and an FMU");
    return 1;
}
