/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What is needed of an FMU's modelDescription.xml to run it.
 */
#ifndef FMU_DESCRIPTION_H
#define FMU_DESCRIPTION_H

#include "base/gm_status.h"

/** How a variable is handed over. */
typedef enum fmu_kind {
    FMU_REAL,    /* Real, Float64 */
    FMU_FLOAT32, /* the rest of the numbers of FMI 3.0 */
    FMU_INT8,
    FMU_UINT8,
    FMU_INT16,
    FMU_UINT16,
    FMU_INTEGER, /* Integer, Int32; Enumeration of FMI 2.0 */
    FMU_UINT32,
    FMU_INT64, /* also Enumeration of FMI 3.0 */
    FMU_UINT64,
    FMU_BOOLEAN,
    FMU_OTHER
} fmu_kind;

typedef enum fmu_causality {
    FMU_LOCAL, /* and what else can only be seen */
    FMU_INPUT,
    FMU_OUTPUT,
    FMU_PARAMETER
} fmu_causality;

typedef struct fmu_variable {
    char *name;
    unsigned reference;
    fmu_kind kind;
    fmu_causality causality;
    int settable;      /* 1: parameter or start value that may be set before the start */
    char *unit;        /* NULL: not stated */
    char *description; /* NULL: none */
    double least, greatest; /* its own range or its type's; NAN: not stated */
} fmu_variable;

/** A declared unit: SI value = factor * value + offset. */
typedef struct fmu_unit {
    char *name;
    double factor, offset;
    int kg, m, s, kelvin, rad; /* exponents of its base units */
    int others;                /* 1: it has more of them */
} fmu_unit;

/** A gear that a component of this program says it has. */
typedef struct fmu_gear {
    char *path;
    int number;
    double ratio;   /* w_path / w_output */
    double inertia; /* kg.m2, turns with the path's input flange */
} fmu_gear;

/** A continuous state of Model Exchange, in the order of the state vector. */
typedef struct fmu_state {
    char *name; /* of the state's variable */
    unsigned reference, rate_reference;
    int n_dependencies; /* -1: not stated, on everything */
    int *dependencies;  /* [n_dependencies] states that the rate depends on */
} fmu_state;

#define FMU_MAX_OIL 32

typedef struct fmu_description {
    int version;               /* 2 or 3 */
    char *guid;                /* or instantiation token */
    char *identifier;          /* of Co-Simulation; NULL: not offered */
    char *exchange_identifier; /* of Model Exchange; NULL: not offered */
    int directional;           /* 1: Model Exchange gives directional derivatives */
    int n_indicators;          /* event indicators */
    int n_states;
    fmu_state *states;              /* [n_states] */
    char *source_sha256, *map_hash; /* NULL: not stated */
    double oil_temperature;         /* K, NAN: not stated */
    int n_oil;                      /* 0: no oil axis is stated */
    double oil[FMU_MAX_OIL];        /* K */
    double speed_max, torque_max;   /* rad/s, N.m at the inputs; NAN: not stated */
    int n_gears;
    fmu_gear *gears; /* [n_gears] */
    double step;     /* s, of the default experiment; NAN: not stated */
    int n_units;
    fmu_unit *units; /* [n_units] */
    int n_variables;
    fmu_variable *variables; /* [n_variables], sorted by name */
} fmu_description;

/** Read the file at path; archive names the FMU in messages. GM_ERR_FORMAT when it is not
 *  FMI 2.0 or 3.0 or is broken, GM_ERR_MEMORY. Free with gm_fmu_description_clear. */
GM_NODISCARD gm_status gm_fmu_description_read(const char *path, const char *archive,
                                               fmu_description *description,
                                               gm_error *error);

/** Variable of a name, or NULL. */
const fmu_variable *gm_fmu_description_find(const fmu_description *description,
                                            const char *name);

/** The declared unit of a name, or NULL. */
const fmu_unit *gm_fmu_description_unit(const fmu_description *description,
                                        const char *name);

void gm_fmu_description_clear(fmu_description *description);

#endif
