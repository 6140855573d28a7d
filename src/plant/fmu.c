/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/gm_fmu.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "plant/fmu_archive.h"
#include "plant/fmu_parts.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The FMU says why; kept for the sentence that follows. */
static void keep_message(fmi2ComponentEnvironment environment, fmi2String name,
                         fmi2Status status, fmi2String category, fmi2String message, ...)
{
    gm_fmu *fmu = environment;
    va_list arguments;
    (void)name;
    (void)status;
    (void)category;
    va_start(arguments, message);
    vsnprintf(fmu->message, sizeof fmu->message, message, arguments);
    va_end(arguments);
}

static gm_status instantiate(gm_fmu *fmu, fmi2Type type, const char *identifier,
                             gm_error *error)
{
    char place[FMU_FOLDER_SIZE + 32];
    snprintf(place, sizeof place, "file://%s/resources", fmu->folder);
    fmu->callbacks = (fmi2CallbackFunctions){.logger = keep_message,
                                             .allocateMemory = calloc,
                                             .freeMemory = free,
                                             .componentEnvironment = fmu};
    fmu->component = fmu->library.Instantiate(identifier, type, fmu->description.guid,
                                              place, &fmu->callbacks, 0, 0);
    if (fmu->component)
        return GM_OK;
    return gm_fail(error, GM_ERR_TOOL, "%s: the FMU cannot be instantiated%s%s",
                   fmu->path, fmu->message[0] ? ": " : "", fmu->message);
}

static gm_status unpack(gm_fmu *fmu, gm_error *error)
{
    char path[FMU_FOLDER_SIZE + 32];
    gm_status status = gm_fmu_unpack(fmu->path, fmu->folder, error);
    if (status != GM_OK)
        return status;
    snprintf(path, sizeof path, "%s/modelDescription.xml", fmu->folder);
    status = gm_fmu_description_read(path, fmu->path, &fmu->description, error);
    if (status == GM_OK && fmu->description.version != 2)
        status = gm_fail(error, GM_ERR_FORMAT, "%s: is not an FMU of FMI 2.0", fmu->path);
    return status;
}

static gm_status load(gm_fmu *fmu, fmi2Type type, const char *identifier, gm_error *error)
{
    gm_status status =
        gm_fmu_library_load(fmu->folder, identifier, fmu->path, &fmu->library, error);
    return status == GM_OK ? instantiate(fmu, type, identifier, error) : status;
}

static gm_status open_steps(gm_fmu *fmu, gm_error *error)
{
    gm_status status = unpack(fmu, error);
    if (status != GM_OK)
        return status;
    if (!fmu->description.identifier)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the FMU does not offer Co-Simulation",
                       fmu->path);
    return load(fmu, fmi2CoSimulation, fmu->description.identifier, error);
}

static gm_status open_exchange(gm_fmu *fmu, gm_error *error)
{
    gm_status status = unpack(fmu, error);
    if (status != GM_OK)
        return status;
    if (!fmu->description.exchange_identifier)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the FMU does not offer Model Exchange",
                       fmu->path);
    status = load(fmu, fmi2ModelExchange, fmu->description.exchange_identifier, error);
    if (status == GM_OK && !gm_fmu_library_exchanges(&fmu->library))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the FMU's library lacks functions of Model Exchange",
                       fmu->path);
    return status;
}

static gm_status open_by(gm_status (*steps)(gm_fmu *, gm_error *), const char *path,
                         gm_fmu **fmu, gm_error *error)
{
    gm_fmu *opened = gm_calloc(1, sizeof *opened);
    if (opened)
        opened->path = gm_strdup(path);
    if (!opened || !opened->path) {
        gm_fmu_close(opened);
        return gm_fail(error, GM_ERR_MEMORY, "no memory to open %s", path);
    }
    gm_status status = steps(opened, error);
    if (status == GM_OK)
        *fmu = opened;
    else
        gm_fmu_close(opened);
    return status;
}

gm_status gm_fmu_open(const char *path, gm_fmu **fmu, gm_error *error)
{
    return open_by(open_steps, path, fmu, error);
}

gm_status gm_fmu_open_exchange(const char *path, gm_fmu **fmu, gm_error *error)
{
    return open_by(open_exchange, path, fmu, error);
}

