/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An FMI 2.0 instance: the run, which can be saved and restored, and what belongs to
 * the host. Messages and the check of the call order are here, for all fmi2*.c.
 *
 * After fmi2Error an instance is in the phase "error": values may still be read, and
 * fmi2SetFMUstate, fmi2Reset or fmi2FreeInstance are the ways out (FMI 2.0.3,
 * sections 2.1.3 and 4.2.4).
 */
#ifndef FMI2_INSTANCE_H
#define FMI2_INSTANCE_H

#include "fmi2Functions.h"
#include "gm_model.h"
#include "gm_run.h"

#if defined(__GNUC__)
#define FMI2_PRINTF(format_index, first)                                                 \
    __attribute__((format(printf, format_index, first)))
#else
#define FMI2_PRINTF(format_index, first)
#endif

/** Bits of the log categories; names in fmi2_instance.c and in modelDescription.xml. */
typedef enum fmi2_category {
    FMI2_LOG_WARNING = 1, /* logStatusWarning */
    FMI2_LOG_DISCARD = 2, /* logStatusDiscard */
    FMI2_LOG_ERROR = 4,   /* logStatusError */
    FMI2_LOG_EVENTS = 8,  /* logEvents: shifts */
    FMI2_LOG_ALL = 16     /* logAll */
} fmi2_category;

typedef struct fmi2_instance {
    gm_run run;
    fmi2CallbackFunctions host;
    unsigned logged; /* categories that are reported */
    char name[];     /* given by the host */
} fmi2_instance;

/** Phases in which a call is allowed. */
enum {
    FMI2_PHASES_BEFORE = GM_PHASE_INSTANTIATED | GM_PHASE_INITIALISATION,
    FMI2_PHASES_EXCHANGE = GM_PHASE_EVENT | GM_PHASE_CONTINUOUS,
    FMI2_PHASES_OVER = GM_PHASE_TERMINATED | GM_PHASE_ERROR,
    FMI2_PHASES_AFTER = GM_PHASE_STEP | GM_PHASE_STEP_FAILED | FMI2_PHASES_OVER,
    FMI2_PHASES_ANY = FMI2_PHASES_BEFORE | FMI2_PHASES_AFTER | FMI2_PHASES_EXCHANGE,
    FMI2_PHASES_SET = FMI2_PHASES_BEFORE | GM_PHASE_STEP | FMI2_PHASES_EXCHANGE,
    FMI2_PHASES_SET_RATE = FMI2_PHASES_BEFORE | GM_PHASE_STEP,
    FMI2_PHASES_GET = GM_PHASE_INITIALISATION | FMI2_PHASES_AFTER | FMI2_PHASES_EXCHANGE
};

/** The instance behind c if `function` may be called in its phase; else NULL, after a
 *  message and with the phase set to error. */
fmi2_instance *fmi2_enter(fmi2Component c, const char *function, unsigned phases);

/** The same for calls that belong to one kind of instance: Model Exchange or
 *  Co-Simulation. */
fmi2_instance *fmi2_enter_exchange(fmi2Component c, const char *function,
                                   unsigned phases);
fmi2_instance *fmi2_enter_slave(fmi2Component c, const char *function, unsigned phases);

/** Warnings about what the component did instead of what it was told; each once. */
fmi2Status fmi2_report(fmi2_instance *instance, const char *function);

/** What became of each path since `before`, as log messages of category logEvents. */
void fmi2_log_shifts(const fmi2_instance *instance, const gm_path_state *before);

/** Report and return status. fmi2Error and fmi2Discard set the phase that follows only
 *  where their callers say so: fmi2_fail below. The text carries no '%' and no '#', which
 *  loggers would expand. */
FMI2_PRINTF(4, 5)
void fmi2_log(const fmi2_instance *instance, fmi2Status status, fmi2_category category,
              const char *format, ...);

/** Report an error in `function`, enter the phase "error", return fmi2Error. */
FMI2_PRINTF(3, 4)
fmi2Status fmi2_fail(fmi2_instance *instance, const char *function, const char *format,
                     ...);

/** Bit of a category's name; 0 when there is no such category. */
unsigned fmi2_category_of(const char *name);

enum { FMI2_NAME_SIZE = 64 };
/** Full name of a variable, such as "odd.tau". */
const char *fmi2_variable_name(gm_reference reference, char text[FMI2_NAME_SIZE]);

#endif
