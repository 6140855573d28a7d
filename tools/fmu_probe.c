/* SPDX-License-Identifier: BSD-2-Clause
 *
 * One steady point of the FMU: reset; gears, start speeds of the independent shafts and
 * torques; initialise; read. The output torque given is the detailed gearset's, so that
 * the FMU is as good as unaccelerated and the transmitted torque is the flange's. In
 * fidelity rigid: lash loses the same in steady motion, but would have to wind up first.
 */
#include "fmu_probe.h"

#include "base/alloc.h"
#include "core/gm_reduced.h"

#include <stdio.h>

#define NAME 64

typedef struct path_variables {
    const char *name;
    unsigned tau, gear, gear_refused, w_start, loss_torque;
} path_variables;

struct gm_fmu_probe {
    gm_fmu *fmu;
    int n_paths;
    path_variables path[GM_MAX_INPUT_PATHS];
    unsigned fidelity, output_tau, output_w_start, output_loss_torque, loss_power, oil;
};

static gm_status find(const gm_fmu *fmu, const char *path, const char *variable,
                      unsigned *reference, gm_error *error)
{
    char name[NAME];
    (void)snprintf(name, sizeof name, "%s%s%s", path, *path ? "." : "", variable);
    return gm_fmu_find(fmu, name, reference, error);
}

/* Start speed of a flange, which one whose speed is an input does not have. */
static gm_status find_start(const gm_fmu *fmu, const char *flange, unsigned *reference,
                            gm_error *error)
{
    char speed[NAME], start[NAME];
    (void)snprintf(speed, sizeof speed, "%s.w", flange);
    (void)snprintf(start, sizeof start, "%s.w_start", flange);
    if (gm_fmu_has(fmu, speed) && !gm_fmu_has(fmu, start))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the speed of %s is an input; FMUs are verified with torques "
                       "in and speeds out at every flange",
                       gm_fmu_path(fmu), flange);
    return gm_fmu_find(fmu, start, reference, error);
}

static gm_status find_path(gm_fmu_probe *probe, int p, const char *path, gm_error *error)
{
    path_variables *v = &probe->path[p];
    v->name = path;
    gm_status status = find(probe->fmu, path, "tau", &v->tau, error);
    if (status == GM_OK)
        status = find(probe->fmu, path, "gear", &v->gear, error);
    if (status == GM_OK)
        status = find(probe->fmu, path, "gear_refused", &v->gear_refused, error);
    if (status == GM_OK)
        status = find_start(probe->fmu, path, &v->w_start, error);
    if (status == GM_OK)
        status = find(probe->fmu, path, "loss_torque", &v->loss_torque, error);
    return status;
}

static gm_status find_output(gm_fmu_probe *probe, gm_error *error)
{
    const gm_fmu *fmu = probe->fmu;
    gm_status status = find(fmu, "output", "tau", &probe->output_tau, error);
    if (status == GM_OK)
        status = find_start(fmu, "output", &probe->output_w_start, error);
    if (status == GM_OK)
        status = find(fmu, "output", "loss_torque", &probe->output_loss_torque, error);
    if (status == GM_OK)
        status = find(fmu, "", "loss_power", &probe->loss_power, error);
    if (status == GM_OK)
        status = find(fmu, "", "fidelity", &probe->fidelity, error);
    if (status == GM_OK)
        status = find(fmu, "", "oil_temperature", &probe->oil, error);
    return status;
}

/* An FMU of another gearset may have more paths than the plant: that must not pass. */
static gm_status check_paths(const gm_fmu *fmu, const gm_plant *plant, gm_error *error)
{
    static const char *const tau[] = {"input.tau", "odd.tau", "even.tau"};
    int n = 0;
    for (int i = 0; i < 3; i++)
        n += gm_fmu_has(fmu, tau[i]);
    if (n != plant->info.n_paths)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s: has %d input flange%s where the gearset %s has %d",
                       gm_fmu_path(fmu), n, n == 1 ? "" : "s", plant->info.name,
                       plant->info.n_paths);
    return GM_OK;
}

static gm_status find_variables(gm_fmu_probe *probe, const gm_plant *plant,
                                gm_error *error)
{
    gm_status status = check_paths(probe->fmu, plant, error);
    probe->n_paths = plant->info.n_paths;
    for (int p = 0; status == GM_OK && p < probe->n_paths; p++)
        status = find_path(probe, p, plant->info.path[p].name, error);
    return status == GM_OK ? find_output(probe, error) : status;
}

