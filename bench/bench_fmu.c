/* SPDX-License-Identifier: BSD-2-Clause
 *
 * bench_fmu FILE.fmu: what an importer pays for a baked component, called from C as a
 * simulator does, without a layer in between.
 *
 *   instantiate   fmi2Instantiate + fmi2FreeInstance
 *   step          fmi2DoStep(1 ms), first path in gear 1 under 50 N.m, the other one
 *                 (if there is one) preselected in gear 2
 *   free          the same, the other path in neutral and turning
 *   resting       the same, the other path in neutral and at rest
 *   cycle         as step, with all torques set before and all speeds and accelerations
 *                 read after each step
 *   switching     as step, with the torque changing its sign every 10 ms
 *
 * All but the first in fidelity rigid, then in lash.
 *
 * Times are medians over batches of 100 calls; each batch starts anew at 300 rad/s of the
 * first path. Output as JSON, nanoseconds.
 */
#include "core/gm_reduced.h"
#include "plant/fmu_archive.h"
#include "plant/fmu_description.h"
#include "plant/fmu_library.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BATCH = 100, BATCHES = 1001, MOST = 8 };

typedef struct bench {
    fmu_library fmu;
    fmu_description description;
    fmi2Component c;
    double t, ratio; /* of the first path's gear */
    int n_tau, n_out, n_gear;
    unsigned tau[MOST], out[MOST], gear[MOST];
    int fidelity;       /* value of the parameter */
    int other_gear;     /* 1: the other path is preselected */
    double other_speed; /* else it turns freely, rad/s */
} bench;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void must(int good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "bench_fmu: %s\n", what);
    exit(1);
}

static fmi2Component instantiate(bench *b)
{
    static const fmi2CallbackFunctions none = {0};
    return b->fmu.Instantiate("bench", fmi2CoSimulation, b->description.guid, "", &none,
                              fmi2False, fmi2False);
}

static void call_instantiate(bench *b, int i)
{
    (void)i;
    b->fmu.FreeInstance(instantiate(b));
}

static void call_step(bench *b, int i)
{
    (void)i;
    must(b->fmu.DoStep(b->c, b->t, 0.001, fmi2True) <= fmi2Warning, "step failed");
    b->t += 0.001;
}

/* Torque of the first path and a load that keeps the balance, roughly. */
static void set_torques(bench *b, double input)
{
    double tau[MOST] = {-input * b->ratio, input};
    b->fmu.SetReal(b->c, b->tau, (size_t)b->n_tau, tau);
}

static void call_cycle(bench *b, int i)
{
    double out[MOST];
    set_torques(b, i % 2 ? 50.0 : 50.1);
    call_step(b, i);
    b->fmu.GetReal(b->c, b->out, (size_t)b->n_out, out);
}

static void call_switching(bench *b, int i)
{
    set_torques(b, i / 10 % 2 ? 50.0 : -50.0);
    call_step(b, i);
}

/* Append the variable's reference to a list, if there is such a variable. */
static void find(const bench *b, const char *name, int *n, unsigned *list)
{
    const fmu_variable *v = gm_fmu_description_find(&b->description, name);
    if (v)
        list[(*n)++] = v->reference;
}

static void find_all(bench *b)
{
    static const char *const flange[] = {"odd", "even", "input"};
    find(b, "output.tau", &b->n_tau, b->tau);
    find(b, "output.w", &b->n_out, b->out);
    find(b, "output.a", &b->n_out, b->out);
    for (int f = 0; f < 3; f++) {
        char name[32];
        snprintf(name, sizeof name, "%s.tau", flange[f]);
        find(b, name, &b->n_tau, b->tau);
        snprintf(name, sizeof name, "%s.w", flange[f]);
        find(b, name, &b->n_out, b->out);
        snprintf(name, sizeof name, "%s.a", flange[f]);
        find(b, name, &b->n_out, b->out);
        snprintf(name, sizeof name, "%s.gear", flange[f]);
        find(b, name, &b->n_gear, b->gear);
    }
    must(b->n_tau >= 2 && b->n_gear >= 1, "not a gearmap component");
}

