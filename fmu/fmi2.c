/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: life of an instance, and the steps of Co-Simulation. Calls are checked against
 * the state machines of FMI 2.0.3, sections 3.2.3 and 4.2.4. Memory is taken once, in
 * fmi2Instantiate, and for states that the host asks to keep (fmi2_saved.c); no other
 * call allocates or enters the system. Nothing is shared by instances, so different ones
 * may run in different threads.
 */
#include "fmi2_instance.h"

#include <stdlib.h>
#include <string.h>

/* What is always reported; the rest needs logging switched on. */
enum { ALWAYS_LOGGED = FMI2_LOG_WARNING | FMI2_LOG_DISCARD | FMI2_LOG_ERROR };

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* Before there is an instance: tell the host why there will be none. */
static fmi2Component refuse(const fmi2CallbackFunctions *host, const char *name,
                            const char *text)
{
    if (host && host->logger)
        host->logger(host->componentEnvironment, name ? name : "", fmi2Error,
                     "logStatusError", text);
    return NULL;
}

static const char *wrong_argument(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (!name || !*name)
        return "fmi2Instantiate: the instance name is missing";
    if (type != fmi2CoSimulation && type != fmi2ModelExchange)
        return "fmi2Instantiate: the type is neither Model Exchange nor Co-Simulation";
    if (!guid || strcmp(guid, gm_model_guid()) != 0)
        return "fmi2Instantiate: the GUID is not that of this FMU; modelDescription.xml "
               "and library do not belong together";
    return NULL;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType,
                              fmi2String fmuGUID, fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean loggingOn)
{
    (void)fmuResourceLocation; /* the tables are in the library */
    (void)visible;             /* there is nothing to show */
    if (!functions)
        return NULL;
    const char *wrong = wrong_argument(instanceName, fmuType, fmuGUID);
    if (wrong)
        return refuse(functions, instanceName, wrong);
    fmi2CallbackFunctions host = *functions;
    if (!host.allocateMemory || !host.freeMemory) {
        host.allocateMemory = calloc;
        host.freeMemory = free;
    }
    size_t length = strlen(instanceName) + 1;
    fmi2_instance *f = host.allocateMemory(1, sizeof *f + length);
    if (!f)
        return refuse(functions, instanceName, "fmi2Instantiate: out of memory");
    memset(f, 0, sizeof *f);
    memcpy(f->name, instanceName, length);
    f->host = host;
    f->logged = ALWAYS_LOGGED | (loggingOn ? (unsigned)FMI2_LOG_ALL : 0u);
    f->run.component.exchange = fmuType == fmi2ModelExchange;
    gm_run_reset(gm_model_map(), &f->run);
    return f;
}

