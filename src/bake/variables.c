/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Dependencies, for torque in and speed out with losses that depend on load:
 *   - angles, speeds, twists, energies are states of the component, what a path is doing
 *     changes at events: no direct dependency;
 *   - accelerations and losses follow torques and speeds of all flanges, since the
 *     transmitted torque is what is left after accelerating both sides;
 *   - at the start commanded gears are engaged at once, and output.w_start wins.
 */
#include "bake/variables.h"

#include <string.h>

const variable gm_bake_variables[] = {
#define GM_VAR(id, scope_, name_, type_, causality_, variability_, initial_, unit_,      \
               start_, min_, max_, nominal_, description_)                               \
    [VARIABLE_##id] = {.name = name_,                                                    \
                       .scope = SCOPE_##scope_,                                          \
                       .type = TYPE_##type_,                                             \
                       .causality = CAUSALITY_##causality_,                              \
                       .variability = VARIABILITY_##variability_,                        \
                       .initial = INITIAL_##initial_,                                    \
                       .unit = unit_,                                                    \
                       .start = start_,                                                  \
                       .min = min_,                                                      \
                       .max = max_,                                                      \
                       .nominal = nominal_,                                              \
                       .description = description_},
#include "core/gm_vars.def"
#undef GM_VAR
};

int gm_bake_scalars(int n_paths, scalar *all)
{
    int n = 0;
    for (int id = 0; id < N_VARIABLES; id++) {
        if (gm_bake_variables[id].scope == SCOPE_ALL)
            all[n++] = (scalar){(variable_id)id, -1};
        else
            for (int p = 0; p < n_paths; p++)
                all[n++] = (scalar){(variable_id)id, p};
    }
    return n;
}

unsigned gm_bake_reference(scalar s)
{
    return 8u * (unsigned)s.id + (unsigned)(s.path + 1);
}

int gm_bake_index(const scalar *all, int n, scalar s)
{
    for (int i = 0; i < n; i++)
        if (all[i].id == s.id && all[i].path == s.path)
            return i + 1;
    return 0;
}

/* ---- states ---- */

