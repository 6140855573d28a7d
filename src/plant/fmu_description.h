/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What is needed of an FMU's modelDescription.xml to run it.
 */
#ifndef FMU_DESCRIPTION_H
#define FMU_DESCRIPTION_H

#include "base/gm_status.h"

typedef struct fmu_variable {
    char *name;
    unsigned reference;
} fmu_variable;

/** A continuous state of Model Exchange, in the order of the state vector. */
typedef struct fmu_state {
    char *name; /* of the state's variable */
    unsigned reference, rate_reference;
    int n_dependencies; /* -1: not stated, on everything */
    int *dependencies;  /* [n_dependencies] states that the rate depends on */
} fmu_state;

typedef struct fmu_description {
    char *guid, *identifier;   /* of the Co-Simulation interface */
    char *exchange_identifier; /* of Model Exchange; NULL: not offered */
    int directional;           /* 1: Model Exchange gives directional derivatives */
    int n_indicators;          /* event indicators */
    int n_states;
    fmu_state *states;              /* [n_states] */
    char *source_sha256, *map_hash; /* NULL: not stated */
    double oil_temperature;         /* K, NAN: not stated */
    int n_variables;
    fmu_variable *variables; /* [n_variables], sorted by name */
} fmu_description;

/** Read the file at path; archive names the FMU in messages. GM_ERR_FORMAT when it is not
 *  FMI 2.0 with Co-Simulation, GM_ERR_MEMORY. Free with gm_fmu_description_clear. */
GM_NODISCARD gm_status gm_fmu_description_read(const char *path, const char *archive,
                                               fmu_description *description,
                                               gm_error *error);

/** Variable of a name, or NULL. */
const fmu_variable *gm_fmu_description_find(const fmu_description *description,
                                            const char *name);

void gm_fmu_description_clear(fmu_description *description);

#endif
