/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: the state of the FMU kept, restored and made into bytes (FMI 2.0.3, section
 * 2.1.8). A state is one block: a head with a magic number, the component's GUID and a
 * sum that finds damage, then numbers. The bytes are valid in every process that runs
 * this component on a platform with the same byte order.
 */
#include "fmi2_detailed.h"

#include "base/alloc.h"

#include <stdint.h>
#include <string.h>

#define MAGIC 0x314d4447u /* "GDM1" where the low byte comes first */
enum { N_OWN = 4 };       /* phase, time, experiment_set, update_due */

typedef struct saved_head {
    uint32_t magic, n; /* numbers that follow */
    uint64_t sum;
    char guid[GM_MOTION_GUID_SIZE];
} saved_head;

static int n_numbers(const detailed_instance *f)
{
    return N_OWN + gm_detailed_n_saved(f->gearset);
}

static size_t size_of(const detailed_instance *f)
{
    return sizeof(saved_head) + (size_t)n_numbers(f) * sizeof(double);
}

/* FNV-1a (RFC 9923) over 64-bit words. */
static uint64_t sum_of(const double *number, uint32_t n)
{
    uint64_t hash = 0xcbf29ce484222325u, word;
    for (uint32_t i = 0; i < n; i++) {
        memcpy(&word, &number[i], sizeof word);
        hash = (hash ^ word) * 0x100000001b3u;
    }
    return hash;
}

static double *numbers_of(void *state)
{
    return (double *)((char *)state + sizeof(saved_head));
}

static bool is_own(const detailed_instance *f, const void *state)
{
    const saved_head *head = state;
    return head->magic == MAGIC && head->n == (uint32_t)n_numbers(f) &&
           memcmp(head->guid, f->gearset->guid, sizeof head->guid) == 0;
}

/* The instance behind c if the state is whole and its own; else NULL after a message. */
static detailed_instance *enter(fmi2Component c, const char *function, fmi2FMUstate state)
{
    detailed_instance *f = detailed_enter(c, function, PHASES_ANY);
    if (!f)
        return NULL;
    if (!state)
        (void)detailed_fail(f, function, "the state is missing");
    else if (!is_own(f, state))
        (void)detailed_fail(f, function, "this is not a state that this FMU has saved");
    else if (((saved_head *)state)->sum !=
             sum_of(numbers_of(state), ((saved_head *)state)->n))
        (void)detailed_fail(f, function, "the state is damaged");
    else
        return f;
    return NULL;
}

static void save(const detailed_instance *f, void *state)
{
    saved_head *head = state;
    double *number = numbers_of(state);
    memset(head, 0, sizeof *head);
    head->magic = MAGIC;
    head->n = (uint32_t)n_numbers(f);
    memcpy(head->guid, f->gearset->guid, sizeof head->guid);
    number[0] = f->phase;
    number[1] = f->time;
    number[2] = f->experiment_set;
    number[3] = f->update_due;
    gm_detailed_save(f->gearset, number + N_OWN);
    head->sum = sum_of(number, head->n);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    static const char function[] = "fmi2GetFMUstate";
    detailed_instance *f = detailed_enter(c, function, PHASES_ANY);
    if (!f)
        return fmi2Error;
    if (!FMUstate)
        return detailed_fail(f, function,
                             "there is no place for the pointer to the state");
    if (*FMUstate && !is_own(f, *FMUstate))
        return detailed_fail(f, function, "this is not a state that this FMU has saved");
    void *state = *FMUstate ? *FMUstate : gm_calloc(1, size_of(f));
    if (!state)
        return detailed_fail(f, function, "out of memory");
    save(f, state);
    *FMUstate = state;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate)
{
    static const char function[] = "fmi2SetFMUstate";
    detailed_instance *f = enter(c, function, FMUstate);
    gm_error error;
    if (!f)
        return fmi2Error;
    const double *number = numbers_of(FMUstate);
    if (gm_detailed_restore(f->gearset, number + N_OWN, &error) != GM_OK)
        return detailed_fail(f, function, "%s", error.message);
    f->phase = (detailed_phase)number[0];
    f->time = number[1];
    f->experiment_set = number[2] != 0.0;
    f->update_due = number[3] != 0.0;
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    detailed_instance *f = detailed_enter(c, "fmi2FreeFMUstate", PHASES_ANY);
    if (!f)
        return fmi2Error;
    if (!FMUstate || !*FMUstate)
        return fmi2OK;
    if (!is_own(f, *FMUstate))
        return detailed_fail(f, "fmi2FreeFMUstate",
                             "this is not a state that this FMU has saved");
    gm_free(*FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate,
                                      size_t *size)
{
    static const char function[] = "fmi2SerializedFMUstateSize";
    detailed_instance *f = enter(c, function, FMUstate);
    if (!f)
        return fmi2Error;
    if (!size)
        return detailed_fail(f, function, "there is no place for the size");
    *size = size_of(f);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate,
                                 fmi2Byte serializedState[], size_t size)
{
    static const char function[] = "fmi2SerializeFMUstate";
    detailed_instance *f = enter(c, function, FMUstate);
    if (!f)
        return fmi2Error;
    if (!serializedState || size < size_of(f))
        return detailed_fail(f, function, "%zu bytes are needed, not %zu", size_of(f),
                             serializedState ? size : 0);
    memcpy(serializedState, FMUstate, size_of(f));
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[],
                                   size_t size, fmi2FMUstate *FMUstate)
{
    static const char function[] = "fmi2DeSerializeFMUstate";
    detailed_instance *f = detailed_enter(c, function, PHASES_ANY);
    if (!f)
        return fmi2Error;
    if (!serializedState || !FMUstate || size < size_of(f))
        return detailed_fail(f, function, "%zu bytes are needed, not %zu", size_of(f),
                             serializedState ? size : 0);
    void *state = gm_calloc(1, size_of(f));
    if (!state)
        return detailed_fail(f, function, "out of memory");
    memcpy(state, serializedState, size_of(f));
    if (!enter(c, function, state)) {
        gm_free(state);
        return fmi2Error;
    }
    gm_free(*FMUstate);
    *FMUstate = state;
    return fmi2OK;
}
