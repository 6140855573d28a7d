/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/sun_ode.h"

#include "base/alloc.h"
#include "solve/sun.h"

#include <cvode/cvode.h>
#include <math.h>
#include <string.h>

/* A contact that closes within a step needs more cuts than the library's seven. */
#define MAX_ERROR_FAILURES 20
#define MAX_CONVERGENCE_FAILURES 20
#define MIN_STEP 1e-13 /* s: far below any motion of steel parts */
/* Steps that a Jacobian serves, which is the least that the library sets up its equations
   for. Its own 50 are a second of smooth driving, in which a clutch that opens becomes
   eight times as soft; the library trusts the rate of convergence that it saw before, and
   the torque of the clutch drifts away. */
#define JACOBIAN_STEPS 20

struct gm_sun_ode {
    gm_sun_ode_system system;
    gm_sun sun;
    void *cvode;
    N_Vector x, absolute, weight, error;
    SUNMatrix jacobian;
    SUNLinearSolver linear;
    double *value;
    double relative, step_max;
    int order_max;
    double t;                 /* end of the last step */
    gm_sun_ode_counts before; /* work of the runs that have ended */
    int initialised;
    int nan_state;
};

/* ---- callbacks ---- */

static int call_rates(double t, N_Vector x, N_Vector dx, void *user)
{
    gm_sun_ode *ode = user;
    const gm_sun_ode_system *system = &ode->system;
    double *rate = N_VGetArrayPointer(dx);
    int flag = system->rates(system->user, t, N_VGetArrayPointer(x), rate);
    for (int i = 0; i < system->n && flag == 0; i++)
        if (!isfinite(rate[i])) {
            ode->nan_state = i;
            flag = 1;
        }
    return flag;
}

static int call_jacobian(double t, N_Vector x, N_Vector dx, SUNMatrix J, void *user,
                         N_Vector work_1, N_Vector work_2, N_Vector work_3)
{
    gm_sun_ode *ode = user;
    const gm_sun_ode_system *system = &ode->system;
    (void)dx, (void)work_1, (void)work_2, (void)work_3;
    int flag = system->jacobian(system->user, t, N_VGetArrayPointer(x), ode->value);
    if (flag == 0)
        gm_sun_matrix_fill(J, system->n, system->column_start, system->row, ode->value);
    return flag;
}

static int call_events(double t, N_Vector x, double *g, void *user)
{
    const gm_sun_ode_system *system = &((gm_sun_ode *)user)->system;
    return system->events(system->user, t, N_VGetArrayPointer(x), g);
}

/* ---- objects ---- */

static int make_vectors(gm_sun_ode *ode, const double *absolute)
{
    int n = ode->system.n;
    N_Vector *vectors[] = {&ode->x, &ode->absolute, &ode->weight, &ode->error};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        *vectors[i] = N_VNew_Serial(n GM_SUN_LAST(&ode->sun));
        if (!*vectors[i])
            return 1;
        N_VConst(0.0, *vectors[i]);
    }
    memcpy(N_VGetArrayPointer(ode->absolute), absolute, (size_t)n * sizeof *absolute);
    return 0;
}

static int make_matrix(gm_sun_ode *ode)
{
    int entries = ode->system.column_start[ode->system.n];
    ode->value = gm_calloc((size_t)entries, sizeof *ode->value);
    ode->jacobian = gm_sun_matrix(&ode->sun, ode->system.n, entries);
    if (!ode->value || !ode->jacobian)
        return 1;
    ode->linear = gm_sun_linear(&ode->sun, ode->x, ode->jacobian);
    return ode->linear == NULL;
}

gm_sun_ode *gm_sun_ode_create(const gm_sun_ode_system *system, double relative,
                              const double *absolute, int order_max, double step_max)
{
    gm_sun_ode *ode = gm_calloc(1, sizeof *ode);
    if (!ode)
        return NULL;
    ode->system = *system;
    ode->relative = relative;
    ode->order_max = order_max;
    ode->step_max = step_max;
    if (gm_sun_open(&ode->sun) || make_vectors(ode, absolute) || make_matrix(ode)) {
        gm_sun_ode_destroy(ode);
        return NULL;
    }
    ode->cvode = CVodeCreate(CV_BDF GM_SUN_LAST(&ode->sun));
    if (!ode->cvode) {
        gm_sun_ode_destroy(ode);
        return NULL;
    }
    return ode;
}

void gm_sun_ode_destroy(gm_sun_ode *ode)
{
    if (!ode)
        return;
    if (ode->cvode)
        CVodeFree(&ode->cvode);
    if (ode->linear)
        SUNLinSolFree(ode->linear);
    if (ode->jacobian)
        SUNMatDestroy(ode->jacobian);
    N_Vector vectors[] = {ode->x, ode->absolute, ode->weight, ode->error};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        if (vectors[i])
            N_VDestroy(vectors[i]);
    gm_sun_close(&ode->sun);
    gm_free(ode->value);
    gm_free(ode);
}

/* ---- runs ---- */

