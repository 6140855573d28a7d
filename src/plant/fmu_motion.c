/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/fmu_motion.h"

#include "base/alloc.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Sizes that absolute errors refer to. A twist of 0.1 rad at a tolerance of 1e-6 is a few
 * thousandths of a newton metre of the stiffest gear. */
#define NOMINAL_SPEED 100.0 /* rad/s */
#define NOMINAL_ANGLE 10.0  /* rad */
#define NOMINAL_TWIST 0.1   /* rad */
#define NOMINAL_ENERGY 1e4  /* J */
enum { EVENT_ROUNDS = 10 };

const char *gm_fmu_flange_name(int n_paths, int flange)
{
    static const char *const two[] = {"output", "odd", "even"};
    static const char *const one[] = {"output", "input"};
    return n_paths == 2 ? two[flange] : one[flange];
}

/* ---- variables ---- */

gm_status gm_fmu_find_at(const gm_fmu *fmu, const char *flange, const char *name,
                         unsigned *reference, gm_error *error)
{
    char full[64];
    (void)snprintf(full, sizeof full, "%s.%s", flange, name);
    return gm_fmu_find(fmu, full, reference, error);
}

static gm_status find_flange(gm_fmu_motion *m, int f, gm_error *error)
{
    const char *flange = gm_fmu_flange_name(m->plant->n_paths, f);
    char speed[64];
    gm_status status = gm_fmu_find_at(m->fmu, flange, "tau", &m->tau[f], error);
    if (status == GM_OK)
        status = gm_fmu_find_at(m->fmu, flange, "a", &m->acceleration[f], error);
    if (status == GM_OK && f > 0)
        status = gm_fmu_find_at(m->fmu, flange, "gear", &m->gear[f - 1], error);
    if (status == GM_OK && f > 0)
        status = gm_fmu_find_at(m->fmu, flange, "state", &m->state[f - 1], error);
    (void)snprintf(speed, sizeof speed, "%s.w", flange);
    m->speed[f] = -1;
    for (int i = 0; i < m->n; i++)
        if (strcmp(m->fmu->description.states[i].name, speed) == 0)
            m->speed[f] = i;
    if (status == GM_OK && m->speed[f] < 0)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the FMU has no state %s; it is to have torques in and speeds "
                       "out at every flange",
                       m->fmu->path, speed);
    return status;
}

static gm_status find_all(gm_fmu_motion *m, gm_error *error)
{
    gm_status status = gm_fmu_find(m->fmu, "loss_power", &m->energy[0], error);
    if (status == GM_OK)
        status = gm_fmu_find(m->fmu, "kinetic_energy", &m->energy[1], error);
    if (status == GM_OK)
        status = gm_fmu_find(m->fmu, "elastic_energy", &m->energy[2], error);
    for (int f = 0; f <= m->plant->n_paths && status == GM_OK; f++)
        status = find_flange(m, f, error);
    return status;
}

/* ---- life ---- */

static void destroy(void *user)
{
    gm_fmu_motion *m = user;
    if (!m)
        return;
    gm_fmu_close(m->fmu);
    gm_free(m->column);
    gm_free(m->x);
    gm_free(m->indicator);
    gm_free(m->above);
    gm_free(m->state_reference);
    gm_free(m->rate_reference);
    gm_free(m);
}

static gm_status make_room(gm_fmu_motion *m, gm_error *error)
{
    const fmu_description *d = &m->fmu->description;
    m->n = d->n_states;
    m->n_events = d->n_indicators;
    size_t n = (size_t)m->n + 1, n_events = (size_t)m->n_events + 1;
    m->column = gm_calloc(n, sizeof *m->column);
    m->x = gm_calloc(n, sizeof *m->x);
    m->indicator = gm_calloc(n_events, sizeof *m->indicator);
    m->above = gm_calloc(n_events, sizeof *m->above);
    m->state_reference = gm_calloc(n, sizeof *m->state_reference);
    m->rate_reference = gm_calloc(n, sizeof *m->rate_reference);
    if (!m->column || !m->x || !m->indicator || !m->above || !m->state_reference ||
        !m->rate_reference)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to run %s", m->fmu->path);
    for (int i = 0; i < m->n; i++) {
        m->state_reference[i] = d->states[i].reference;
        m->rate_reference[i] = d->states[i].rate_reference;
    }
    return GM_OK;
}