void fmi2FreeInstance(fmi2Component c)
{
    fmi2_instance *f = c;
    if (f)
        f->host.freeMemory(f);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[])
{
    fmi2_instance *f = fmi2_enter(c, "fmi2SetDebugLogging", FMI2_PHASES_ANY);
    if (!f)
        return fmi2Error;
    if (nCategories > 0 && !categories)
        return fmi2_fail(f, "fmi2SetDebugLogging", "the array of categories is missing");
    fmi2Status status = fmi2OK;
    f->logged = ALWAYS_LOGGED;
    if (loggingOn && nCategories == 0)
        f->logged |= FMI2_LOG_ALL;
    for (size_t i = 0; i < nCategories; i++) {
        unsigned bit = fmi2_category_of(categories[i]);
        if (loggingOn)
            f->logged |= bit;
        if (bit)
            continue;
        fmi2_log(f, fmi2Warning, FMI2_LOG_WARNING,
                 "fmi2SetDebugLogging: there is no log category %s",
                 categories[i] ? categories[i] : "(null)");
        status = fmi2Warning;
    }
    return status;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined,
                               fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    fmi2_instance *f = fmi2_enter(c, "fmi2SetupExperiment", GM_PHASE_INSTANTIATED);
    (void)toleranceDefined; /* fixed steps: there is no error control */
    (void)tolerance;
    if (!f)
        return fmi2Error;
    if (!gm_number_is_finite(startTime))
        return fmi2_fail(f, "fmi2SetupExperiment", "the start time %g is not finite",
                         startTime);
    if (stopTimeDefined && !(stopTime >= startTime))
        return fmi2_fail(f, "fmi2SetupExperiment",
                         "the stop time %g is before the start time %g", stopTime,
                         startTime);
    f->run.experiment_set = true;
    f->run.time = startTime;
    f->run.stop_defined = stopTimeDefined != fmi2False;
    f->run.stop_time = stopTimeDefined ? stopTime : startTime;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    fmi2_instance *f =
        fmi2_enter(c, "fmi2EnterInitializationMode", GM_PHASE_INSTANTIATED);
    if (!f)
        return fmi2Error;
    if (!f->run.experiment_set)
        return fmi2_fail(f, "fmi2EnterInitializationMode",
                         "fmi2SetupExperiment has to be called before");
    f->run.phase = GM_PHASE_INITIALISATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    fmi2_instance *f =
        fmi2_enter(c, "fmi2ExitInitializationMode", GM_PHASE_INITIALISATION);
    if (!f)
        return fmi2Error;
    if (gm_run_start(gm_model_map(), &f->run))
        return fmi2_fail(f, "fmi2ExitInitializationMode",
                         "the start speeds are too large: output.w_start = %g",
                         f->run.component.value[GM_OUTPUT_W_START][0].real);
    f->run.phase = f->run.component.exchange ? GM_PHASE_EVENT : GM_PHASE_STEP;
    f->run.update_due = true;
    return fmi2_report(f, "fmi2ExitInitializationMode");
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    fmi2_instance *f = fmi2_enter(
        c, "fmi2Terminate", GM_PHASE_STEP | GM_PHASE_STEP_FAILED | FMI2_PHASES_EXCHANGE);
    if (!f)
        return fmi2Error;
    f->run.phase = GM_PHASE_TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    fmi2_instance *f = fmi2_enter(c, "fmi2Reset", FMI2_PHASES_ANY);
    if (!f)
        return fmi2Error;
    gm_run_reset(gm_model_map(), &f->run);
    return fmi2OK;
}

static fmi2Status refuse_step(fmi2_instance *f, gm_verdict verdict, double t, double h)
{
    static const char function[] = "fmi2DoStep";
    switch (verdict) {
    case GM_VERDICT_STEP_SIZE:
        return fmi2_fail(f, function,
                         "the communication step has to be positive and finite, not %g s",
                         h);
    case GM_VERDICT_TIME:
        return fmi2_fail(f, function,
                         "the step starts at %.15g s, but the last one ended at %.15g s",
                         t, f->run.time);
    case GM_VERDICT_STOP:
        return fmi2_fail(
            f, function,
            "the step from %.15g s by %g s goes beyond the stop time %.15g s", t, h,
            f->run.stop_time);
    default:
        f->run.phase = GM_PHASE_STEP_FAILED;
        fmi2_log(f, fmi2Discard, FMI2_LOG_DISCARD,
                 "fmi2DoStep: the step from %g s by %g s overflowed and was not done; "
                 "the torques are too large",
                 t, h);
        return fmi2Discard;
    }
}

/* The step with its shifts reported. */
static gm_verdict step_and_log(fmi2_instance *f, double t, double h)
{
    gm_path_state before[GM_MAX_PATHS];
    memcpy(before, f->run.component.state.path, sizeof before);
    gm_verdict verdict = gm_run_step(gm_model_map(), &f->run, t, h);
    if (verdict == GM_VERDICT_OK)
        fmi2_log_shifts(f, before);
    return verdict;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    fmi2_instance *f = fmi2_enter(c, "fmi2DoStep", GM_PHASE_STEP);
    const double t = currentCommunicationPoint, h = communicationStepSize;
    (void)noSetFMUStatePriorToCurrentPoint; /* no history is kept that it could free */
    if (!f)
        return fmi2Error;
    gm_verdict verdict = f->logged & (FMI2_LOG_EVENTS | FMI2_LOG_ALL)
                             ? step_and_log(f, t, h)
                             : gm_run_step(gm_model_map(), &f->run, t, h);
    return verdict ? refuse_step(f, verdict, t, h) : fmi2_report(f, "fmi2DoStep");
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    fmi2_instance *f = fmi2_enter(c, "fmi2CancelStep", FMI2_PHASES_ANY);
    if (!f)
        return fmi2Error;
    return fmi2_fail(f, "fmi2CancelStep",
                     "not allowed now: steps are never done in the background");
}