/* CVODE copies settings when it is first given a state; they then hold for all runs. */
static int initialise(gm_sun_ode *ode, double t)
{
    void *cvode = ode->cvode;
    const gm_sun_ode_system *system = &ode->system;
    return GM_SUN_CATCH(CVodeSetErrHandlerFn, cvode, &ode->sun) ||
           CVodeInit(cvode, call_rates, t, ode->x) || CVodeSetUserData(cvode, ode) ||
           CVodeSVtolerances(cvode, ode->relative, ode->absolute) ||
           CVodeSetMaxOrd(cvode, ode->order_max) ||
           CVodeSetLinearSolver(cvode, ode->linear, ode->jacobian) ||
           CVodeSetJacFn(cvode, call_jacobian) ||
           CVodeSetMaxErrTestFails(cvode, MAX_ERROR_FAILURES) ||
           CVodeSetMaxConvFails(cvode, MAX_CONVERGENCE_FAILURES) ||
           CVodeSetJacEvalFrequency(cvode, JACOBIAN_STEPS) ||
           CVodeSetMinStep(cvode, MIN_STEP) ||
           (ode->step_max > 0.0 && CVodeSetMaxStep(cvode, ode->step_max)) ||
           (system->n_events > 0 && CVodeRootInit(cvode, system->n_events, call_events));
}

/* CVODE counts from each start. */
static gm_sun_ode_counts present_work(const gm_sun_ode *ode)
{
    gm_sun_ode_counts c = {0};
    if (ode->initialised) {
        (void)CVodeGetNumSteps(ode->cvode, &c.steps);
        (void)CVodeGetNumRhsEvals(ode->cvode, &c.rates);
        (void)CVodeGetNumJacEvals(ode->cvode, &c.jacobians);
        (void)CVodeGetNumErrTestFails(ode->cvode, &c.error_failures);
        (void)CVodeGetNumNonlinSolvConvFails(ode->cvode, &c.convergence_failures);
    }
    return c;
}

gm_sun_ode_counts gm_sun_ode_work(const gm_sun_ode *ode)
{
    gm_sun_ode_counts sum = ode->before, now = present_work(ode);
    sum.steps += now.steps;
    sum.rates += now.rates;
    sum.jacobians += now.jacobians;
    sum.error_failures += now.error_failures;
    sum.convergence_failures += now.convergence_failures;
    return sum;
}

int gm_sun_ode_start(gm_sun_ode *ode, double t, const double *x, double step)
{
    gm_sun_ode_counts work = gm_sun_ode_work(ode);
    memcpy(N_VGetArrayPointer(ode->x), x, (size_t)ode->system.n * sizeof *x);
    ode->sun.message[0] = '\0';
    ode->t = t;
    ode->nan_state = -1;
    int flag = ode->initialised ? CVodeReInit(ode->cvode, t, ode->x) : initialise(ode, t);
    ode->before = work;
    ode->initialised |= flag == 0;
    return flag || CVodeSetInitStep(ode->cvode, step);
}

int gm_sun_ode_stop_at(gm_sun_ode *ode, double t)
{
    return CVodeSetStopTime(ode->cvode, t);
}

static gm_sun_ode_outcome outcome_of(int flag)
{
    switch (flag) {
    case CV_SUCCESS:
    case CV_WARNING:
        return GM_ODE_STEP;
    case CV_TSTOP_RETURN:
        return GM_ODE_STOP;
    case CV_ROOT_RETURN:
        return GM_ODE_EVENT;
    case CV_ERR_FAILURE:
        return GM_ODE_ERROR_TOO_LARGE;
    case CV_CONV_FAILURE:
        return GM_ODE_NO_CONVERGENCE;
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
    case CV_RTFUNC_FAIL:
    case CV_LSETUP_FAIL:
        return GM_ODE_NO_RATES;
    default:
        return GM_ODE_BROKEN;
    }
}

gm_sun_ode_outcome gm_sun_ode_step(gm_sun_ode *ode, double *t, double *x)
{
    const double far = ode->t + 1.0; /* gives CVODE the direction, no more */
    gm_sun_ode_outcome outcome =
        outcome_of(CVode(ode->cvode, far, ode->x, &ode->t, CV_ONE_STEP));
    *t = ode->t;
    memcpy(x, N_VGetArrayPointer(ode->x), (size_t)ode->system.n * sizeof *x);
    return outcome;
}

int gm_sun_ode_at(gm_sun_ode *ode, double t, double *x)
{
    if (CVodeGetDky(ode->cvode, t, 0, ode->error))
        return 1;
    memcpy(x, N_VGetArrayPointer(ode->error), (size_t)ode->system.n * sizeof *x);
    return 0;
}

double gm_sun_ode_last_step(const gm_sun_ode *ode)
{
    double step = 0.0;
    (void)CVodeGetLastStep(ode->cvode, &step);
    return step;
}

int gm_sun_ode_worst_state(gm_sun_ode *ode)
{
    int worst = 0;
    if (CVodeGetEstLocalErrors(ode->cvode, ode->error) ||
        CVodeGetErrWeights(ode->cvode, ode->weight))
        return worst;
    const double *e = N_VGetArrayPointer(ode->error);
    const double *w = N_VGetArrayPointer(ode->weight);
    for (int i = 1; i < ode->system.n; i++)
        if (fabs(e[i] * w[i]) > fabs(e[worst] * w[worst]))
            worst = i;
    return worst;
}

int gm_sun_ode_nan_state(const gm_sun_ode *ode)
{
    return ode->nan_state;
}

const char *gm_sun_ode_message(const gm_sun_ode *ode)
{
    return ode->sun.message;
}
