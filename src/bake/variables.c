/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Dependencies, for torque in and speed out with losses that depend on load:
 *   - angles, speeds, twists, energies are states of the component, what a path is doing
 *     changes at events: no direct dependency;
 *   - accelerations and losses follow torques and speeds of all flanges, since the
 *     transmitted torque is what is left after accelerating both sides;
 *   - at the start commanded gears are engaged at once, and output.w_start wins.
 * Where motion comes in and torque goes out, that torque follows the acceleration, the
 * speeds and what acts on the flange; the output's also the torques of the paths.
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

/* ---- speeds that are inputs ---- */

static bool is_given(const gm_speed_in *speed_in, scalar s)
{
    return speed_in->flange[s.path < 0 ? GM_MAX_PATHS : s.path];
}

static bool is_any_path_given(const gm_speed_in *speed_in)
{
    bool any = false;
    for (int p = 0; p < GM_MAX_PATHS; p++)
        any = any || speed_in->flange[p];
    return any;
}

static bool is_any_given(const gm_speed_in *speed_in)
{
    return speed_in->flange[GM_MAX_PATHS] || is_any_path_given(speed_in);
}

static const struct {
    variable_id id;
    const char *description;
} swapped[] = {
    {VARIABLE_PATH_TAU,
     "torque into the gearset that the motion of the input flange takes"},
    {VARIABLE_OUTPUT_TAU,
     "torque into the gearset that the motion of the output flange takes"},
    {VARIABLE_PATH_PHI, "angle of the input flange; without influence"},
    {VARIABLE_OUTPUT_PHI, "angle of the output flange; without influence"},
    {VARIABLE_PATH_W, "speed of the input flange"},
    {VARIABLE_OUTPUT_W, "speed of the output flange"},
    {VARIABLE_PATH_A, "acceleration of the input flange, the derivative of its speed"},
    {VARIABLE_OUTPUT_A, "acceleration of the output flange, the derivative of its speed"},
};
enum { N_SWAPPED = sizeof swapped / sizeof *swapped };

/* Its place in the list above; -1: none. */
static int find_swapped(const gm_speed_in *speed_in, scalar s)
{
    for (int i = 0; i < N_SWAPPED; i++)
        if (swapped[i].id == s.id)
            return is_given(speed_in, s) ? i : -1;
    return -1;
}

bool gm_bake_is_swapped(const gm_speed_in *speed_in, scalar s)
{
    return find_swapped(speed_in, s) >= 0;
}

variable gm_bake_variable(const gm_speed_in *speed_in, scalar s)
{
    variable v = gm_bake_variables[s.id];
    const int i = find_swapped(speed_in, s);
    if (i >= 0) {
        const bool goes_out = v.causality == CAUSALITY_INPUT;
        v.description = swapped[i].description;
        v.causality = goes_out ? CAUSALITY_OUTPUT : CAUSALITY_INPUT;
        v.initial = goes_out ? INITIAL_CALCULATED : INITIAL_NONE;
    }
    if (s.id == VARIABLE_FIDELITY && is_any_path_given(speed_in)) {
        v.min = GM_LASH;
        v.description =
            "lash: engaged paths act through spring and backlash; a path whose "
            "speed is an input cannot be rigid";
    }
    return v;
}

/* ---- scalars ---- */

static bool is_there(const gm_speed_in *speed_in, scalar s)
{
    const bool start = s.id == VARIABLE_PATH_W_START || s.id == VARIABLE_OUTPUT_W_START;
    return !(start && is_given(speed_in, s));
}