void gm_fmu_close(gm_fmu *fmu)
{
    if (!fmu)
        return;
    if (fmu->component)
        fmu->library.FreeInstance(fmu->component);
    gm_fmu_library_close(&fmu->library);
    gm_fmu_description_clear(&fmu->description);
    if (fmu->folder[0])
        gm_fmu_remove(fmu->folder);
    gm_free(fmu->path);
    gm_free(fmu);
}

gm_fmu_origin gm_fmu_read_origin(const gm_fmu *fmu)
{
    const fmu_description *d = &fmu->description;
    return (gm_fmu_origin){d->source_sha256, d->map_hash, d->oil_temperature,
                           d->n_oil,         d->oil,      d->guid};
}

gm_status gm_fmu_hash_library(const gm_fmu *fmu, char text[65], gm_error *error)
{
    return gm_sha256_file(fmu->library.path, text, error);
}

const char *gm_fmu_path(const gm_fmu *fmu)
{
    return fmu->path;
}

gm_status gm_fmu_find(const gm_fmu *fmu, const char *name, unsigned *reference,
                      gm_error *error)
{
    const fmu_variable *variable = gm_fmu_description_find(&fmu->description, name);
    if (!variable)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the FMU has no variable %s", fmu->path,
                       name);
    *reference = variable->reference;
    return GM_OK;
}

int gm_fmu_has(const gm_fmu *fmu, const char *name)
{
    return gm_fmu_description_find(&fmu->description, name) != NULL;
}

gm_status gm_fmu_checked(gm_fmu *fmu, const char *function, fmi2Status status,
                         gm_error *error)
{
    if (status == fmi2OK || status == fmi2Warning)
        return GM_OK;
    return gm_fail(error, GM_ERR_TOOL, "%s: %s failed%s%s", fmu->path, function,
                   fmu->message[0] ? ": " : "", fmu->message);
}

gm_status gm_fmu_set_real(gm_fmu *fmu, unsigned reference, double value, gm_error *error)
{
    return gm_fmu_checked(fmu, "fmi2SetReal",
                          fmu->library.SetReal(fmu->component, &reference, 1, &value),
                          error);
}

gm_status gm_fmu_set_integer(gm_fmu *fmu, unsigned reference, int value, gm_error *error)
{
    return gm_fmu_checked(fmu, "fmi2SetInteger",
                          fmu->library.SetInteger(fmu->component, &reference, 1, &value),
                          error);
}

gm_status gm_fmu_get_real(gm_fmu *fmu, unsigned reference, double *value, gm_error *error)
{
    double got = 0.0;
    gm_status status =
        gm_fmu_checked(fmu, "fmi2GetReal",
                       fmu->library.GetReal(fmu->component, &reference, 1, &got), error);
    if (status == GM_OK)
        *value = got;
    return status;
}

gm_status gm_fmu_get_boolean(gm_fmu *fmu, unsigned reference, int *value, gm_error *error)
{
    fmi2Boolean got = fmi2False;
    gm_status status = gm_fmu_checked(
        fmu, "fmi2GetBoolean",
        fmu->library.GetBoolean(fmu->component, &reference, 1, &got), error);
    if (status == GM_OK)
        *value = got != fmi2False;
    return status;
}

gm_status gm_fmu_reset(gm_fmu *fmu, gm_error *error)
{
    return gm_fmu_checked(fmu, "fmi2Reset", fmu->library.Reset(fmu->component), error);
}

gm_status gm_fmu_initialise(gm_fmu *fmu, gm_error *error)
{
    gm_status status = gm_fmu_checked(
        fmu, "fmi2SetupExperiment",
        fmu->library.SetupExperiment(fmu->component, fmi2False, 0.0, 0.0, fmi2False, 0.0),
        error);
    if (status != GM_OK)
        return status;
    return gm_fmu_checked(fmu, "fmi2EnterInitializationMode",
                          fmu->library.EnterInitializationMode(fmu->component), error);
}

gm_status gm_fmu_start(gm_fmu *fmu, gm_error *error)
{
    return gm_fmu_checked(fmu, "fmi2ExitInitializationMode",
                          fmu->library.ExitInitializationMode(fmu->component), error);
}

gm_status gm_fmu_step(gm_fmu *fmu, double t, double h, gm_error *error)
{
    return gm_fmu_checked(fmu, "fmi2DoStep",
                          fmu->library.DoStep(fmu->component, t, h, fmi2True), error);
}