static const struct {
    variable_id state, derivative;
} states_of[] = {
#define GM_STATE(state_, derivative_)                                                    \
    {.state = VARIABLE_##state_, .derivative = VARIABLE_##derivative_},
#include "core/gm_states.def"
#undef GM_STATE
};
enum { N_STATES_OF = sizeof states_of / sizeof *states_of };

int gm_bake_states(int n_paths, scalar *states, scalar *derivatives)
{
    int n = 0;
    for (int i = 0; i < N_STATES_OF; i++) {
        bool path = gm_bake_variables[states_of[i].state].scope == SCOPE_PATH;
        for (int p = 0; p < (path ? n_paths : 1); p++, n++) {
            states[n] = (scalar){states_of[i].state, path ? p : -1};
            derivatives[n] = (scalar){states_of[i].derivative, path ? p : -1};
        }
    }
    return n;
}

bool gm_bake_integral(scalar derivative, scalar *state)
{
    for (int i = 0; i < N_STATES_OF; i++)
        if (states_of[i].derivative == derivative.id) {
            *state = (scalar){states_of[i].state, derivative.path};
            return true;
        }
    return false;
}

static bool is_state(variable_id id)
{
    for (int i = 0; i < N_STATES_OF; i++)
        if (states_of[i].state == id)
            return true;
    return false;
}

int gm_bake_indicators(int n_paths)
{
    return 2 * n_paths + 2;
}

/* ---- dependencies ---- */

/* Follows the load on the flanges. */
static bool follows_load(variable_id id)
{
    switch (id) {
    case VARIABLE_PATH_A:
    case VARIABLE_OUTPUT_A:
    case VARIABLE_PATH_LOSS_TORQUE:
    case VARIABLE_OUTPUT_LOSS_TORQUE:
    case VARIABLE_LOSS_POWER:
    case VARIABLE_OUT_OF_MAP:
        return true;
    default:
        return false;
    }
}

bool gm_bake_follows_oil(scalar of)
{
    return follows_load(of.id);
}

static bool is_torque(variable_id id)
{
    return id == VARIABLE_PATH_TAU || id == VARIABLE_OUTPUT_TAU;
}

static bool is_speed(variable_id id)
{
    return id == VARIABLE_PATH_W || id == VARIABLE_OUTPUT_W;
}

dependency gm_bake_depends(scalar of, scalar on)
{
    if (is_state(of.id))
        return of.id == on.id && of.path == on.path ? DEPENDENCY_CONSTANT
                                                    : DEPENDENCY_NONE;
    bool own = on.path == of.path || on.path < 0, depends = false;
    switch (of.id) {
    case VARIABLE_PATH_TWIST_RATE: /* w_p - r w_o or 0 */
        return is_speed(on.id) && own ? DEPENDENCY_DISCRETE : DEPENDENCY_NONE;
    case VARIABLE_POWER:
        depends = is_torque(on.id) || is_speed(on.id);
        break;
    case VARIABLE_KINETIC_ENERGY:
        depends = is_speed(on.id);
        break;
    case VARIABLE_ELASTIC_ENERGY:
        depends = on.id == VARIABLE_PATH_TWIST;
        break;
    case VARIABLE_PATH_A: /* what twists the other path does not reach this one */
        depends =
            is_torque(on.id) || is_speed(on.id) || (on.id == VARIABLE_PATH_TWIST && own);
        break;
    default:
        depends = follows_load(of.id) &&
                  (is_torque(on.id) || is_speed(on.id) || on.id == VARIABLE_PATH_TWIST);
    }
    return depends ? DEPENDENCY_DEPENDENT : DEPENDENCY_NONE;
}

static bool sets_speeds(variable_id id)
{
    return id == VARIABLE_OUTPUT_W_START || id == VARIABLE_PATH_W_START ||
           id == VARIABLE_PATH_GEAR;
}

static bool depends_initially(scalar of, scalar on)
{
    switch (of.id) {
    case VARIABLE_OUTPUT_W:
        return on.id == VARIABLE_OUTPUT_W_START;
    case VARIABLE_PATH_W:
        return on.id == VARIABLE_OUTPUT_W_START ||
               (sets_speeds(on.id) && on.path == of.path);
    case VARIABLE_PATH_STATE:
    case VARIABLE_PATH_GEAR_REFUSED:
        return on.id == VARIABLE_PATH_GEAR && on.path == of.path;
    case VARIABLE_PATH_INERTIA:
    case VARIABLE_OUTPUT_INERTIA:
    case VARIABLE_RECOMMENDED_STEP:
        return on.id == VARIABLE_PATH_GEAR || on.id == VARIABLE_FIDELITY;
    case VARIABLE_KINETIC_ENERGY:
        return sets_speeds(on.id);
    case VARIABLE_ELASTIC_ENERGY:
        return on.id == VARIABLE_PATH_GEAR || on.id == VARIABLE_PATH_TWIST ||
               on.id == VARIABLE_FIDELITY;
    case VARIABLE_POWER:
        return is_torque(on.id) || sets_speeds(on.id);
    case VARIABLE_PATH_A:
        if (on.id == VARIABLE_PATH_TWIST)
            return on.path == of.path;
        /* fallthrough */
    default:
        return follows_load(of.id) &&
               (is_torque(on.id) || sets_speeds(on.id) || on.id == VARIABLE_LOSS_SCALE ||
                on.id == VARIABLE_PATH_TWIST || on.id == VARIABLE_FIDELITY);
    }
}

dependency gm_bake_depends_initially(scalar of, scalar on)
{
    return depends_initially(of, on) ? DEPENDENCY_DEPENDENT : DEPENDENCY_NONE;
}

/* ---- units ---- */

#define RPM 9.5492965855137201 /* 30/pi */
#define DEGREES 57.295779513082321

// clang-format off
static const unit_type units[] = {
    {.unit = "1", .type = "Factor", .quantity = "Factor"},
    {.unit = "J", .type = "Energy", .quantity = "Energy",
     .kg = 1, .m = 2, .s = -2, .display = {"kJ", 1e-3, 0.0}},
    {.unit = "K", .type = "Temperature", .quantity = "ThermodynamicTemperature",
     .K = 1, .display = {"degC", 1.0, -273.15}},
    {.unit = "N.m", .type = "Torque", .quantity = "Torque", .kg = 1, .m = 2, .s = -2},
    {.unit = "W", .type = "Power", .quantity = "Power",
     .kg = 1, .m = 2, .s = -3, .display = {"kW", 1e-3, 0.0}},
    {.unit = "kg.m2", .type = "Inertia", .quantity = "MomentOfInertia", .kg = 1, .m = 2},
    {.unit = "rad", .type = "Angle", .quantity = "Angle",
     .rad = 1, .display = {"deg", DEGREES, 0.0}},
    {.unit = "rad/s", .type = "AngularVelocity", .quantity = "AngularVelocity",
     .s = -1, .rad = 1, .display = {"rpm", RPM, 0.0}},
    {.unit = "s",
     .type = "Time",
     .quantity = "Time",
     .s = 1,
     .display = {"ms", 1e3, 0.0}},
    {.unit = "rad/s2", .type = "AngularAcceleration", .quantity = "AngularAcceleration",
     .s = -2, .rad = 1},
};
// clang-format on
enum { N_UNITS = sizeof units / sizeof *units };

int gm_bake_units(const unit_type **all)
{
    *all = units;
    return N_UNITS;
}

const unit_type *gm_bake_unit(const char *unit)
{
    for (int i = 0; i < N_UNITS; i++)
        if (!strcmp(units[i].unit, unit))
            return &units[i];
    return NULL;
}
