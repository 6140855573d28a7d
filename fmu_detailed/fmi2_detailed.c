/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: life of an instance. The gearset is the description in the FMU's resources,
 * read at instantiation; a GUID that is not that of this description is refused. Memory
 * is taken in fmi2Instantiate, for states that the host keeps, and where the oil gets
 * another temperature. Nothing is shared by instances.
 */
#include "fmi2_detailed.h"

#include "base/alloc.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 4096 };

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* ---- where the description is ---- */

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Path of a file URI (RFC 8089): file:/a, file:///a, file://localhost/a, with %XX.
 * Importers that give a plain path are understood too. False: it is none of these. */
static bool path_of_uri(const char *uri, char path[PATH_SIZE])
{
    size_t n = 0;
    bool plain = uri[0] == '/';
    if (!plain && strncmp(uri, "file:", 5) != 0)
        return false;
    const char *from = plain ? uri : uri + 5;
    if (!plain && strncmp(from, "//", 2) == 0)
        from = strchr(from + 2, '/');
    for (; from && *from && n < PATH_SIZE - 1; from++) {
        int high = -1, low = -1;
        if (!plain && *from == '%' && (high = hex_digit(from[1])) >= 0)
            low = hex_digit(from[2]);
        path[n++] = low >= 0 ? (char)(16 * high + low) : *from;
        from += low >= 0 ? 2 : 0;
    }
    path[n] = '\0';
    return from && !*from && n > 0;
}

static bool description_path(const char *uri, char path[PATH_SIZE])
{
    static const char file[] = "/gearset.yaml";
    if (!uri || !path_of_uri(uri, path))
        return false;
    size_t n = strlen(path);
    if (n + sizeof file > PATH_SIZE)
        return false;
    memcpy(path + n, file, sizeof file);
    return true;
}

/* ---- life ---- */

static const char *wrong_argument(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (!name || !*name)
        return "fmi2Instantiate: the instance name is missing";
    if (type != fmi2ModelExchange)
        return "fmi2Instantiate: the detailed gearset is for Model Exchange only";
    return guid ? NULL : "fmi2Instantiate: the GUID is missing";
}

static bool make_room(detailed_instance *f)
{
    const gm_detailed *g = f->gearset;
    size_t most = (size_t)(GM_VARIABLES * GM_DETAILED_PATHS + g->variables.n);
    f->unknown = gm_calloc(most, sizeof *f->unknown);
    f->along = gm_calloc((size_t)g->n_states, sizeof *f->along);
    return f->unknown && f->along;
}

/* Opens what the location holds; false after a message. */
static bool open_gearset(detailed_instance *f, const char *location, const char *guid)
{
    static const char function[] = "fmi2Instantiate";
    char path[PATH_SIZE];
    gm_error error;
    if (!description_path(location, path))
        return detailed_fail(f, function, "the resource location '%s' is not a file URI",
                             location ? location : "") == fmi2OK;
    if (gm_detailed_create(path, &f->gearset, &error) != GM_OK)
        return detailed_fail(f, function, "%s", error.message) == fmi2OK;
    if (strcmp(guid, f->gearset->guid) != 0)
        return detailed_fail(f, function,
                             "the GUID is not that of this FMU; modelDescription.xml, "
                             "library and resources/gearset.yaml do not belong "
                             "together") == fmi2OK;
    return make_room(f) || detailed_fail(f, function, "out of memory") == fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType,
                              fmi2String fmuGUID, fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean loggingOn)
{
    (void)visible; /* there is nothing to show */
    if (!functions)
        return NULL;
    const char *wrong = wrong_argument(instanceName, fmuType, fmuGUID);
    detailed_instance *f = wrong ? NULL : gm_calloc(1, sizeof *f);
    if (!f) {
        if (functions->logger)
            functions->logger(functions->componentEnvironment,
                              instanceName ? instanceName : "", fmi2Error,
                              "logStatusError",
                              wrong ? wrong : "fmi2Instantiate: out of memory");
        return NULL;
    }
    f->host = *functions;
    f->logged = LOG_ALWAYS | (loggingOn ? (unsigned)LOG_ALL : 0u);
    f->phase = PHASE_INSTANTIATED;
    f->name = gm_strdup(instanceName);
    if (!f->name || !open_gearset(f, fmuResourceLocation, fmuGUID)) {
        fmi2FreeInstance(f);
        return NULL;
    }
    return f;
}

void fmi2FreeInstance(fmi2Component c)
{
    detailed_instance *f = c;
    if (!f)
        return;
    gm_detailed_destroy(f->gearset);
    gm_free(f->unknown);
    gm_free(f->along);
    gm_free(f->name);
    gm_free(f);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[])
{
    static const char function[] = "fmi2SetDebugLogging";
    detailed_instance *f = detailed_enter(c, function, PHASES_ANY);
    fmi2Status status = fmi2OK;
    if (!f)
        return fmi2Error;
    if (nCategories > 0 && !categories)
        return detailed_fail(f, function, "the array of categories is missing");
    f->logged = LOG_ALWAYS;
    if (loggingOn && nCategories == 0)
        f->logged |= LOG_ALL;
    for (size_t i = 0; i < nCategories; i++) {
        unsigned bit = detailed_category_of(categories[i]);
        if (loggingOn)
            f->logged |= bit;
        if (!bit)
            status = detailed_log(f, fmi2Warning, LOG_WARNING,
                                  "%s: there is no log category %s", function,
                                  categories[i] ? categories[i] : "(null)");
    }
    return status;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined,
                               fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    static const char function[] = "fmi2SetupExperiment";
    detailed_instance *f = detailed_enter(c, function, PHASE_INSTANTIATED);
    (void)toleranceDefined; /* the solver outside has its own */
    (void)tolerance;
    if (!f)
        return fmi2Error;
    if (startTime - startTime != 0.0)
        return detailed_fail(f, function, "the start time %g is not finite", startTime);
    if (stopTimeDefined && !(stopTime >= startTime))
        return detailed_fail(f, function, "the stop time %g is before the start time %g",
                             stopTime, startTime);
    f->experiment_set = true;
    f->time = startTime;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    static const char function[] = "fmi2EnterInitializationMode";
    detailed_instance *f = detailed_enter(c, function, PHASE_INSTANTIATED);
    if (!f)
        return fmi2Error;
    if (!f->experiment_set)
        return detailed_fail(f, function, "fmi2SetupExperiment has to be called before");
    f->phase = PHASE_INITIALISATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    static const char function[] = "fmi2ExitInitializationMode";
    detailed_instance *f = detailed_enter(c, function, PHASE_INITIALISATION);
    if (!f || detailed_start(f, function))
        return fmi2Error;
    f->phase = PHASE_EVENT;
    f->update_due = true;
    return detailed_report_gears(f, function);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    detailed_instance *f = detailed_enter(c, "fmi2Terminate", PHASES_EXCHANGE);
    if (!f)
        return fmi2Error;
    f->phase = PHASE_TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    detailed_instance *f = detailed_enter(c, "fmi2Reset", PHASES_ANY);
    if (!f)
        return fmi2Error;
    gm_detailed_reset(f->gearset);
    memset(f->reported, 0, sizeof f->reported);
    f->experiment_set = f->update_due = false;
    f->time = 0.0;
    f->phase = PHASE_INSTANTIATED;
    return fmi2OK;
}
