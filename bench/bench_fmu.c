/* SPDX-License-Identifier: BSD-2-Clause
 *
 * bench_fmu FILE.fmu: what an importer pays for a baked component, called from C as a
 * simulator does, without a layer in between.
 *
 *   instantiate   fmi2Instantiate + fmi2FreeInstance
 *   step          fmi2DoStep(1 ms) in gear with constant inputs
 *   cycle         set all torques, fmi2DoStep(1 ms), get all speeds and accelerations
 *   switching     fmi2DoStep(1 ms) while torques swing through zero (cells change)
 *
 * Times are medians of batches of 100 calls; output as JSON on one line.
 */
#include "plant/fmu_archive.h"
#include "plant/fmu_description.h"
#include "plant/fmu_library.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BATCH = 100, BATCHES = 2001, MOST = 8 };

typedef struct bench {
    fmu_library fmu;
    fmu_description description;
    fmi2Component c;
    double t;
    int n_tau, n_out, n_gear;
    unsigned tau[MOST], out[MOST], gear[MOST];
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

/* Median nanoseconds of one call. */
static double median(bench *b, void (*call)(bench *b, int i))
{
    static double times[BATCHES];
    for (int k = 0; k < BATCHES; k++) {
        double start = now();
        for (int i = 0; i < BATCH; i++)
            call(b, k * BATCH + i);
        times[k] = (now() - start) / BATCH;
    }
    qsort(times, BATCHES, sizeof *times, compare);
    return times[BATCHES / 2];
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

static void set_torques(bench *b, double input, double output)
{
    double tau[MOST] = {output, input};
    b->fmu.SetReal(b->c, b->tau, (size_t)b->n_tau, tau);
}

static void call_cycle(bench *b, int i)
{
    double out[MOST];
    set_torques(b, 0.0, i % 2 ? 0.1 : -0.1);
    call_step(b, i);
    b->fmu.GetReal(b->c, b->out, (size_t)b->n_out, out);
}

static void call_switching(bench *b, int i)
{
    double swing = i / 50 % 2 ? 30.0 : -30.0;
    set_torques(b, swing, 0.0);
    call_step(b, i);
}

static unsigned find(const bench *b, const char *name, int *n, unsigned *list)
{
    const fmu_variable *v = gm_fmu_description_find(&b->description, name);
    if (v && list)
        list[(*n)++] = v->reference;
    return v ? v->reference : 0;
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

/* In first gear on the first path, the others in neutral, turning, without losses so that
 * the operating point stays where it is. */
static void start(bench *b)
{
    int first = 1, none = 0;
    double speed = 20.0, no_loss = 1e-9;
    unsigned w_start = find(b, "output.w_start", NULL, NULL);
    unsigned scale = find(b, "loss_scale", NULL, NULL);
    b->c = instantiate(b);
    must(b->c != NULL, "cannot be instantiated");
    for (int i = 0; i < b->n_gear; i++)
        b->fmu.SetInteger(b->c, &b->gear[i], 1, i == 0 ? &first : &none);
    b->fmu.SetReal(b->c, &w_start, 1, &speed);
    b->fmu.SetReal(b->c, &scale, 1, &no_loss);
    b->fmu.SetupExperiment(b->c, fmi2False, 0, 0, fmi2False, 0);
    b->fmu.EnterInitializationMode(b->c);
    must(b->fmu.ExitInitializationMode(b->c) == fmi2OK, "cannot be initialised");
    b->t = 0.0;
}

static double run(bench *b, void (*call)(bench *b, int i))
{
    start(b);
    double time = median(b, call);
    b->fmu.FreeInstance(b->c);
    return time;
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
    printf("{\"instantiate_ns\": %.1f, ", median(&b, call_instantiate));
    printf("\"step_ns\": %.1f, ", run(&b, call_step));
    printf("\"cycle_ns\": %.1f, ", run(&b, call_cycle));
    printf("\"switching_ns\": %.1f}\n", run(&b, call_switching));
    gm_fmu_library_close(&b.fmu);
    gm_fmu_description_clear(&b.description);
    return 0;
}
