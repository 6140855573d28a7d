/* SPDX-License-Identifier: BSD-2-Clause */
#include "reducer_fixture.h"

#include <math.h>
#include <string.h>

#define DEGREE 0.017453292519943295

static gm_wheel wheel(const char *name, int shaft, int teeth, double hand)
{
    gm_wheel w = {.shaft = shaft,
                  .teeth = teeth,
                  .normal_module = 1.75e-3,
                  .helix = hand * 30.0 * DEGREE,
                  .pressure_angle = 17.5 * DEGREE,
                  .width = 0.020,
                  .position = 0.060,
                  .roughness = 0.5e-6,
                  .inertia = shaft == 0 ? 1e-4 : 1e-3,
                  .mass = 0.0,
                  .bore = 0.025};
    (void)strncpy(w.id.name, name, sizeof w.id.name - 1);
    return w;
}

static gm_bearing bearing(const char *name, int shaft, double position, int locating)
{
    gm_bearing b = {.shaft = shaft,
                    .on = GM_HOUSING,
                    .position = position,
                    .locating = locating,
                    .data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                             .friction = GM_FRICTION_NONE,
                             .designation = "6206",
                             .series = "62",
                             .d = 0.030,
                             .D = 0.062,
                             .B = 0.016,
                             .C0 = 11200.0,
                             .f0 = (double)NAN,
                             .f1 = (double)NAN},
                    .radial_stiffness = 2e8,
                    .axial_stiffness = 1e8};
    (void)strncpy(b.id.name, name, sizeof b.id.name - 1);
    return b;
}

static void make_parts(reducer *r)
{
    double a = 0.5 * (32 + 49) * 1.75e-3 / cos(30.0 * DEGREE);
    r->shafts[0] = (gm_shaft){.id = {"input", 1}, .inertia = 1e-3, .mass = 0.0};
    r->shafts[1] = (gm_shaft){.id = {"output", 2}, .y = a, .inertia = 2e-3, .mass = 0.0};
    r->wheels[0] = wheel("pinion", 0, 32, 1.0);
    r->wheels[1] = wheel("wheel", 1, 49, -1.0);
    r->wheels[1].idles = 1;
    r->wheels[1].bearing = bearing("", 1, 0.0, 0).data;
    r->meshes[0] = (gm_mesh){
        .id = {"stage", 3}, .wheel = {0, 1}, .loss = GM_MESH_CONSTANT, .efficiency = 1.0};
    r->meshes[0].flanks = (gm_flanks){.stiffness = (double)NAN,
                                      .damping_ratio = 0.07,
                                      .backlash = (double)NAN,
                                      .entry = 4e-6,
                                      .film = 0.05};
    r->bearings[0] = bearing("input_a", 0, 0.0, 1);
    r->bearings[1] = bearing("input_b", 0, 0.160, 0);
    r->bearings[2] = bearing("output_a", 1, 0.0, 1);
    r->bearings[3] = bearing("output_b", 1, 0.160, 0);
    r->lock = (gm_lock){.index = 1};
    r->gear = (gm_path_gear){
        .number = 1, .n_locks = 1, .locks = &r->lock, .ratio = -49.0 / 32.0};
    r->locked_wheel = 1;
    r->synchroniser = (gm_synchroniser){
        .shaft = 1, .n_wheels = 1, .wheels = &r->locked_wheel, .cone_torque = 49.0};
    r->synchroniser.dogs = (gm_flanks){.stiffness = 2e5,
                                       .damping_ratio = 0.1,
                                       .backlash = 5e-3,
                                       .entry = 3e-4,
                                       .film = 0.05};
}

void reducer_make(reducer *r)
{
    memset(r, 0, sizeof *r);
    make_parts(r);
    r->d = (gm_description){.file = (char *)"reducer",
                            .title = (char *)"one-stage reducer",
                            .speed_max = 600.0,
                            .torque_max = 200.0,
                            .n_shafts = 2,
                            .shafts = r->shafts,
                            .n_wheels = 2,
                            .wheels = r->wheels,
                            .n_meshes = 1,
                            .meshes = r->meshes,
                            .n_bearings = 4,
                            .bearings = r->bearings,
                            .n_synchronisers = 1,
                            .synchronisers = &r->synchroniser,
                            .n_paths = 1,
                            .output = 1};
    r->d.paths[0] = (gm_path_part){.id = {"input", 4},
                                   .shaft = 0,
                                   .n_gears = 1,
                                   .gears = &r->gear,
                                   .has_neutral = 1};
    r->d.oil = (gm_oil_part){.viscosity_40 = 30.8e-6,
                             .viscosity_100 = 5.9e-6,
                             .density_15 = 845.0,
                             .thermal_expansion = 6.5e-4,
                             .temperature = 353.15,
                             .mesh_lubricant_factor = 0.75,
                             .bearing_mu_ehl = 0.1,
                             .level = (double)NAN};
    (void)strncpy(r->d.name, "reducer", sizeof r->d.name - 1);
}
