/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/gm_fmu_steps.h"

#include "base/alloc.h"
#include "plant/fmu_motion.h"

#include <math.h>
#include <string.h>

/* Size that absolute errors refer to. */
#define NOMINAL_SPEED 100.0 /* rad/s */
/* A time is reached when it is so near: sums of steps round. */
#define SAME_TIME 1e-6 /* of a step */

struct gm_fmu_steps_plant {
    char *path;
    gm_fmu_fidelity fidelity;
    double step;
    int n_paths;
};

/* What is read of every flange after a step, and of the component. */
enum { READ_W, READ_A, READ_INERTIA, N_READ };
enum { READ_LOSS, READ_KINETIC, READ_ELASTIC, N_ENERGIES };

typedef struct steps {
    const gm_fmu_steps_plant *plant;
    gm_fmu *fmu;
    int n_flanges;
    unsigned tau[GM_MAX_FLANGES], read[GM_MAX_FLANGES * N_READ], energy[N_ENERGIES];
    unsigned gear[GM_MAX_INPUT_PATHS], state[GM_MAX_INPUT_PATHS];
    long k; /* steps that were taken */
    int commanded[GM_MAX_INPUT_PATHS];
    double torque[GM_MAX_FLANGES];         /* of the last step */
    double value[GM_MAX_FLANGES * N_READ]; /* after it */
    double begin[GM_MAX_FLANGES];          /* speeds around the component then, rad/s */
    double made_up[GM_MAX_FLANGES];        /* rad/s2: what these were off, over h */
    double energies[N_ENERGIES];
    int mode[GM_MAX_INPUT_PATHS];
} steps;

/* The states: the speeds as they are around the component. */
static int n_states(const void *user)
{
    return ((const steps *)user)->n_flanges;
}

/* ---- variables ---- */

static gm_status find_flange(steps *s, int f, gm_error *error)
{
    static const char *const names[N_READ] = {"w", "a", "inertia"};
    const char *flange = gm_fmu_flange_name(s->plant->n_paths, f);
    gm_status status = gm_fmu_find_at(s->fmu, flange, "tau", &s->tau[f], error);
    for (int i = 0; i < N_READ && status == GM_OK; i++)
        status =
            gm_fmu_find_at(s->fmu, flange, names[i], &s->read[f * N_READ + i], error);
    if (status == GM_OK && f > 0)
        status = gm_fmu_find_at(s->fmu, flange, "gear", &s->gear[f - 1], error);
    if (status == GM_OK && f > 0)
        status = gm_fmu_find_at(s->fmu, flange, "state", &s->state[f - 1], error);
    return status;
}

static gm_status find_all(steps *s, gm_error *error)
{
    static const char *const names[N_ENERGIES] = {"loss_power", "kinetic_energy",
                                                  "elastic_energy"};
    gm_status status = GM_OK;
    for (int i = 0; i < N_ENERGIES && status == GM_OK; i++)
        status = gm_fmu_find(s->fmu, names[i], &s->energy[i], error);
    for (int f = 0; f < s->n_flanges && status == GM_OK; f++)
        status = find_flange(s, f, error);
    return status;
}

/* ---- life ---- */

static void destroy(void *user)
{
    steps *s = user;
    if (!s)
        return;
    gm_fmu_close(s->fmu);
    gm_free(s);
}

static gm_status create(const void *plant, void **made, gm_error *error)
{
    steps *s = gm_calloc(1, sizeof *s);
    if (!s)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    s->plant = plant;
    s->n_flanges = 1 + s->plant->n_paths;
    gm_status status = gm_fmu_open(s->plant->path, &s->fmu, error);
    if (status == GM_OK)
        status = find_all(s, error);
    if (status != GM_OK) {
        destroy(s);
        return status;
    }
    *made = s;
    return GM_OK;
}

static gm_status set_gears(steps *s, const int *gear, gm_error *error)
{
    return gm_fmu_checked(s->fmu, "fmi2SetInteger",
                          s->fmu->library.SetInteger(s->fmu->component, s->gear,
                                                     (size_t)s->plant->n_paths, gear),
                          error);
}

static gm_status read_all(steps *s, gm_error *error)
{
    const fmu_library *l = &s->fmu->library;
    fmi2Status status =
        l->GetReal(s->fmu->component, s->read, (size_t)(s->n_flanges * N_READ), s->value);
    if (status <= fmi2Warning)
        status = l->GetReal(s->fmu->component, s->energy, N_ENERGIES, s->energies);
    if (status <= fmi2Warning)
        status = l->GetInteger(s->fmu->component, s->state, (size_t)s->plant->n_paths,
                               s->mode);
    return gm_fmu_checked(s->fmu, "fmi2GetReal", status, error);
}

