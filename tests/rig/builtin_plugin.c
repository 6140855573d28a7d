/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The built-in model of the gearset in the file $GEARSET as a compiled model of somebody
 * else: experiments see speeds and torques only.
 */
#include "plant/gm_builtin.h"
#include "plant/gm_moving_model.h"
#include "plant/gm_plugin.h"
#include "solve/gm_continuous_rig.h"

#include <stdlib.h>
#include <string.h>

typedef struct instance {
    gm_description *description;
    gm_gearset *gearset;
    gm_dynamics dynamics;
    gm_continuous model;
    gm_continuous_rig rig;
    void *run;
    int n_paths;
    gm_error error;
} instance;

static void destroy(void *made)
{
    instance *it = made;
    if (it->run)
        it->rig.rig.is->destroy(it->run);
    gm_gearset_destroy(it->gearset);
    gm_description_destroy(it->description);
    free(it);
}

static void *create(int n, const char *const *names, const double *values)
{
    const char *file = getenv("GEARSET");
    instance *it = calloc(1, sizeof *it);
    (void)names;
    (void)values;
    if (!it || !file || n > 0) {
        free(it);
        return NULL;
    }
    gm_status status = gm_description_read(file, &it->description, &it->error);
    if (status == GM_OK)
        status = gm_gearset_create(it->description, it->description->oil.temperature,
                                   &it->gearset, &it->error);
    if (status == GM_OK) {
        it->n_paths = it->description->n_paths;
        it->dynamics = gm_builtin_dynamics(it->gearset);
        it->model = gm_moving_model(&it->dynamics, 1e-3);
        gm_continuous_rig_init(&it->rig, &it->model, 1e-7);
        status = it->rig.rig.is->create(it->rig.rig.self, &it->run, &it->error);
    }
    if (status == GM_OK)
        return it;
    destroy(it);
    return NULL;
}

static gm_rig_command command_of(const instance *it, const gearmap_plugin_input *in)
{
    gm_rig_command command;
    memset(&command, 0, sizeof command);
    for (int f = 0; f <= it->n_paths; f++)
        command.value[f] = in->value[f];
    for (int p = 0; p < it->n_paths; p++)
        command.gear[p] = in->gear[p];
    return command;
}

static int tell(const instance *it, gm_status status, const gm_rig_view *view,
                gearmap_plugin_output *out)
{
    for (int f = 0; status == GM_OK && f <= it->n_paths; f++)
        out->speed[f] = view->speed[f];
    return status != GM_OK;
}

static int start(void *made, const gearmap_plugin_input *in, gearmap_plugin_output *out)
{
    instance *it = made;
    gm_rig_command command = command_of(it, in);
    gm_rig_view view;
    return tell(it, it->rig.rig.is->start(it->run, &command, &view, &it->error), &view,
                out);
}

static int step_by(void *made, const gearmap_plugin_input *in, double h,
                   gearmap_plugin_output *out)
{
    instance *it = made;
    gm_rig_command command = command_of(it, in);
    gm_rig_view view;
    return tell(it, it->rig.rig.is->step(it->run, &command, h, &view, &it->error), &view,
                out);
}

static const char *message(const void *made)
{
    return made ? ((const instance *)made)->error.message : "no gearset in $GEARSET";
}

const gearmap_plugin *gearmap_plugin_get(void)
{
    static const gearmap_plugin model = {.version = GEARMAP_PLUGIN_VERSION,
                                         .name = "builtin",
                                         .n_paths = 1,
                                         .create = create,
                                         .destroy = destroy,
                                         .start = start,
                                         .step_by = step_by,
                                         .message = message};
    return &model;
}