static gm_status create(const void *plant, void **made, gm_error *error)
{
    gm_fmu_motion *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->plant = plant;
    gm_status status = gm_fmu_open_exchange(m->plant->path, &m->fmu, error);
    if (status == GM_OK)
        status = make_room(m, error);
    if (status == GM_OK)
        status = find_all(m, error);
    if (status != GM_OK) {
        destroy(m);
        return status;
    }
    *made = m;
    return GM_OK;
}

/* ---- events ---- */

/* What the FMU was told last holds no more. */
static void forget(gm_fmu_motion *m)
{
    m->x[0] = (double)NAN;
    m->indicators_known = 0;
}

static fmi2Status note_indicators(gm_fmu_motion *m)
{
    fmi2Status status = m->fmu->library.GetEventIndicators(
        m->fmu->component, m->indicator, (size_t)m->n_events);
    for (int i = 0; i < m->n_events; i++)
        m->above[i] = m->indicator[i] > 0.0;
    return status;
}

/* From event mode to continuous time: the FMU settles its modes. */
static gm_status settle(gm_fmu_motion *m, double *x, gm_error *error)
{
    const fmu_library *l = &m->fmu->library;
    forget(m);
    fmi2EventInfo info = {.newDiscreteStatesNeeded = fmi2True};
    gm_status status = GM_OK;
    for (int i = 0; i < EVENT_ROUNDS && info.newDiscreteStatesNeeded && status == GM_OK;
         i++)
        status = gm_fmu_checked(m->fmu, "fmi2NewDiscreteStates",
                                l->NewDiscreteStates(m->fmu->component, &info), error);
    if (status == GM_OK && info.newDiscreteStatesNeeded)
        return gm_fail(error, GM_ERR_SOLVE, "%s: the FMU's event does not end",
                       m->fmu->path);
    if (status == GM_OK)
        status = gm_fmu_checked(m->fmu, "fmi2EnterContinuousTimeMode",
                                l->EnterContinuousTimeMode(m->fmu->component), error);
    if (status == GM_OK)
        status = gm_fmu_checked(
            m->fmu, "fmi2GetContinuousStates",
            l->GetContinuousStates(m->fmu->component, x, (size_t)m->n), error);
    if (status == GM_OK)
        status =
            gm_fmu_checked(m->fmu, "fmi2GetEventIndicators", note_indicators(m), error);
    return status;
}

static int set_torques(gm_fmu_motion *m, const gm_motion_input *input)
{
    size_t n = (size_t)m->plant->n_paths + 1;
    if (memcmp(m->input.torque, input->torque, n * sizeof *input->torque) == 0)
        return 0;
    memcpy(m->input.torque, input->torque, sizeof m->input.torque);
    m->indicators_known = 0;
    return m->fmu->library.SetReal(m->fmu->component, m->tau, n, input->torque) >
           fmi2Warning;
}

static gm_status set_gears(gm_fmu_motion *m, const gm_motion_input *input,
                           gm_error *error)
{
    size_t n = (size_t)m->plant->n_paths;
    memcpy(m->input.gear, input->gear, sizeof m->input.gear);
    return gm_fmu_checked(
        m->fmu, "fmi2SetInteger",
        m->fmu->library.SetInteger(m->fmu->component, m->gear, n, input->gear), error);
}

static gm_status set_start(gm_fmu_motion *m, const char *flange, double speed,
                           gm_error *error)
{
    unsigned reference = 0;
    gm_status status = gm_fmu_find_at(m->fmu, flange, "w_start", &reference, error);
    return status == GM_OK ? gm_fmu_set_real(m->fmu, reference, speed, error) : status;
}

static gm_status set_fidelity(gm_fmu_motion *m, gm_error *error)
{
    unsigned reference = 0;
    gm_status status = gm_fmu_find(m->fmu, "fidelity", &reference, error);
    return status == GM_OK
               ? gm_fmu_set_integer(m->fmu, reference, (int)m->plant->fidelity, error)
               : status;
}

