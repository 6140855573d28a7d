/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/gm_foreign.h"

#include "base/alloc.h"
#include "plant/foreign_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Steps that a default experiment may ask for; others are about plots. */
static const double least_step = 1e-5, largest_step = 1e-2, usual_step = 1e-3;

static int ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

/* ---- a plug-in ---- */

static gm_status open_plugin(gm_foreign *f, gm_error *error)
{
    const gm_rig_file *file = f->file;
    size_t n = (size_t)file->n_parameters;
    f->names = gm_calloc(n, sizeof *f->names);
    f->values = gm_calloc(n, sizeof *f->values);
    if (!f->names || !f->values)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++) {
        const gm_rig_parameter *from = &file->parameters[i];
        f->names[i] = from->variable[0] ? from->variable : from->id.name;
        f->values[i] = file->parameters[i].value;
    }
    const gm_plugin_settings settings = {.oil_temperature = file->oil_temperature,
                                         .n_parameters = file->n_parameters,
                                         .names = f->names,
                                         .values = f->values,
                                         .step = file->experiments.step};
    gm_status status = gm_plugin_rig_open(file->model_path, &settings, &f->plugin, error);
    if (status != GM_OK)
        return status;
    f->rig = *gm_plugin_rig_interface(f->plugin);
    if (f->rig.n_paths == file->n_paths)
        return GM_OK;
    return gm_fail(error, GM_ERR_MODEL,
                   "%s: the plug-in has %d input paths, the rig file %d",
                   file->model_path, f->rig.n_paths, file->n_paths);
}

/* ---- an FMU ---- */

static void choose_mode(gm_foreign *f)
{
    int wanted = f->file->interface;
    f->mode = wanted == GM_RIG_MODEL_EXCHANGE ? FMI_EXCHANGE : FMI_STEPS;
    if (wanted == GM_RIG_ANY && !f->description.identifier)
        f->mode = FMI_EXCHANGE;
}

static double chosen_step(const gm_foreign *f)
{
    double asked = f->file->experiments.step, own = f->description.step;
    if (asked > 0.0)
        return asked;
    return own >= least_step && own <= largest_step ? own : usual_step;
}

static void describe(gm_foreign *f)
{
    const gm_rig_file *file = f->file;
    f->rig = (gm_rig){.is = &gm_foreign_rig_class,
                      .self = f,
                      .n_paths = file->n_paths,
                      .step = chosen_step(f)};
    f->rig.drive[0] = (gm_rig_drive)file->output.drive;
    for (int p = 0; p < file->n_paths; p++)
        f->rig.drive[1 + p] = (gm_rig_drive)file->paths[p].flange.drive;
    f->continuous = (gm_continuous){.is = &gm_foreign_continuous_class,
                                    .self = f,
                                    .n_paths = file->n_paths,
                                    .step = f->rig.step};
    memcpy(f->continuous.drive, f->rig.drive, sizeof f->rig.drive);
}

static gm_status open_fmu(gm_foreign *f, gm_error *error)
{
    char path[FMU_FOLDER_SIZE + 32];
    gm_status status = gm_fmu_unpack(f->file->model_path, f->folder, error);
    if (status != GM_OK)
        return status;
    (void)snprintf(path, sizeof path, "%s/modelDescription.xml", f->folder);
    status = gm_fmu_description_read(path, f->file->model_path, &f->description, error);
    if (status != GM_OK)
        return status;
    choose_mode(f);
    if (f->mode == FMI_STEPS ? !f->description.identifier
                             : !f->description.exchange_identifier)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the FMU does not offer %s",
                       f->file->model_path,
                       f->mode == FMI_STEPS ? "Co-Simulation" : "Model Exchange");
    describe(f);
    return gm_foreign_map(f, error);
}

/* ---- life ---- */

gm_status gm_foreign_open(const gm_rig_file *file, gm_foreign **foreign, gm_error *error)
{
    gm_foreign *f = gm_calloc(1, sizeof *f);
    if (!f)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    f->file = file;
    gm_status status =
        ends_with(file->model, ".fmu") ? open_fmu(f, error) : open_plugin(f, error);
    if (status == GM_OK)
        *foreign = f;
    else
        gm_foreign_close(f);
    return status;
}

void gm_foreign_close(gm_foreign *foreign)
{
    if (!foreign)
        return;
    gm_plugin_rig_close(foreign->plugin);
    gm_fmu_description_clear(&foreign->description);
    if (foreign->folder[0])
        gm_fmu_remove(foreign->folder);
    gm_free(foreign->names);
    gm_free(foreign->values);
    gm_free(foreign->parameters);
    gm_free(foreign);
}

const gm_rig *gm_foreign_rig(const gm_foreign *foreign)
{
    return foreign->plugin || foreign->mode == FMI_STEPS ? &foreign->rig : NULL;
}

const gm_continuous *gm_foreign_continuous(const gm_foreign *foreign)
{
    return gm_foreign_rig(foreign) ? NULL : &foreign->continuous;
}
