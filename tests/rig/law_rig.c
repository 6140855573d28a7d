/* SPDX-License-Identifier: BSD-2-Clause */
#include "law_rig.h"

#include "base/alloc.h"

#include <math.h>

typedef struct run {
    const law_rig *of;
    law_run model;
    long steps;
} run;

static gm_status create(const void *self, void **made, gm_error *error)
{
    run *r = gm_calloc(1, sizeof *r);
    if (!r)
        return gm_fail(error, GM_ERR_MEMORY, "no memory");
    r->of = self;
    *made = r;
    return GM_OK;
}

static void destroy(void *r)
{
    gm_free(r);
}

static void put(run *r, const gm_rig_command *command)
{
    for (int f = 0; f <= r->model.of.n_paths; f++)
        r->model.input[f] = command->value[f];
}

static void look(const run *r, gm_rig_view *view)
{
    for (int f = 0; f <= r->model.of.n_paths; f++) {
        view->speed[f] = law_speed(&r->model, r->model.x, f);
        view->torque[f] = law_torque(&r->model, r->model.x, f);
    }
}

static gm_status start(void *self, const gm_rig_command *command, gm_rig_view *view,
                       gm_error *error)
{
    run *r = self;
    (void)error;
    law_start(&r->model, r->of->variant);
    r->model.temperature = r->of->temperature;
    for (int p = 0; p < r->model.of.n_paths; p++)
        r->model.gear[p] = command->gear[p];
    put(r, command);
    look(r, view);
    return GM_OK;
}

static gm_status step(void *self, const gm_rig_command *command, double h,
                      gm_rig_view *view, gm_error *error)
{
    run *r = self;
    if (r->of->fails_after > 0 && ++r->steps > r->of->fails_after)
        return gm_fail(error, GM_ERR_TOOL, "the model has had enough");
    put(r, command);
    law_step(&r->model, h);
    look(r, view);
    return GM_OK;
}

static const gm_rig_class law_class = {create, destroy, start, step};

void law_rig_init(law_rig *l, law_variant variant)
{
    static const char *const names[2][2] = {{"input", ""}, {"odd", "even"}};
    law of = law_of(variant);
    *l = (law_rig){.variant = variant, .temperature = 353.15};
    l->rig = (gm_rig){.is = &law_class, .self = l, .n_paths = of.n_paths, .step = 1e-3};
    for (int f = 0; f <= of.n_paths; f++)
        l->rig.drive[f] = of.speed_in[f] ? GM_RIG_SPEED_IN : GM_RIG_TORQUE_IN;
    l->info = (gm_plant_info){.name = "law",
                              .title = "closed forms",
                              .source_sha256 = "0123456789abcdef0123456789abcdef"
                                               "0123456789abcdef0123456789abcdef",
                              .n_paths = of.n_paths,
                              .speed_max = 600.0,
                              .torque_max = 200.0,
                              .oil_temperature = 353.15,
                              .coupled = of.n_paths == 2};
    for (int p = 0; p < of.n_paths; p++) {
        int n = 0;
        for (int g = 0; g < LAW_GEARS; g++)
            if (of.path[p].ratio[g] != 0.0)
                l->gears[p][n++] = (gm_plant_gear){g == 0 ? -1 : g, of.path[p].ratio[g]};
        l->info.path[p] = (gm_plant_path){.name = names[of.n_paths - 1][p],
                                          .n_gears = n,
                                          .gears = l->gears[p],
                                          .sync_torque = 40.0};
    }
}
