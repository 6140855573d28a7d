/* SPDX-License-Identifier: BSD-2-Clause
 *
 * One instance of an FMU of FMI 2.0 or 3.0, in Co-Simulation or Model Exchange, with the
 * same calls for all four.
 */
#ifndef FMI_INSTANCE_H
#define FMI_INSTANCE_H

#include "plant/fmu_description.h"

#include <stddef.h>

typedef enum fmi_mode { FMI_STEPS, FMI_EXCHANGE } fmi_mode;

/** Answers of an FMU, in the numbering that both versions share. */
typedef enum fmi_answer {
    FMI_OK,
    FMI_WARNING,
    FMI_DISCARD,
    FMI_ERROR,
    FMI_FATAL,
    FMI_PENDING
} fmi_answer;

typedef struct fmi_instance fmi_instance;

/** What one version of the standard does; `it` has been loaded where that matters. */
typedef struct fmi_version {
    const char *platform; /* folder below binaries */
    /* Find the functions. Returns the name of one that is missing, or NULL. */
    const char *(*load)(fmi_instance *it);
    void *(*instantiate)(fmi_instance *it, const char *folder);
    void (*release)(fmi_instance *it);
    fmi_answer (*set)(fmi_instance *it, fmu_kind kind, unsigned reference, double value);
    fmi_answer (*get)(fmi_instance *it, fmu_kind kind, unsigned reference, double *value);
    fmi_answer (*initialise)(fmi_instance *it); /* enter initialisation mode at t = 0 */
    fmi_answer (*begin)(fmi_instance *it);      /* leave it */
    fmi_answer (*step)(fmi_instance *it, double t, double h);
    /* Model Exchange. */
    fmi_answer (*to_events)(fmi_instance *it);
    fmi_answer (*update)(fmi_instance *it, int *again);
    fmi_answer (*to_continuous)(fmi_instance *it);
    fmi_answer (*set_time)(fmi_instance *it, double t);
    fmi_answer (*set_states)(fmi_instance *it, const double *x, int n);
    fmi_answer (*get_states)(fmi_instance *it, double *x, int n);
    fmi_answer (*nominals)(fmi_instance *it, double *nominal, int n);
    fmi_answer (*rates)(fmi_instance *it, double *dx, int n);
    fmi_answer (*indicators)(fmi_instance *it, double *g, int n);
    fmi_answer (*completed)(fmi_instance *it, int *event);
} fmi_version;

struct fmi_instance {
    const fmi_version *is;
    const fmu_description *description;
    fmi_mode mode;
    void *library;
    void *functions; /* of the version */
    void *component;
    char message[256]; /* the FMU's last one */
};

extern const fmi_version gm_fmi_version_2, gm_fmi_version_3;

/** Load the library of an unpacked FMU and instantiate it. description and folder outlive
 *  it. GM_ERR_FORMAT: no binary for this platform, functions missing; GM_ERR_TOOL: it
 *  cannot be loaded or refuses to be instantiated (wrong GUID or token). */
GM_NODISCARD gm_status gm_fmi_open(const fmu_description *description, const char *folder,
                                   fmi_mode mode, fmi_instance **it, gm_error *error);
void gm_fmi_close(fmi_instance *it);

/** A fresh component in place of the one that ran. GM_ERR_TOOL. */
GM_NODISCARD gm_status gm_fmi_renew(fmi_instance *it, const char *folder,
                                    gm_error *error);

/** GM_OK for OK and Warning; else GM_ERR_TOOL with the call and the FMU's words. */
GM_NODISCARD gm_status gm_fmi_check(const fmi_instance *it, const char *called,
                                    fmi_answer answer, gm_error *error);

/** Look a function up by "fmi2" or "fmi3" and its name; 1 when it is there. */
int gm_fmi_find(void *library, const char *prefix, const char *name, void *function,
                size_t size);

#endif
