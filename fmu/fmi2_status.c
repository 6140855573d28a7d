/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0 Co-Simulation: questions about the last step (FMI 2.0.3, section 4.2.3).
 */
#include "fmi2_instance.h"

enum { PHASES_STATUS = GM_PHASE_STEP | GM_PHASE_STEP_FAILED | GM_PHASE_TERMINATED };

/* Discard: this status is not available, everything else goes on. */
static fmi2Status not_available(fmi2_instance *f, const char *function, int kind)
{
    fmi2_log(
        f, fmi2Discard, FMI2_LOG_DISCARD,
        "%s: status kind %d is not available: steps are never done in the background",
        function, kind);
    return fmi2Discard;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value)
{
    fmi2_instance *f = fmi2_enter_slave(c, "fmi2GetStatus", PHASES_STATUS);
    (void)value;
    return f ? not_available(f, "fmi2GetStatus", (int)s) : fmi2Error;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value)
{
    fmi2_instance *f = fmi2_enter_slave(c, "fmi2GetRealStatus", PHASES_STATUS);
    if (!f)
        return fmi2Error;
    if (s != fmi2LastSuccessfulTime || !value)
        return not_available(f, "fmi2GetRealStatus", (int)s);
    *value = f->run.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s,
                                fmi2Integer *value)
{
    fmi2_instance *f = fmi2_enter_slave(c, "fmi2GetIntegerStatus", PHASES_STATUS);
    (void)value;
    return f ? not_available(f, "fmi2GetIntegerStatus", (int)s) : fmi2Error;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s,
                                fmi2Boolean *value)
{
    fmi2_instance *f = fmi2_enter_slave(c, "fmi2GetBooleanStatus", PHASES_STATUS);
    if (!f)
        return fmi2Error;
    if (s != fmi2Terminated || !value)
        return not_available(f, "fmi2GetBooleanStatus", (int)s);
    *value = fmi2False; /* the component never asks to end the simulation */
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value)
{
    fmi2_instance *f = fmi2_enter_slave(c, "fmi2GetStringStatus", PHASES_STATUS);
    (void)value;
    return f ? not_available(f, "fmi2GetStringStatus", (int)s) : fmi2Error;
}
