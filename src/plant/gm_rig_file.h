/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The rig file: how a foreign model (an FMU or a compiled plug-in) is put on the test
 * rig. Which variables are the flanges, gears, oil temperature and parameters, in which
 * units and with which signs, and what the gearset consists of.
 */
#ifndef GM_RIG_FILE_H
#define GM_RIG_FILE_H

#include "model/gm_description.h"
#include "plant/gm_plant.h"
#include "plant/gm_rig.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A variable of the model. Texts are NULL or owned. */
typedef struct gm_rig_signal {
    char *variable; /* NULL: there is none */
    char *unit;     /* empty: what the model says, else SI */
    int sign;       /* +1, or -1 where the model counts the other way */
} gm_rig_signal;

typedef struct gm_rig_flange {
    int drive; /* gm_rig_drive */
    gm_rig_signal torque, speed, angle;
} gm_rig_flange;

typedef struct gm_rig_gear {
    int number, line;
    double ratio;   /* w_path / w_output as stated; NAN: not stated */
    double command; /* value of the gear's variable; NAN: the number */
} gm_rig_gear;

typedef struct gm_rig_path {
    gm_label id;
    gm_rig_flange flange;
    gm_rig_signal gear; /* variable NULL: the model has one gear */
    int neutral;        /* 1: it can be shifted to neutral */
    double neutral_command;
    double sync_torque; /* N.m at the flange */
    double inertia;     /* kg.m2; NAN: measured in neutral */
    int n_gears;
    gm_rig_gear *gears;
} gm_rig_path;

typedef struct gm_rig_parameter {
    gm_label id;
    char *variable; /* its name in the model, owned; empty: that of the label */
    double value;
} gm_rig_parameter;

typedef enum gm_rig_interface {
    GM_RIG_ANY,
    GM_RIG_CO_SIMULATION,
    GM_RIG_MODEL_EXCHANGE
} gm_rig_interface;

typedef struct gm_rig_experiments {
    double step;       /* s; 0: the model's */
    double dwell;      /* s; 0: automatic */
    double ramp_time;  /* s; 0: automatic */
    double creep;      /* rad/s */
    double time_limit; /* s */
    double tolerance;  /* of the solver in Model Exchange, relative */
    int ramps;         /* 1: losses by ramps, 0: held until steady */
} gm_rig_experiments;

typedef struct gm_rig_file {
    int format;
    char name[GM_NAME_SIZE];
    char *title;
    char *model;                  /* as in the file */
    char *model_path;             /* beside the rig file, where that is meant */
    int interface;                /* gm_rig_interface */
    double speed_max, torque_max; /* at the input flanges, rad/s, N.m */
    double oil_temperature;       /* K */
    gm_rig_signal oil;
    int coupled; /* 1: two input shafts drag on each other */
    gm_rig_experiments experiments;
    int n_parameters;
    gm_rig_parameter *parameters;
    int n_paths;
    gm_rig_path paths[GM_MAX_INPUT_PATHS]; /* odd before even */
    gm_rig_flange output;
    char sha256[65]; /* of the rig file and the model together */
} gm_rig_file;

/** Read and check. GM_ERR_FORMAT with file, line, field, what was found and expected;
 *  GM_ERR_MODEL: it contradicts itself; GM_ERR_IO, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_rig_file_read(const char *path, gm_rig_file **file,
                                        gm_error *error);
void gm_rig_file_destroy(gm_rig_file *file);

/** 1 when the YAML file at path has a model: a rig file, no description. */
int gm_rig_file_is_one(const char *path);

/** What a plant knows beforehand; gears[path][...] receive the gears and must outlive the
 *  info, as the file must. */
gm_plant_info gm_rig_file_info(const gm_rig_file *file,
                               gm_plant_gear gears[GM_MAX_INPUT_PATHS][32]);

/** Reference of the format in Markdown: calls write with pieces of text. */
void gm_rig_file_help(void (*write)(void *context, const char *text), void *context);

#ifdef __cplusplus
}
#endif
#endif
