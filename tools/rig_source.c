/* SPDX-License-Identifier: BSD-2-Clause */
#include "rig_source.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

static const gm_rig *choose_rig(gm_rig_source *s)
{
    const gm_rig *rig = gm_foreign_rig(s->foreign);
    if (rig)
        return rig;
    gm_continuous_rig_init(&s->continuous, gm_foreign_continuous(s->foreign),
                           s->file->experiments.tolerance);
    return &s->continuous.rig;
}

/* What the user chose goes before what the rig file says. */
static gm_status choose(gm_rig_source *s, const gm_experiment_choice *how,
                        gm_error *error)
{
    const gm_rig_experiments *e = &s->file->experiments;
    s->how =
        (gm_experiment_choice){.losses = e->ramps ? GM_LOSSES_RAMP : GM_LOSSES_SETTLE,
                               .inertia = GM_INERTIA_RAMPS,
                               .dwell = e->dwell,
                               .ramp_time = e->ramp_time};
    if (!how)
        return GM_OK;
    if (how->losses == GM_LOSSES_STEADY)
        return gm_fail(
            error, GM_ERR_ARGUMENT,
            "%s: a foreign model can only be simulated, there is no balance to "
            "solve for losses steady; settle and ramp are possible",
            s->file->model_path);
    if (how->inertia == GM_INERTIA_MATRIX)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "%s: a foreign model has no mass matrix that could be read; "
                       "inertia ramps is possible",
                       s->file->model_path);
    if (how->losses != GM_LOSSES_AUTO)
        s->how.losses = how->losses;
    if (how->dwell > 0.0)
        s->how.dwell = how->dwell;
    if (how->ramp_time > 0.0)
        s->how.ramp_time = how->ramp_time;
    return GM_OK;
}

static gm_status identify(gm_rig_source *s, gm_error *error)
{
    const gm_rig_experiments *e = &s->file->experiments;
    gm_plant_info info = gm_rig_file_info(s->file, s->gears);
    gm_rig_settings settings = {.dwell = s->how.dwell,
                                .ramp_time = s->how.ramp_time,
                                .losses_by_ramps = s->how.losses == GM_LOSSES_RAMP,
                                .creep = e->creep,
                                .time_limit = e->time_limit};
    gm_error why = {GM_OK, ""};
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        settings.inertia[p] =
            p < s->file->n_paths ? s->file->paths[p].inertia : (double)NAN;
    gm_status status =
        gm_rig_plant_create(choose_rig(s), &info, &settings, &s->plant, &s->report, &why);
    return status == GM_OK
               ? status
               : gm_fail(error, status, "%s: %s", s->file->model_path, why.message);
}

gm_status gm_rig_source_open(const char *path, double oil_temperature,
                             const gm_experiment_choice *how, gm_rig_source **source,
                             gm_error *error)
{
    gm_rig_source *s = gm_calloc(1, sizeof *s);
    if (!s)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = gm_rig_file_read(path, &s->file, error);
    if (status == GM_OK && !isnan(oil_temperature))
        s->file->oil_temperature = oil_temperature;
    if (status == GM_OK)
        status = choose(s, how, error);
    if (status == GM_OK)
        status = gm_foreign_open(s->file, &s->foreign, error);
    if (status == GM_OK)
        status = identify(s, error);
    if (status == GM_OK)
        *source = s;
    else
        gm_rig_source_close(s);
    return status;
}

/* Plug-ins always get it. */
bool gm_rig_source_takes_oil(const gm_rig_source *source)
{
    const char *ending = strrchr(source->file->model, '.');
    return source->file->oil.variable || !ending || strcmp(ending, ".fmu") != 0;
}

void gm_rig_source_close(gm_rig_source *source)
{
    if (!source)
        return;
    gm_rig_plant_destroy(source->plant);
    gm_foreign_close(source->foreign);
    gm_rig_file_destroy(source->file);
    gm_free(source);
}