int gm_bake_scalars(int n_paths, const gm_speed_in *speed_in, scalar *all)
{
    int n = 0;
    for (int id = 0; id < N_VARIABLES; id++) {
        const bool path = gm_bake_variables[id].scope == SCOPE_PATH;
        for (int p = 0; p < (path ? n_paths : 1); p++) {
            all[n] = (scalar){(variable_id)id, path ? p : -1};
            n += is_there(speed_in, all[n]);
        }
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

int gm_bake_states(int n_paths, const gm_speed_in *speed_in, scalar *states,
                   scalar *derivatives)
{
    int n = 0;
    for (int i = 0; i < N_STATES_OF; i++) {
        bool path = gm_bake_variables[states_of[i].state].scope == SCOPE_PATH;
        for (int p = 0; p < (path ? n_paths : 1); p++) {
            states[n] = (scalar){states_of[i].state, path ? p : -1};
            derivatives[n] = (scalar){states_of[i].derivative, path ? p : -1};
            n += !gm_bake_is_swapped(speed_in, states[n]);
        }
    }
    return n;
}

bool gm_bake_integral(const gm_speed_in *speed_in, scalar derivative, scalar *state)
{
    for (int i = 0; i < N_STATES_OF; i++)
        if (states_of[i].derivative == derivative.id) {
            *state = (scalar){states_of[i].state, derivative.path};
            return !gm_bake_is_swapped(speed_in, *state);
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
    case VARIABLE_PATH_TAU:
    case VARIABLE_OUTPUT_TAU:
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

bool gm_bake_follows_oil(const gm_speed_in *speed_in, scalar of)
{
    return follows_load(of.id) || (of.id == VARIABLE_POWER && is_any_given(speed_in));
}

/* Torques that come in; and the acceleration of the output where that does: rigid paths
 * transmit what it leaves of their torque. */
static bool is_load(const gm_speed_in *speed_in, scalar s)
{
    const bool is_swapped = gm_bake_is_swapped(speed_in, s);
    return ((s.id == VARIABLE_PATH_TAU || s.id == VARIABLE_OUTPUT_TAU) && !is_swapped) ||
           (s.id == VARIABLE_OUTPUT_A && is_swapped);
}

static bool is_given_acceleration(const gm_speed_in *speed_in, scalar s)
{
    return (s.id == VARIABLE_PATH_A || s.id == VARIABLE_OUTPUT_A) &&
           gm_bake_is_swapped(speed_in, s);
}

static bool is_speed(variable_id id)
{
    return id == VARIABLE_PATH_W || id == VARIABLE_OUTPUT_W;
}

/* A load acts on a path through the output's motion, unless that is given. */
static bool reaches(const gm_speed_in *speed_in, scalar of, scalar load)
{
    return of.path < 0 || load.path < 0 || load.path == of.path ||
           !speed_in->flange[GM_MAX_PATHS];
}

dependency gm_bake_depends(const gm_speed_in *speed_in, scalar of, scalar on)
{
    if (is_state(of.id))
        return of.id == on.id && of.path == on.path ? DEPENDENCY_CONSTANT
                                                    : DEPENDENCY_NONE;
    const bool own = on.path == of.path || on.path < 0, speed = is_speed(on.id),
               load = is_load(speed_in, on), twist = on.id == VARIABLE_PATH_TWIST;
    bool depends = false;
    switch (of.id) {
    case VARIABLE_PATH_TWIST_RATE: /* w_p - r w_o or 0 */
        return speed && own ? DEPENDENCY_DISCRETE : DEPENDENCY_NONE;
    case VARIABLE_POWER:
        depends =
            load || speed ||
            (is_any_given(speed_in) && (twist || is_given_acceleration(speed_in, on)));
        break;
    case VARIABLE_KINETIC_ENERGY:
        depends = speed;
        break;
    case VARIABLE_ELASTIC_ENERGY:
        depends = twist;
        break;
    case VARIABLE_PATH_TAU: /* other torques end at the output */
        depends = speed ||
                  (on.path == of.path && (twist || is_given_acceleration(speed_in, on)));
        break;
    case VARIABLE_PATH_A: /* what twists the other path does not reach this one */
        depends = (load && reaches(speed_in, of, on)) || speed || (twist && own);
        break;
    default:
        depends = follows_load(of.id) &&
                  ((load && reaches(speed_in, of, on)) || speed || twist);
    }
    return depends ? DEPENDENCY_DEPENDENT : DEPENDENCY_NONE;
}

static bool sets_speeds(const gm_speed_in *speed_in, scalar s)
{
    return s.id == VARIABLE_OUTPUT_W_START || s.id == VARIABLE_PATH_W_START ||
           s.id == VARIABLE_PATH_GEAR ||
           (is_speed(s.id) && gm_bake_is_swapped(speed_in, s));
}

/* The output's speed at the start: its own, or that of an engaged path that is given. */
static bool sets_output(const gm_speed_in *speed_in, scalar s)
{
    return s.id == VARIABLE_OUTPUT_W_START ||
           (is_speed(s.id) && gm_bake_is_swapped(speed_in, s)) ||
           (s.id == VARIABLE_PATH_GEAR && is_given(speed_in, s));
}

static bool is_load_parameter(variable_id id)
{
    return id == VARIABLE_LOSS_SCALE || id == VARIABLE_PATH_TWIST ||
           id == VARIABLE_FIDELITY;
}

static bool depends_initially(const gm_speed_in *speed_in, scalar of, scalar on)
{
    const bool load = is_load(speed_in, on) || is_given_acceleration(speed_in, on);
    switch (of.id) {
    case VARIABLE_OUTPUT_W:
        return sets_output(speed_in, on);
    case VARIABLE_PATH_W:
        return sets_output(speed_in, on) ||
               (sets_speeds(speed_in, on) && on.path == of.path);
    case VARIABLE_PATH_TWIST_RATE: /* zero where the speeds of a gear agree */
        return is_given(speed_in, of) &&
               (sets_output(speed_in, on) ||
                (sets_speeds(speed_in, on) && on.path == of.path));
    case VARIABLE_PATH_STATE:
    case VARIABLE_PATH_GEAR_REFUSED:
        return on.id == VARIABLE_PATH_GEAR && on.path == of.path;
    case VARIABLE_PATH_INERTIA:
    case VARIABLE_OUTPUT_INERTIA:
    case VARIABLE_RECOMMENDED_STEP:
        return on.id == VARIABLE_PATH_GEAR || on.id == VARIABLE_FIDELITY;
    case VARIABLE_KINETIC_ENERGY:
        return sets_speeds(speed_in, on);
    case VARIABLE_ELASTIC_ENERGY:
        return on.id == VARIABLE_PATH_GEAR || on.id == VARIABLE_PATH_TWIST ||
               on.id == VARIABLE_FIDELITY;
    case VARIABLE_POWER:
        return load || sets_speeds(speed_in, on) ||
               (is_any_given(speed_in) && is_load_parameter(on.id));
    case VARIABLE_PATH_A:
        if (on.id == VARIABLE_PATH_TWIST)
            return on.path == of.path;
        /* fallthrough */
    default:
        return follows_load(of.id) &&
               (load || sets_speeds(speed_in, on) || is_load_parameter(on.id));
    }
}

dependency gm_bake_depends_initially(const gm_speed_in *speed_in, scalar of, scalar on)
{
    return depends_initially(speed_in, of, on) ? DEPENDENCY_DEPENDENT : DEPENDENCY_NONE;
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
