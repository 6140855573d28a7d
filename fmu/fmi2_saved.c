/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: the state of the FMU kept, restored and made into bytes (FMI 2.0.3, section
 * 2.1.8). Allowed whenever no step is in progress (section 4.2.4), also after an error:
 * restoring an earlier state is then a way out. A state is one block of the host's
 * memory; what is refused changes nothing but the phase, which after fmi2Error is
 * "error".
 */
#include "fmi2_instance.h"
#include "gm_saved.h"

#include <string.h>

static fmi2Status refuse(fmi2_instance *f, const char *function, gm_saved_verdict verdict)
{
    switch (verdict) {
    case GM_SAVED_FOREIGN:
        return fmi2_fail(f, function, "this is not a state that this FMU has saved");
    case GM_SAVED_OTHER_FMU:
        return fmi2_fail(f, function, "the state is that of another FMU");
    case GM_SAVED_OTHER_TYPE:
        return fmi2_fail(f, function,
                         "the state is that of an instance for %s, this one is not",
                         f->run.component.exchange ? "Co-Simulation" : "Model Exchange");
    default:
        return fmi2_fail(f, function, "the state is damaged");
    }
}

/* The instance behind c if the state is one that it may take; else NULL after a message.
 */
static fmi2_instance *enter(fmi2Component c, const char *function, fmi2FMUstate state)
{
    fmi2_instance *f = fmi2_enter(c, function, FMI2_PHASES_ANY);
    if (!f)
        return NULL;
    if (!state) {
        fmi2_fail(f, function, "the state is missing");
        return NULL;
    }
    gm_saved_verdict verdict = gm_saved_check(gm_model_guid(), state);
    if (!verdict)
        return f;
    refuse(f, function, verdict);
    return NULL;
}

/* Where a state goes: the host's block if it has one already, else a new one; NULL after
 * a message. */
static gm_saved *block_of(fmi2_instance *f, const char *function, fmi2FMUstate *state)
{
    if (!state) {
        fmi2_fail(f, function, "there is no place for the pointer to the state");
        return NULL;
    }
    gm_saved *saved = *state;
    if (saved) {
        gm_saved_verdict verdict = gm_saved_owner(gm_model_guid(), saved);
        if (!verdict)
            return saved;
        refuse(f, function, verdict);
        return NULL;
    }
    saved = f->host.allocateMemory(1, sizeof *saved);
    if (!saved)
        fmi2_fail(f, function, "out of memory");
    return saved;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    fmi2_instance *f = fmi2_enter(c, "fmi2GetFMUstate", FMI2_PHASES_ANY);
    gm_saved *saved = f ? block_of(f, "fmi2GetFMUstate", FMUstate) : NULL;
    if (!saved)
        return fmi2Error;
    gm_saved_make(gm_model_guid(), &f->run, saved);
    *FMUstate = saved;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate)
{
    fmi2_instance *f = enter(c, "fmi2SetFMUstate", FMUstate);
    if (!f)
        return fmi2Error;
    gm_saved_verdict verdict = gm_saved_fits(FMUstate, &f->run);
    if (verdict)
        return refuse(f, "fmi2SetFMUstate", verdict);
    gm_saved_restore(FMUstate, &f->run);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    fmi2_instance *f = fmi2_enter(c, "fmi2FreeFMUstate", FMI2_PHASES_ANY);
    if (!f)
        return fmi2Error;
    if (!FMUstate || !*FMUstate)
        return fmi2OK;
    gm_saved_verdict verdict = gm_saved_owner(gm_model_guid(), *FMUstate);
    if (verdict)
        return refuse(f, "fmi2FreeFMUstate", verdict);
    f->host.freeMemory(*FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate,
                                      size_t *size)
{
    static const char function[] = "fmi2SerializedFMUstateSize";
    fmi2_instance *f = enter(c, function, FMUstate);
    if (!f)
        return fmi2Error;
    if (!size)
        return fmi2_fail(f, function, "there is no place for the size");
    *size = sizeof(gm_saved);
    return fmi2OK;
}

/* An array of bytes for one state. */
static fmi2Status check_bytes(fmi2_instance *f, const char *function, const void *bytes,
                              size_t size)
{
    if (!bytes)
        return fmi2_fail(f, function, "the array of bytes is missing");
    if (size != sizeof(gm_saved))
        return fmi2_fail(f, function, "a state has %lu bytes, not %lu",
                         (unsigned long)sizeof(gm_saved), (unsigned long)size);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate,
                                 fmi2Byte serializedState[], size_t size)
{
    fmi2_instance *f = enter(c, "fmi2SerializeFMUstate", FMUstate);
    if (!f || check_bytes(f, "fmi2SerializeFMUstate", serializedState, size))
        return fmi2Error;
    memcpy(serializedState, FMUstate, sizeof(gm_saved));
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[],
                                   size_t size, fmi2FMUstate *FMUstate)
{
    static const char function[] = "fmi2DeSerializeFMUstate";
    gm_saved saved;
    fmi2_instance *f = fmi2_enter(c, function, FMI2_PHASES_ANY);
    if (!f || check_bytes(f, function, serializedState, size))
        return fmi2Error;
    memcpy(&saved, serializedState, sizeof saved); /* bytes need not be aligned */
    gm_saved_verdict verdict = gm_saved_check(gm_model_guid(), &saved);
    if (verdict)
        return refuse(f, function, verdict);
    gm_saved *block = block_of(f, function, FMUstate);
    if (!block)
        return fmi2Error;
    *block = saved;
    *FMUstate = block;
    return fmi2OK;
}
