/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/gm_plugin_rig.h"

#include "base/alloc.h"
#include "plant/gm_plugin.h"

#include <dlfcn.h>
#include <math.h>
#include <string.h>

#define DEFAULT_STEP 1e-3 /* s */

struct gm_plugin_rig {
    void *library;
    const gearmap_plugin *model;
    gm_plugin_settings settings;
    gm_rig rig; /* points back here */
};

typedef struct run {
    const gm_plugin_rig *of;
    void *instance;
} run;

/* ---- a run ---- */

static gm_status failed(const run *r, const char *what, gm_error *error)
{
    const gearmap_plugin *model = r->of->model;
    const char *why = model->message ? model->message(r->instance) : NULL;
    return gm_fail(error, GM_ERR_TOOL, "%s failed%s%.300s", what, why ? ": " : "",
                   why ? why : "");
}

static gm_status create(const void *self, void **made, gm_error *error)
{
    const gm_plugin_rig *of = self;
    run *r = gm_calloc(1, sizeof *r);
    if (!r)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    r->of = of;
    r->instance = of->model->create(of->settings.n_parameters, of->settings.names,
                                    of->settings.values);
    if (!r->instance) {
        gm_status status = failed(r, "create", error);
        gm_free(r);
        return status;
    }
    *made = r;
    return GM_OK;
}

static void destroy(void *self)
{
    run *r = self;
    r->of->model->destroy(r->instance);
    gm_free(r);
}

static gearmap_plugin_input to_input(const run *r, const gm_rig_command *command)
{
    gearmap_plugin_input input = {.oil_temperature = r->of->settings.oil_temperature};
    for (int f = 0; f <= r->of->rig.n_paths; f++)
        input.value[f] = command->value[f];
    for (int p = 0; p < r->of->rig.n_paths; p++)
        input.gear[p] = command->gear[p];
    return input;
}

static gm_status to_view(const run *r, const gm_rig_command *command,
                         const gearmap_plugin_output *output, gm_rig_view *view,
                         gm_error *error)
{
    for (int f = 0; f <= r->of->rig.n_paths; f++) {
        int takes_speed = r->of->rig.drive[f] == GM_RIG_SPEED_IN;
        view->speed[f] = takes_speed ? command->value[f] : output->speed[f];
        view->torque[f] = takes_speed ? output->torque[f] : command->value[f];
        if (!isfinite(view->speed[f]) || !isfinite(view->torque[f]))
            return gm_fail(error, GM_ERR_SOLVE, "the %s at flange %d is not a number",
                           takes_speed ? "torque" : "speed", f);
    }
    return GM_OK;
}

static gm_status start(void *self, const gm_rig_command *command, gm_rig_view *view,
                       gm_error *error)
{
    run *r = self;
    gearmap_plugin_input input = to_input(r, command);
    gearmap_plugin_output output = {{0.0}, {0.0}};
    if (r->of->model->start(r->instance, &input, &output) != 0)
        return failed(r, "start", error);
    return to_view(r, command, &output, view, error);
}

static gm_status step(void *self, const gm_rig_command *command, double h,
                      gm_rig_view *view, gm_error *error)
{
    run *r = self;
    gearmap_plugin_input input = to_input(r, command);
    gearmap_plugin_output output = {{0.0}, {0.0}};
    if (r->of->model->step_by(r->instance, &input, h, &output) != 0)
        return failed(r, "step_by", error);
    return to_view(r, command, &output, view, error);
}

static const gm_rig_class plugin_class = {create, destroy, start, step};

/* ---- life ---- */

static gm_status check(const char *path, const gearmap_plugin *model, gm_error *error)
{
    if (!model || model->version != GEARMAP_PLUGIN_VERSION)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the plug-in has version %d of the interface, this is version "
                       "%d",
                       path, model ? model->version : 0, GEARMAP_PLUGIN_VERSION);
    if (model->n_paths < 1 || model->n_paths > GM_MAX_INPUT_PATHS)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the plug-in has %d input paths; 1 or 2 are possible", path,
                       model->n_paths);
    if (!model->create || !model->destroy || !model->start || !model->step_by)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the plug-in lacks functions", path);
    if (!(model->step >= 0.0) || isinf(model->step))
        return gm_fail(error, GM_ERR_FORMAT, "%s: the plug-in's step is %g s", path,
                       model->step);
    return GM_OK;
}

static gm_status load(const char *path, gm_plugin_rig *p, gm_error *error)
{
    const gearmap_plugin *(*get)(void) = NULL;
    p->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!p->library)
        return gm_fail(error, GM_ERR_TOOL, "%s: cannot be loaded: %s", path, dlerror());
    void *symbol = dlsym(p->library, "gearmap_plugin_get");
    if (!symbol)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: is no plug-in: it has no function gearmap_plugin_get", path);
    memcpy(&get, &symbol, sizeof get);
    p->model = get();
    return check(path, p->model, error);
}

static void describe(gm_plugin_rig *p)
{
    double step = p->settings.step > 0.0 ? p->settings.step : p->model->step;
    p->rig = (gm_rig){.is = &plugin_class,
                      .self = p,
                      .n_paths = p->model->n_paths,
                      .step = step > 0.0 ? step : DEFAULT_STEP};
    for (int f = 0; f <= p->model->n_paths; f++)
        p->rig.drive[f] = p->model->speed_in[f] ? GM_RIG_SPEED_IN : GM_RIG_TORQUE_IN;
}

gm_status gm_plugin_rig_open(const char *path, const gm_plugin_settings *settings,
                             gm_plugin_rig **plugin, gm_error *error)
{
    gm_plugin_rig *p = gm_calloc(1, sizeof *p);
    if (!p)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    p->settings = *settings;
    gm_status status = load(path, p, error);
    if (status != GM_OK) {
        gm_plugin_rig_close(p);
        return status;
    }
    describe(p);
    *plugin = p;
    return GM_OK;
}

void gm_plugin_rig_close(gm_plugin_rig *plugin)
{
    if (!plugin)
        return;
    if (plugin->library)
        (void)dlclose(plugin->library);
    gm_free(plugin);
}

const gm_rig *gm_plugin_rig_interface(const gm_plugin_rig *plugin)
{
    return &plugin->rig;
}