static gm_status start(void *user, const gm_motion_input *input, const double *speed,
                       double *x, gm_error *error)
{
    gm_fmu_motion *m = user;
    gm_status status = gm_fmu_reset(m->fmu, error);
    memset(&m->input, 0, sizeof m->input);
    if (status == GM_OK)
        status = set_fidelity(m, error);
    for (int f = 0; f <= m->plant->n_paths && status == GM_OK; f++)
        status = set_start(m, gm_fmu_flange_name(m->plant->n_paths, f), speed[f], error);
    if (status == GM_OK)
        status = gm_fmu_initialise(m->fmu, error);
    if (status == GM_OK)
        status = set_gears(m, input, error);
    if (status == GM_OK && set_torques(m, input))
        status = gm_fail(error, GM_ERR_TOOL, "%s: fmi2SetReal failed", m->fmu->path);
    if (status == GM_OK)
        status = gm_fmu_start(m->fmu, error);
    return status == GM_OK ? settle(m, x, error) : status;
}

/* ---- continuous time ---- */

/* Setting anything makes the FMU forget what it has found for its present point. */
int gm_fmu_motion_put(gm_fmu_motion *m, const gm_motion_input *input, const double *x)
{
    size_t n = (size_t)m->n, size = n * sizeof *x;
    if (set_torques(m, input))
        return 1;
    if (memcmp(m->x, x, size) == 0)
        return 0;
    forget(m);
    if (m->fmu->library.SetContinuousStates(m->fmu->component, x, n) > fmi2Warning)
        return 1;
    memcpy(m->x, x, size);
    return 0;
}

int gm_fmu_motion_rates(void *user, const gm_motion_input *input, const double *x,
                        double *dx)
{
    gm_fmu_motion *m = user;
    if (gm_fmu_motion_put(m, input, x))
        return 1;
    fmi2Status status =
        m->fmu->library.GetDerivatives(m->fmu->component, dx, (size_t)m->n);
    return status <= fmi2Warning ? 0 : status == fmi2Discard ? 1 : -1;
}

/* After each step the solver asks for the indicators, and handle for the same again. */
static int events(void *user, const gm_motion_input *input, const double *x, double *g)
{
    gm_fmu_motion *m = user;
    size_t n = (size_t)m->n_events;
    if (gm_fmu_motion_put(m, input, x))
        return 1;
    if (!m->indicators_known) {
        if (m->fmu->library.GetEventIndicators(m->fmu->component, m->indicator, n) >
            fmi2Warning)
            return 1;
        m->indicators_known = 1;
    }
    memmove(g, m->indicator, n * sizeof *g);
    return 0;
}

static int crossed(const gm_fmu_motion *m)
{
    for (int i = 0; i < m->n_events; i++)
        if ((m->indicator[i] > 0.0) != m->above[i])
            return 1;
    return 0;
}

static int gears_changed(const gm_fmu_motion *m, const gm_motion_input *input)
{
    return memcmp(m->input.gear, input->gear,
                  (size_t)m->plant->n_paths * sizeof *input->gear) != 0;
}

static gm_status handle(void *user, const gm_motion_input *input, double t, double *x,
                        int *changed, gm_error *error)
{
    gm_fmu_motion *m = user;
    *changed = 0;
    if (events(m, input, x, m->indicator))
        return gm_fail(error, GM_ERR_TOOL, "%s: fmi2GetEventIndicators failed at %.9g s",
                       m->fmu->path, t);
    if (!crossed(m) && !gears_changed(m, input))
        return GM_OK;
    *changed = 1;
    gm_status status = gm_fmu_checked(
        m->fmu, "fmi2SetTime", m->fmu->library.SetTime(m->fmu->component, t), error);
    if (status == GM_OK)
        status = gm_fmu_checked(m->fmu, "fmi2EnterEventMode",
                                m->fmu->library.EnterEventMode(m->fmu->component), error);
    if (status == GM_OK)
        status = set_gears(m, input, error);
    return status == GM_OK ? settle(m, x, error) : status;
}

/* ---- what is seen ---- */

static int n_states(const void *user)
{
    return ((const gm_fmu_motion *)user)->n;
}

static int n_events(const void *user)
{
    return ((const gm_fmu_motion *)user)->n_events;
}

static int speed_state(const void *user, int flange)
{
    return ((const gm_fmu_motion *)user)->speed[flange];
}

static const char *state_name(const void *user, int i)
{
    return ((const gm_fmu_motion *)user)->fmu->description.states[i].name;
}

