/* SPDX-License-Identifier: BSD-2-Clause */
#include "reduction.h"

#include "base/alloc.h"
#include "files.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static gm_cycle_settings drive_of(const gm_reduce_settings *a)
{
    return (gm_cycle_settings){.cycle = a->cycle,
                               .vehicle = a->vehicle,
                               .fidelity = GM_CYCLE_BOTH,
                               .tolerance = GM_CYCLE_TOLERANCE,
                               .communication_step = (double)NAN};
}

/* Nothing is begun whose result could not be kept. */
static gm_status check_before(const gm_reduce_settings *a, gm_error *error)
{
    char share[GM_PATH_SIZE];
    gm_status status = gm_file_check_output(a->output, a->description, error);
    if (status == GM_OK && a->map)
        status = gm_file_check_output(a->map, a->description, error);
    if (status == GM_OK && a->map && gm_file_is_same(a->map, a->output))
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be both the map and the component",
                         a->map);
    if (status == GM_OK && a->trace)
        status = gm_file_check_output(a->trace, a->description, error);
    if (status == GM_OK && a->cycle) {
        const gm_cycle_settings drive = drive_of(a);
        status = gm_stage_cycle_check(&drive, error);
    }
    return status == GM_OK ? gm_file_find_share(share, error) : status;
}

/* What was measured, into the component's passport and the map. */
static gm_status keep(const gm_reduce_settings *a, gm_reduction *r,
                      const gm_measured *measured, const char *name, gm_error *error)
{
    const gm_verified verified = {.measured = *measured,
                                  .steady = &r->verify,
                                  .cycle = r->drives ? &r->cycle : NULL};
    char *text = NULL;
    gm_status status = gm_verified_text(&verified, &text, error);
    if (status != GM_OK)
        return status;
    const gm_bake_result result = {"the verification", text};
    status = gm_bake_document(name, r->sweep.map, &r->bake.summary, 1, &result, error);
    if (status == GM_OK && a->map)
        status = gm_stage_keep(&r->verify, r->sweep.map, text, a->map, error);
    gm_free(text);
    if (status == GM_OK) /* the errors are in the archive now */
        r->bake.summary.file_size = gm_file_size(name);
    return status;
}

static gm_status verify(const gm_reduce_settings *a, gm_reduction *r, const char *name,
                        gm_error *error)
{
    gm_fmu *fmu = NULL;
    gm_measured measured;
    gm_status status = gm_fmu_open(name, &fmu, error);
    if (status == GM_OK)
        status = gm_measured_read(fmu, &r->file, &measured, error);
    if (status == GM_OK)
        status = gm_stage_verify(&r->file, fmu, 0, a->points, a->seed, &r->verify, error);
    gm_fmu_close(fmu);
    if (status == GM_OK && a->cycle) {
        const gm_cycle_settings drive = drive_of(a);
        const double start = gm_stage_clock();
        status = gm_stage_cycle(&r->file, name, &drive, &r->cycle, error);
        r->drives = status == GM_OK;
        r->driving = gm_stage_clock() - start;
    }
    if (status == GM_OK && a->trace)
        status = gm_cycle_stage_trace(&r->cycle, a->trace, error);
    return status == GM_OK ? keep(a, r, &measured, name, error) : status;
}

/* `name` is this process's own file; the last of several reductions wins. */
static gm_status bake_and_verify(const gm_reduce_settings *a, gm_reduction *r,
                                 const char *name, gm_error *error)
{
    const gm_results none = {0, NULL};
    gm_status status =
        gm_stage_bake(r->sweep.map, &none, &a->bake, name, &r->bake, error);
    if (status != GM_OK)
        return status;
    status = verify(a, r, name, error);
    if (status == GM_OK && rename(name, a->output) != 0)
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", a->output,
                         strerror(errno));
    if (status != GM_OK)
        (void)unlink(name);
    return status;
}

gm_status gm_reduce(const gm_reduce_settings *a, gm_reduction *r, gm_error *error)
{
    char name[GM_PATH_SIZE];
    gm_sweep_settings settings = a->sweep;
    settings.monotone = gm_stage_is_monotone(a->bake.interpolation);
    memset(r, 0, sizeof *r);
    r->output = a->output;
    r->start = gm_stage_clock();
    gm_status status = check_before(a, error);
    if (status == GM_OK)
        status = gm_file_own_name(a->output, name, error);
    gm_experiment_choice how;
    if (status == GM_OK)
        status = gm_stage_choose(&a->sweep, &how, error);
    if (status == GM_OK)
        status = gm_gearset_file_open_any(a->description, gm_stage_temperature(&a->sweep),
                                          &how, &r->file, error);
    if (status == GM_OK)
        status = gm_stage_sweep(&r->file, &settings, a->map, &r->sweep, error);
    if (status == GM_OK)
        status = bake_and_verify(a, r, name, error);
    r->elapsed = gm_stage_clock() - r->start;
    if (status == GM_OK)
        gm_stage_warn(&r->sweep, &r->verify);
    return status;
}

void gm_reduction_clear(gm_reduction *r)
{
    gm_stage_cycle_clear(&r->cycle);
    gm_stage_verify_clear(&r->verify);
    gm_stage_sweep_clear(&r->sweep);
    gm_gearset_file_close(&r->file);
}
