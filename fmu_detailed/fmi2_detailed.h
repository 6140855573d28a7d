/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An FMI 2.0 instance of the detailed gearset, for Model Exchange. Calls are checked
 * against the state machine of FMI 2.0.3, section 3.2.3; after fmi2Error an instance is
 * in the phase "error", from which fmi2SetFMUstate, fmi2Reset and fmi2FreeInstance lead
 * out.
 */
#ifndef FMI2_DETAILED_H
#define FMI2_DETAILED_H

#include "fmi2Functions.h"
#include "gm_detailed_gradient.h"

/** Bits, so that a set of phases is a mask. */
typedef enum detailed_phase {
    PHASE_INSTANTIATED = 1,
    PHASE_INITIALISATION = 2,
    PHASE_EVENT = 4,
    PHASE_CONTINUOUS = 8,
    PHASE_TERMINATED = 16,
    PHASE_ERROR = 32,
    PHASES_EXCHANGE = PHASE_EVENT | PHASE_CONTINUOUS,
    PHASES_OVER = PHASE_TERMINATED | PHASE_ERROR,
    PHASES_SET = PHASE_INSTANTIATED | PHASE_INITIALISATION | PHASES_EXCHANGE,
    PHASES_GET = PHASE_INITIALISATION | PHASES_EXCHANGE | PHASES_OVER,
    PHASES_ANY = PHASES_GET | PHASE_INSTANTIATED
} detailed_phase;

/** Bits of the log categories, which have the names of modelDescription.xml. */
typedef enum detailed_category {
    LOG_WARNING = 1,
    LOG_DISCARD = 2,
    LOG_ERROR = 4,
    LOG_EVENTS = 8,
    LOG_ALL = 16,
    LOG_ALWAYS = LOG_WARNING | LOG_DISCARD | LOG_ERROR
} detailed_category;

typedef struct detailed_instance {
    gm_detailed *gearset;
    detailed_phase phase;
    double time; /* s */
    bool experiment_set;
    bool update_due; /* something changed in this event */
    bool reported[GM_DETAILED_PATHS];
    int reported_gear[GM_DETAILED_PATHS];
    fmi2CallbackFunctions host;
    unsigned logged;
    char *name;
    gm_detailed_variable *unknown; /* scratch: for all variables */
    double *along;                 /* scratch: [n_states] */
} detailed_instance;

/** The instance behind c if `function` may be called in its phase; else NULL, after a
 *  message and with the phase set to error. */
detailed_instance *detailed_enter(fmi2Component c, const char *function, unsigned phases);

/** The same for a call with an array of n items that has to hold `needed`. */
detailed_instance *detailed_enter_array(fmi2Component c, const char *function,
                                        unsigned phases, const void *array, size_t n,
                                        int needed);

/** Report and return status. */
GM_PRINTF(4, 5)
fmi2Status detailed_log(const detailed_instance *f, fmi2Status status,
                        detailed_category category, const char *format, ...);

/** Report an error in `function`, enter the phase "error", return fmi2Error. */
GM_PRINTF(3, 4)
fmi2Status detailed_fail(detailed_instance *f, const char *function, const char *format,
                         ...);

/** Bit of a category's name; 0 when there is none. */
unsigned detailed_category_of(const char *name);

/** Warn once of every gear that is refused. */
fmi2Status detailed_report_gears(detailed_instance *f, const char *function);

/** The variable of a value reference, if it is carried by `carrier`; else a message. */
fmi2Status detailed_find(detailed_instance *f, const char *function, unsigned vr,
                         gm_type carrier, gm_detailed_variable *variable);

enum { DETAILED_NAME_SIZE = 256 };
const char *detailed_name(const detailed_instance *f, gm_detailed_variable variable,
                          char text[DETAILED_NAME_SIZE]);

/** In initialisation: begin anew where something was set. */
fmi2Status detailed_start(detailed_instance *f, const char *function);

#endif