static void set_real(bench *b, const char *name, double value)
{
    const fmu_variable *v = gm_fmu_description_find(&b->description, name);
    if (v)
        b->fmu.SetReal(b->c, &v->reference, 1, &value);
}

/* First gear, and second on the other path where it is wanted. */
static void initialise(bench *b, double output_speed)
{
    int gear[MOST] = {1, b->other_gear ? 2 : 0};
    b->fmu.Reset(b->c);
    b->fmu.SetInteger(b->c, b->gear, (size_t)b->n_gear, gear);
    set_real(b, "output.w_start", output_speed);
    set_real(b, "even.w_start", b->other_speed);
    const fmu_variable *v = gm_fmu_description_find(&b->description, "fidelity");
    must(v != NULL, "not a gearmap component");
    b->fmu.SetInteger(b->c, &v->reference, 1, &b->fidelity);
    b->fmu.SetupExperiment(b->c, fmi2False, 0, 0, fmi2False, 0);
    b->fmu.EnterInitializationMode(b->c);
    must(b->fmu.ExitInitializationMode(b->c) == fmi2OK, "gears 1 and 2 are needed");
    b->t = 0.0;
}

static void start_batch(bench *b)
{
    double w[MOST];
    initialise(b, 1.0);
    b->fmu.GetReal(b->c, b->out, (size_t)b->n_out, w);
    b->ratio = w[2] / w[0]; /* output.w, output.a, first path's w */
    initialise(b, 300.0 / b->ratio);
    set_torques(b, 50.0);
}

/* Median nanoseconds of one call. */
static double median(bench *b, void (*call)(bench *b, int i))
{
    static double times[BATCHES];
    for (int k = 0; k < BATCHES; k++) {
        if (b->c)
            start_batch(b);
        double from = now();
        for (int i = 0; i < BATCH; i++)
            call(b, i);
        times[k] = (now() - from) / BATCH;
    }
    qsort(times, BATCHES, sizeof *times, compare);
    return times[BATCHES / 2];
}

static double run(bench *b, void (*call)(bench *b, int i), int other_gear,
                  double other_speed)
{
    b->other_gear = other_gear;
    b->other_speed = other_speed;
    b->c = instantiate(b);
    must(b->c != NULL, "cannot be instantiated");
    double time = median(b, call);
    b->fmu.FreeInstance(b->c);
    b->c = NULL;
    return time;
}

static void run_fidelity(bench *b, int fidelity, const char *name)
{
    b->fidelity = fidelity;
    printf(",\n \"%s\": {\"step_ns\": %.1f, ", name, run(b, call_step, 1, 0.0));
    printf("\"free_ns\": %.1f, ", run(b, call_step, 0, 250.0));
    printf("\"resting_ns\": %.1f, ", run(b, call_step, 0, 0.0));
    printf("\"cycle_ns\": %.1f, ", run(b, call_cycle, 1, 0.0));
    printf("\"switching_ns\": %.1f}", run(b, call_switching, 1, 0.0));
}

int main(int argc, char **argv)
{
    bench b = {0};
    char folder[FMU_FOLDER_SIZE], path[FMU_FOLDER_SIZE + 32];
    gm_error error;
    must(argc == 2, "usage: bench_fmu FILE.fmu");
    must(gm_fmu_unpack(argv[1], folder, &error) == GM_OK, "cannot be unpacked");
    snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    int good = gm_fmu_description_read(path, argv[1], &b.description, &error) == GM_OK &&
               gm_fmu_library_load(folder, b.description.identifier, argv[1], &b.fmu,
                                   &error) == GM_OK;
    gm_fmu_remove(folder);
    must(good, error.message);
    find_all(&b);
    printf("{\"instantiate_ns\": %.1f", median(&b, call_instantiate));
    run_fidelity(&b, GM_RIGID, "rigid");
    run_fidelity(&b, GM_LASH, "lash");
    printf("}\n");
    gm_fmu_library_close(&b.fmu);
    gm_fmu_description_clear(&b.description);
    return 0;
}
