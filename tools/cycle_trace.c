/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The drives of a comparison over time, one row a sample: the cycle, then the same
 * columns for the detailed gearset and for each run of the component ("rigid", "lash"; in
 * Co-Simulation "rigid_cs", "lash_cs").
 */
#include "cycle_stage.h"

#include "files.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define RPM 9.549296585513721 /* per rad/s */
#define KM_H 3.6              /* per m/s */

static void print_names(const gm_cycle_stage *stage, const char *run, FILE *out)
{
    fprintf(out, ",%s.vehicle_speed_km_h,%s.engine_speed_rpm,%s.engine_torque_Nm", run,
            run, run);
    for (int p = 0; p < stage->n_paths; p++)
        fprintf(out, ",%s.%s.speed_rpm,%s.%s.tau_Nm,%s.%s.gear,%s.%s.state", run,
                stage->path_name[p], run, stage->path_name[p], run, stage->path_name[p],
                run, stage->path_name[p]);
    fprintf(out, ",%s.output.speed_rpm,%s.output.tau_Nm,%s.loss_energy_J,%s.cpu_s", run,
            run, run, run);
}

static void print_run_names(const gm_cycle_stage *stage, const gm_cycle_run *run,
                            FILE *out)
{
    char name[GM_RUN_NAME];
    (void)snprintf(name, sizeof name, "%s%s", gm_fidelity_name(run->fidelity),
                   isnan(run->communication_step) ? "" : "_cs");
    print_names(stage, name, out);
}

static void print_values(const gm_cycle_stage *stage, const gm_record *r, int i,
                         FILE *out)
{
    const gm_trip_view *v = &r->sample[i].view;
    fprintf(out, ",%.9g,%.9g,%.9g", KM_H * v->speed, RPM * v->engine_speed,
            v->engine_torque);
    for (int p = 0; p < stage->n_paths; p++)
        fprintf(out, ",%.9g,%.9g,%d,%d", RPM * v->input_speed[p], v->input_torque[p],
                v->gear[p], v->state[p]);
    fprintf(out, ",%.9g,%.9g,%.9g,%.6g", RPM * v->output_speed, v->output_torque,
            gm_record_loss(r, i), r->sample[i].cpu);
}

static void print_rows(const gm_cycle_stage *stage, FILE *out)
{
    fprintf(out, "time_s,cycle_speed_km_h");
    print_names(stage, "detailed", out);
    for (int k = 0; k < stage->n_runs; k++)
        print_run_names(stage, &stage->run[k], out);
    fputc('\n', out);
    for (int i = 0; i < stage->detailed->n; i++) {
        const gm_sample *sample = &stage->detailed->sample[i];
        fprintf(out, "%.9g,%.9g", i * stage->detailed->step,
                KM_H * sample->view.cycle_speed);
        print_values(stage, stage->detailed, i, out);
        for (int k = 0; k < stage->n_runs; k++)
            print_values(stage, stage->run[k].record, i, out);
        fputc('\n', out);
    }
}

gm_status gm_cycle_stage_trace(const gm_cycle_stage *stage, const char *path,
                               gm_error *error)
{
    char own[GM_PATH_SIZE];
    gm_status status = gm_file_own_name(path, own, error);
    if (status != GM_OK)
        return status;
    FILE *out = fopen(own, "w");
    if (!out)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", path,
                       strerror(errno));
    print_rows(stage, out);
    int failed = ferror(out);
    failed |= fclose(out);
    if (failed || rename(own, path) != 0) {
        status =
            gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
        (void)remove(own);
    }
    return status;
}
