/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: directional derivatives (FMI 2.0.3, section 2.1.9).
 */
#include "fmi2_instance.h"

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c,
                                        const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[])
{
    static const char function[] = "fmi2GetDirectionalDerivative";
    (void)vUnknown_ref;
    (void)nUnknown;
    (void)vKnown_ref;
    (void)nKnown;
    (void)dvKnown;
    (void)dvUnknown;
    fmi2_instance *f = fmi2_enter(c, function, FMI2_PHASES_ANY);
    return f ? fmi2_fail(f, function, "this FMU does not have the capability")
             : fmi2Error;
}