/* Into initialisation mode with these gears, at these speeds (NULL: at rest). */
static gm_status initialise(steps *s, const int *gear, const double *speed,
                            gm_error *error)
{
    unsigned reference = 0;
    gm_status status = gm_fmu_reset(s->fmu, error);
    if (status == GM_OK)
        status = gm_fmu_find(s->fmu, "fidelity", &reference, error);
    if (status == GM_OK)
        status = gm_fmu_set_integer(s->fmu, reference, (int)s->plant->fidelity, error);
    for (int f = 0; f < s->n_flanges && status == GM_OK && speed; f++) {
        status = gm_fmu_find_at(s->fmu, gm_fmu_flange_name(s->plant->n_paths, f),
                                "w_start", &reference, error);
        if (status == GM_OK)
            status = gm_fmu_set_real(s->fmu, reference, speed[f], error);
    }
    if (status == GM_OK)
        status = gm_fmu_initialise(s->fmu, error);
    if (status == GM_OK)
        status = set_gears(s, gear, error);
    return status == GM_OK ? gm_fmu_start(s->fmu, error) : status;
}

static gm_status start(void *user, const gm_motion_input *input, const double *speed,
                       double *x, gm_error *error)
{
    steps *s = user;
    gm_status status = initialise(s, input->gear, speed, error);
    if (status == GM_OK)
        status = read_all(s, error);
    s->k = 0;
    memcpy(s->commanded, input->gear, sizeof s->commanded);
    memset(s->torque, 0, sizeof s->torque);
    memset(s->made_up, 0, sizeof s->made_up);
    for (int f = 0; f < s->n_flanges; f++)
        x[f] = s->begin[f] = s->value[f * N_READ + READ_W];
    return status;
}

/* ---- between two steps ---- */

static int rates(void *user, const gm_motion_input *input, const double *x, double *dx)
{
    const steps *s = user;
    (void)x;
    for (int f = 0; f < s->n_flanges; f++) {
        const double *v = &s->value[f * N_READ];
        dx[f] = v[READ_A] + (input->torque[f] - s->torque[f]) / v[READ_INERTIA] +
                s->made_up[f];
    }
    return 0;
}

static int torque_column(void *user, const gm_motion_input *input, const double *x,
                         int flange, double *column)
{
    const steps *s = user;
    (void)input;
    (void)x;
    memset(column, 0, (size_t)n_states(s) * sizeof *column);
    column[flange] = 1.0 / s->value[flange * N_READ + READ_INERTIA];
    return 0;
}

/* The rates depend on no state but through the torques. */
static int entries(const void *user)
{
    return n_states(user);
}

static void pattern(const void *user, int *column_start, int *row)
{
    for (int i = 0; i < n_states(user); i++)
        column_start[i] = row[i] = i;
    column_start[n_states(user)] = n_states(user);
}

static int jacobian(void *user, const gm_motion_input *input, const double *x,
                    double *value)
{
    (void)input;
    (void)x;
    memset(value, 0, (size_t)n_states(user) * sizeof *value);
    return 0;
}

/* ---- a step ---- */

static double next(const void *user, double t)
{
    const steps *s = user;
    (void)t;
    return (double)(s->k + 1) * s->plant->step;
}

/* The whole impulse since the last step, spread evenly: rates() solved for the torque. */
static void find_torques(steps *s, const double *x)
{
    for (int f = 0; f < s->n_flanges; f++) {
        const double *v = &s->value[f * N_READ];
        const double rate = (x[f] - s->begin[f]) / s->plant->step;
        s->torque[f] += v[READ_INERTIA] * (rate - v[READ_A] - s->made_up[f]);
    }
}

static gm_status take_step(steps *s, const double *x, gm_error *error)
{
    const double h = s->plant->step;
    const size_t n = (size_t)s->n_flanges;
    find_torques(s, x);
    gm_status status = gm_fmu_checked(
        s->fmu, "fmi2SetReal",
        s->fmu->library.SetReal(s->fmu->component, s->tau, n, s->torque), error);
    if (status == GM_OK)
        status = gm_fmu_step(s->fmu, (double)s->k * h, h, error);
    if (status == GM_OK)
        status = read_all(s, error);
    if (status != GM_OK)
        return status;
    s->k++;
    for (int f = 0; f < s->n_flanges; f++) {
        s->begin[f] = x[f];
        s->made_up[f] = (s->value[f * N_READ + READ_W] - x[f]) / h;
    }
    return GM_OK;
}

static gm_status handle(void *user, const gm_motion_input *input, double t, double *x,
                        int *changed, gm_error *error)
{
    steps *s = user;
    *changed = 0;
    if (t < next(s, t) - SAME_TIME * s->plant->step)
        return GM_OK;
    gm_status status = take_step(s, x, error); /* the rates have a kink, nothing jumps */
    if (status == GM_OK && memcmp(s->commanded, input->gear, sizeof s->commanded) != 0) {
        memcpy(s->commanded, input->gear, sizeof s->commanded);
        status = set_gears(s, s->commanded, error);
    }
    return status;
}