static double nominal(const char *name)
{
    const char *last = strrchr(name, '.');
    last = last ? last + 1 : name;
    if (strcmp(last, "w") == 0)
        return NOMINAL_SPEED;
    if (strcmp(last, "phi") == 0)
        return NOMINAL_ANGLE;
    return strcmp(last, "twist") == 0 ? NOMINAL_TWIST : NOMINAL_ENERGY;
}

static void tolerances(const void *user, double relative, double *absolute)
{
    const gm_fmu_motion *m = user;
    for (int i = 0; i < m->n; i++)
        absolute[i] = relative * nominal(m->fmu->description.states[i].name);
}

static void view(void *user, const gm_motion_input *input, const double *x,
                 gm_motion_view *seen)
{
    gm_fmu_motion *m = user;
    size_t n_flanges = (size_t)m->plant->n_paths + 1;
    double energy[N_VIEW] = {(double)NAN, (double)NAN, (double)NAN};
    *seen = (gm_motion_view){.loss_power = 0.0};
    if (gm_fmu_motion_put(m, input, x) == 0) {
        (void)m->fmu->library.GetReal(m->fmu->component, m->energy, N_VIEW, energy);
        (void)m->fmu->library.GetReal(m->fmu->component, m->acceleration, n_flanges,
                                      seen->acceleration);
        (void)m->fmu->library.GetInteger(m->fmu->component, m->state,
                                         (size_t)m->plant->n_paths, seen->state);
    }
    for (int f = 0; f <= m->plant->n_paths; f++)
        seen->speed[f] = x[m->speed[f]];
    seen->loss_power = energy[0];
    seen->stored_energy = energy[1] + energy[2];
}

static int n_signals(const void *user)
{
    (void)user;
    return 0;
}

#define CALLS                                                                            \
    .create = create, .destroy = destroy, .n_states = n_states, .start = start,          \
    .tolerances = tolerances, .rates = gm_fmu_motion_rates,                              \
    .torque_column = gm_fmu_motion_torque_column, .speed_state = speed_state,            \
    .n_events = n_events, .events = events, .handle = handle, .view = view,              \
    .n_signals = n_signals, .state_name = state_name

static const gm_dynamics_class with_differences = {CALLS};
static const gm_dynamics_class with_derivatives = {
    CALLS, .entries = gm_fmu_motion_entries, .pattern = gm_fmu_motion_pattern,
    .jacobian = gm_fmu_motion_jacobian};

/* ---- the plant ---- */

void gm_fmu_plant_destroy(gm_fmu_plant *plant)
{
    if (!plant)
        return;
    gm_free(plant->path);
    gm_free(plant);
}

/* What only the file itself can tell: its paths, and whether it gives derivatives. */
static gm_status inspect(gm_fmu_plant *plant, gm_error *error)
{
    gm_fmu *fmu = NULL;
    void *first = NULL;
    gm_status status = gm_fmu_open_exchange(plant->path, &fmu, error);
    if (status != GM_OK)
        return status;
    plant->n_paths = gm_fmu_has(fmu, "odd.w") ? 2 : 1;
    plant->directional =
        fmu->description.directional && fmu->library.GetDirectionalDerivative;
    gm_fmu_close(fmu);
    status = create(plant, &first, error);
    destroy(first);
    return status;
}

gm_status gm_fmu_plant_create(const char *path, gm_fmu_fidelity fidelity,
                              gm_fmu_plant **plant, gm_error *error)
{
    gm_fmu_plant *made = gm_calloc(1, sizeof *made);
    if (made)
        made->path = gm_strdup(path);
    if (!made || !made->path) {
        gm_fmu_plant_destroy(made);
        return gm_fail(error, GM_ERR_MEMORY, "no memory to open %s", path);
    }
    made->fidelity = fidelity;
    gm_status status = inspect(made, error);
    if (status != GM_OK) {
        gm_fmu_plant_destroy(made);
        return status;
    }
    *plant = made;
    return GM_OK;
}

gm_dynamics gm_fmu_plant_dynamics(const gm_fmu_plant *plant)
{
    return (gm_dynamics){.is = plant->directional ? &with_derivatives : &with_differences,
                         .plant = plant,
                         .n_paths = plant->n_paths};
}