gm_status gm_fmu_probe_create(gm_fmu *fmu, const gm_plant *plant, gm_fmu_probe **probe,
                              gm_error *error)
{
    gm_fmu_probe *made = gm_calloc(1, sizeof *made);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "%s: out of memory", gm_fmu_path(fmu));
    made->fmu = fmu;
    gm_status status = find_variables(made, plant, error);
    if (status == GM_OK)
        *probe = made;
    else
        gm_fmu_probe_destroy(made);
    return status;
}

void gm_fmu_probe_destroy(gm_fmu_probe *probe)
{
    gm_free(probe);
}

static gm_status set_path(gm_fmu_probe *probe, int p, const gm_steady_point *point,
                          gm_error *error)
{
    const path_variables *v = &probe->path[p];
    const int engaged = point->gear[p] != 0;
    gm_status status = gm_fmu_set_integer(probe->fmu, v->gear, point->gear[p], error);
    if (status == GM_OK)
        status = gm_fmu_set_real(probe->fmu, v->tau, engaged ? point->torque[1 + p] : 0.0,
                                 error);
    if (status == GM_OK && !engaged)
        status = gm_fmu_set_real(probe->fmu, v->w_start, point->speed[1 + p], error);
    return status;
}

static gm_status set_point(gm_fmu_probe *probe, double oil, const gm_steady_point *point,
                           double output_torque, gm_error *error)
{
    gm_status status = gm_fmu_reset(probe->fmu, error);
    if (status == GM_OK)
        status = gm_fmu_set_integer(probe->fmu, probe->fidelity, GM_RIGID, error);
    if (status == GM_OK)
        status = gm_fmu_set_real(probe->fmu, probe->oil, oil, error);
    if (status == GM_OK)
        status =
            gm_fmu_set_real(probe->fmu, probe->output_w_start, point->speed[0], error);
    if (status == GM_OK)
        status = gm_fmu_set_real(probe->fmu, probe->output_tau, output_torque, error);
    for (int p = 0; status == GM_OK && p < probe->n_paths; p++)
        status = set_path(probe, p, point, error);
    if (status == GM_OK)
        status = gm_fmu_initialise(probe->fmu, error);
    return status == GM_OK ? gm_fmu_start(probe->fmu, error) : status;
}

/* A gear that the component does not have is not refused by a call: it stays in the gear
 * that it was in, and says so. */
static gm_status check_gears(gm_fmu_probe *probe, const gm_steady_point *point,
                             gm_error *error)
{
    gm_status status = GM_OK;
    for (int p = 0; status == GM_OK && p < probe->n_paths; p++) {
        const path_variables *v = &probe->path[p];
        int refused = 0;
        status = gm_fmu_get_boolean(probe->fmu, v->gear_refused, &refused, error);
        if (status == GM_OK && refused)
            status = gm_fail(error, GM_ERR_MODEL, "%s: has no gear %d on path %s",
                             gm_fmu_path(probe->fmu), point->gear[p], v->name);
    }
    return status;
}

static gm_status read_answer(gm_fmu_probe *probe, const gm_steady_point *point,
                             gm_reduced_answer *answer, gm_error *error)
{
    gm_reduced_answer a = {0};
    gm_status status =
        gm_fmu_get_real(probe->fmu, probe->loss_power, &a.loss_power, error);
    if (status == GM_OK)
        status = gm_fmu_get_real(probe->fmu, probe->output_loss_torque,
                                 &a.output_reaction, error);
    for (int p = 0; status == GM_OK && p < probe->n_paths; p++)
        if (point->gear[p] == 0)
            status = gm_fmu_get_real(probe->fmu, probe->path[p].loss_torque,
                                     &a.path_drag[p], error);
    if (status == GM_OK)
        *answer = a;
    return status;
}

static gm_status probe_at(void *self, double oil, const gm_steady_point *point,
                          double output_torque, gm_reduced_answer *answer,
                          gm_error *error)
{
    gm_fmu_probe *probe = self;
    gm_status status = set_point(probe, oil, point, output_torque, error);
    if (status == GM_OK)
        status = check_gears(probe, point, error);
    return status == GM_OK ? read_answer(probe, point, answer, error) : status;
}

gm_reduced_probe gm_fmu_probe_interface(gm_fmu_probe *probe)
{
    return (gm_reduced_probe){.at = probe_at, .self = probe};
}