static int no_events(const void *user)
{
    (void)user;
    return 0;
}

static int events(void *user, const gm_motion_input *input, const double *x, double *g)
{
    (void)user;
    (void)input;
    (void)x;
    (void)g;
    return 0;
}

/* ---- what is seen ---- */

static int speed_state(const void *user, int flange)
{
    (void)user;
    return flange;
}

static const char *state_name(const void *user, int i)
{
    const steps *s = user;
    static const char *const names[2][GM_MAX_FLANGES] = {{"output.w", "input.w"},
                                                         {"output.w", "odd.w", "even.w"}};
    return names[s->plant->n_paths - 1][i];
}

static void tolerances(const void *user, double relative, double *absolute)
{
    const steps *s = user;
    for (int f = 0; f < s->n_flanges; f++) {
        absolute[f] = relative * NOMINAL_SPEED;
    }
}

static void view(void *user, const gm_motion_input *input, const double *x,
                 gm_motion_view *seen)
{
    const steps *s = user;
    double dx[GM_MAX_FLANGES];
    *seen = (gm_motion_view){.loss_power = s->energies[READ_LOSS],
                             .stored_energy =
                                 s->energies[READ_KINETIC] + s->energies[READ_ELASTIC]};
    (void)rates(user, input, x, dx);
    for (int f = 0; f < s->n_flanges; f++) {
        seen->speed[f] = x[f];
        seen->acceleration[f] = dx[f];
    }
    memcpy(seen->state, s->mode, sizeof seen->state);
}

static int n_signals(const void *user)
{
    (void)user;
    return 0;
}

static const gm_dynamics_class in_steps = {
    .create = create,
    .destroy = destroy,
    .n_states = n_states,
    .start = start,
    .tolerances = tolerances,
    .rates = rates,
    .entries = entries,
    .pattern = pattern,
    .jacobian = jacobian,
    .torque_column = torque_column,
    .torque_row = speed_state,
    .speed_state = speed_state,
    .n_events = no_events,
    .events = events,
    .next = next,
    .handle = handle,
    .view = view,
    .n_signals = n_signals,
    .state_name = state_name,
};

/* ---- the plant ---- */

void gm_fmu_steps_destroy(gm_fmu_steps_plant *plant)
{
    if (!plant)
        return;
    gm_free(plant->path);
    gm_free(plant);
}

static gm_status inspect(gm_fmu_steps_plant *plant, gm_error *error)
{
    gm_fmu *fmu = NULL;
    void *first = NULL;
    gm_status status = gm_fmu_open(plant->path, &fmu, error);
    if (status != GM_OK)
        return status;
    plant->n_paths = gm_fmu_has(fmu, "odd.w") ? 2 : 1;
    gm_fmu_close(fmu);
    status = create(plant, &first, error);
    destroy(first);
    return status;
}

gm_status gm_fmu_steps_create(const char *path, gm_fmu_fidelity fidelity, double step,
                              gm_fmu_steps_plant **plant, gm_error *error)
{
    if (!(step > 0.0) || !isfinite(step))
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "a communication step is %g s, must be more than 0", step);
    gm_fmu_steps_plant *made = gm_calloc(1, sizeof *made);
    if (made)
        made->path = gm_strdup(path);
    if (!made || !made->path) {
        gm_fmu_steps_destroy(made);
        return gm_fail(error, GM_ERR_MEMORY, "no memory to open %s", path);
    }
    made->fidelity = fidelity;
    made->step = step;
    gm_status status = inspect(made, error);
    if (status == GM_OK)
        *plant = made;
    else
        gm_fmu_steps_destroy(made);
    return status;
}

gm_dynamics gm_fmu_steps_dynamics(const gm_fmu_steps_plant *plant)
{
    return (gm_dynamics){.is = &in_steps, .plant = plant, .n_paths = plant->n_paths};
}

gm_status gm_fmu_steps_recommended(const gm_fmu_steps_plant *plant,
                                   const int gear[GM_MAX_INPUT_PATHS], double *step,
                                   gm_error *error)
{
    void *motion = NULL;
    unsigned reference = 0;
    gm_status status = create(plant, &motion, error);
    if (status != GM_OK)
        return status;
    steps *s = motion;
    status = initialise(s, gear, NULL, error);
    if (status == GM_OK)
        status = gm_fmu_find(s->fmu, "recommended_step", &reference, error);
    if (status == GM_OK)
        status = gm_fmu_get_real(s->fmu, reference, step, error);
    destroy(motion);
    return status;
}
