/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The C interface of a compiled gearset model (plug-in): a shared library that exports
 * gearmap_plugin. It needs this header only, no library of Gearmap's. See
 * examples/plugin.
 *
 * The model is a gearset between one or two input flanges (paths) and one output flange.
 * Numbers are SI: s, rad/s, N.m, K. A torque is positive where it pushes in the positive
 * direction of its flange's rotation, into the gearset, also at the output. Flange 0 is
 * the output, flange 1 + p is path p.
 *
 * At each flange the model takes the torque and answers the speed, or takes the speed and
 * answers the torque; which one its description says. Inputs are constant over a step.
 */
#ifndef GM_PLUGIN_H
#define GM_PLUGIN_H

#ifdef __cplusplus
extern "C" {
#endif

#define GEARMAP_PLUGIN_VERSION 1
#define GEARMAP_PLUGIN_FLANGES 3
#define GEARMAP_PLUGIN_PATHS 2

/** What acts on the gearset over a step. */
typedef struct gearmap_plugin_input {
    double value[GEARMAP_PLUGIN_FLANGES]; /* torque [N.m] or speed [rad/s] */
    int gear[GEARMAP_PLUGIN_PATHS];       /* wanted gear: 0 neutral, -1 reverse, 1 ... */
    double oil_temperature;               /* K */
} gearmap_plugin_input;

/** What the gearset answers at the end of a step. */
typedef struct gearmap_plugin_output {
    double speed[GEARMAP_PLUGIN_FLANGES];  /* rad/s, where torque is taken */
    double torque[GEARMAP_PLUGIN_FLANGES]; /* N.m, where speed is taken */
} gearmap_plugin_output;

/** The model. Functions return 0, or another number when they failed; then `message`
 *  may say why in one line. Different instances may be used by different processes. */
typedef struct gearmap_plugin {
    int version;      /* GEARMAP_PLUGIN_VERSION of the header it was compiled with */
    const char *name; /* of the model */
    int n_paths;      /* 1 or 2 */
    int speed_in[GEARMAP_PLUGIN_FLANGES]; /* 1: takes the speed of this flange */
    double step; /* s: longest step that the model likes; 0: any */

    /* A new instance; NULL: failed. parameters: n pairs of names and values from the
       rig file; a name that is not known is a failure. */
    void *(*create)(int n, const char *const *names, const double *values);
    void (*destroy)(void *instance);
    /* Begin at rest at time 0 with the gears of *input. */
    int (*start)(void *instance, const gearmap_plugin_input *input,
                 gearmap_plugin_output *output);
    /* Go on by h [s] with constant input. */
    int (*step_by)(void *instance, const gearmap_plugin_input *input, double h,
                   gearmap_plugin_output *output);
    /* Why the last call failed, or NULL; instance may be NULL after create. */
    const char *(*message)(const void *instance);
} gearmap_plugin;

/** The one function that the library exports. */
const gearmap_plugin *gearmap_plugin_get(void);

#ifdef __cplusplus
}
#endif
#endif
