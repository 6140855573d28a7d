/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the comparison over a cycle prints.
 */
#include "cycle_stage.h"

#include <math.h>
#include <string.h>

#define KM_H 3.6 /* per m/s */
#define GAP "    "

static double real_time_factor(const gm_cycle_stage *stage, const gm_record *r)
{
    return gm_cycle_duration(stage->cycle) / r->work.cpu;
}

static double balance(const gm_record *r)
{
    return r->energy.through > 0.0 ? fabs(r->energy.residual) / r->energy.through : 0.0;
}

/* The path whose torque differs most, relative to its own size. */
static double input_difference(const gm_cycle_stage *stage, const gm_comparison *c)
{
    double worst = 0.0;
    for (int p = 0; p < stage->n_paths; p++)
        worst = fmax(worst, c->input_torque[p].relative);
    return worst;
}

/* ---- JSON ---- */

static void record_json(const gm_cycle_stage *stage, const gm_record *r,
                        double gearset_time, gm_json *json)
{
    gm_json_number(json, "cpu_s", r->work.cpu);
    gm_json_number(json, "real_time_factor", real_time_factor(stage, r));
    gm_json_integer(json, "steps", r->work.steps);
    gm_json_integer(json, "restarts", r->work.restarts);
    gm_json_number(json, "gearset_s", gearset_time);
    gm_json_number(json, "energy_balance_relative", balance(r));
}

static void difference_json(const char *key, const gm_difference *d, double unit,
                            gm_json *json)
{
    gm_json_object(json, key);
    gm_json_number(json, "rms", d->rms * unit);
    gm_json_number(json, "max", d->largest * unit);
    gm_json_number(json, "max_at_s", d->at);
    gm_json_number(json, "rms_relative", d->relative);
    gm_json_end(json);
}

static void errors_json(const gm_cycle_stage *stage, const gm_comparison *c,
                        gm_json *json)
{
    gm_json_object(json, "errors");
    gm_json_number(json, "engine_speed_rms_rad_s", c->engine_speed.rms);
    gm_json_number(json, "vehicle_speed_rms_km_h", c->vehicle_speed.rms * KM_H);
    gm_json_number(json, "output_torque_5Hz_rms_relative", c->output_torque.relative);
    gm_json_number(json, "input_torque_5Hz_rms_relative", input_difference(stage, c));
    gm_json_number(json, "loss_energy_relative", c->loss_relative);
    gm_json_end(json);
    gm_json_object(json, "differences");
    difference_json("engine_speed_rad_s", &c->engine_speed, 1.0, json);
    difference_json("engine_torque_Nm", &c->engine_torque, 1.0, json);
    difference_json("vehicle_speed_km_h", &c->vehicle_speed, KM_H, json);
    difference_json("output_torque_5Hz_Nm", &c->output_torque, 1.0, json);
    for (int p = 0; p < stage->n_paths; p++) {
        char key[64];
        (void)snprintf(key, sizeof key, "%s_torque_5Hz_Nm", stage->path_name[p]);
        difference_json(key, &c->input_torque[p], 1.0, json);
    }
    gm_json_end(json);
}

static void gears_json(const gm_comparison *c, gm_json *json)
{
    gm_json_array(json, "loss_by_gear");
    for (int i = 0; i < c->n_gears; i++) {
        gm_json_object(json, NULL);
        gm_json_integer(json, "gear", c->gear[i].gear);
        gm_json_number(json, "time_s", c->gear[i].time);
        gm_json_number(json, "detailed_J", c->gear[i].detailed);
        gm_json_number(json, "reduced_J", c->gear[i].reduced);
        gm_json_end(json);
    }
    gm_json_end(json);
}

static void shifts_json(const gm_comparison *c, gm_json *json)
{
    gm_json_array(json, "shifts");
    for (int i = 0; i < c->n_shifts; i++) {
        const gm_shift *s = &c->shift[i];
        gm_json_object(json, NULL);
        gm_json_number(json, "time_s", s->time);
        gm_json_integer(json, "from", s->from);
        gm_json_integer(json, "to", s->to);
        gm_json_number(json, "engaged_detailed_s", s->engaged_detailed);
        gm_json_number(json, "engaged_reduced_s", s->engaged_reduced);
        gm_json_number(json, "output_torque_5Hz_rms_Nm", s->rms);
        gm_json_end(json);
    }
    gm_json_end(json);
}

static void worst_json(const gm_comparison *c, gm_json *json)
{
    gm_json_array(json, "worst");
    for (int i = 0; i < c->n_worst; i++) {
        gm_json_object(json, NULL);
        gm_json_number(json, "time_s", c->worst[i].time);
        gm_json_number(json, "output_torque_5Hz_Nm", c->worst[i].difference);
        gm_json_text(json, "cause", gm_cause_name(c->worst[i].cause));
        gm_json_end(json);
    }
    gm_json_end(json);
}

static void reduced_json(const gm_cycle_stage *stage, const gm_cycle_run *run,
                         gm_json *json)
{
    gm_json_text(json, "fidelity", gm_fidelity_name(run->fidelity));
    gm_json_number(json, "communication_step_s", run->communication_step);
    gm_json_number(json, "recommended_step_s", run->recommended_step);
    /* in Co-Simulation it is spent in the steps, which are not timed apart */
    record_json(stage, run->record,
                isnan(run->communication_step) ? run->record->gearset_time : (double)NAN,
                json);
}

static void figures_json(const gm_cycle_stage *stage, const gm_cycle_run *run,
                         gm_json *json)
{
    gm_json_number(json, "cpu_saved", run->comparison.cpu_saved);
    errors_json(stage, &run->comparison, json);
    gears_json(&run->comparison, json);
    shifts_json(&run->comparison, json);
    worst_json(&run->comparison, json);
}

/* The larger one of both drives. */
static double worst_balance(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    return fmax(balance(stage->detailed), balance(run->record));
}

static void one_json(const gm_cycle_stage *stage, const gm_cycle_run *run, gm_json *json)
{
    gm_json_object(json, "reduced");
    reduced_json(stage, run, json);
    gm_json_end(json);
    figures_json(stage, run, json);
    gm_json_number(json, "energy_balance_relative", worst_balance(stage, run));
}

/* Several fidelities: an array, each with its own figures. */
static void all_json(const gm_cycle_stage *stage, gm_json *json)
{
    gm_json_array(json, "reduced");
    for (int i = 0; i < stage->n_runs; i++) {
        gm_json_object(json, NULL);
        reduced_json(stage, &stage->run[i], json);
        figures_json(stage, &stage->run[i], json);
        gm_json_end(json);
    }
    gm_json_end(json);
}

void gm_cycle_stage_json(const gm_cycle_stage *stage, gm_json *json)
{
    gm_json_text(json, "cycle", stage->cycle->name);
    gm_json_number(json, "duration_s", gm_cycle_duration(stage->cycle));
    gm_json_number(json, "distance_m", gm_cycle_distance(stage->cycle));
    gm_json_text(json, "vehicle_sha256",
                 *stage->vehicle_sha256 ? stage->vehicle_sha256 : NULL);
    gm_json_number(json, "tolerance", stage->tolerance);
    gm_json_object(json, "detailed");
    record_json(stage, stage->detailed, stage->detailed->gearset_time, json);
    gm_json_end(json);
    if (stage->n_runs == 1)
        one_json(stage, &stage->run[0], json);
    else
        all_json(stage, json);
}

/* ---- text ---- */

typedef double (*figure)(const gm_cycle_stage *stage, const gm_cycle_run *run);

static double saved(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    (void)stage;
    return 100.0 * run->comparison.cpu_saved;
}

static double speed_of_engine(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    (void)stage;
    return run->comparison.engine_speed.rms;
}

static double speed_of_vehicle(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    (void)stage;
    return KM_H * run->comparison.vehicle_speed.rms;
}

static double torque_of_output(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    (void)stage;
    return 100.0 * run->comparison.output_torque.relative;
}

static double torque_of_inputs(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    return 100.0 * input_difference(stage, &run->comparison);
}

static double energy_lost(const gm_cycle_stage *stage, const gm_cycle_run *run)
{
    (void)stage;
    return 100.0 * run->comparison.loss_relative;
}

/* Of a run's column. */
static int width_of(const gm_cycle_run *run)
{
    char name[GM_RUN_NAME];
    gm_cycle_run_name(run, name);
    const int length = (int)strlen(name);
    return length < 12 ? 12 : length + 1;
}

static void print_heading(const gm_cycle_run *run, FILE *out)
{
    char name[GM_RUN_NAME];
    gm_cycle_run_name(run, name);
    fprintf(out, " %*s", width_of(run), name);
}

static void print_title(const gm_cycle_run *run, FILE *out)
{
    char name[GM_RUN_NAME];
    gm_cycle_run_name(run, name);
    fprintf(out, "\n%s\n", name);
}

static void line(const gm_cycle_stage *stage, const char *what, const char *unit,
                 figure of, FILE *out)
{
    fprintf(out, GAP "%-38s %-6s %12s", what, unit, "");
    for (int i = 0; i < stage->n_runs; i++)
        fprintf(out, " %*.4g", width_of(&stage->run[i]), of(stage, &stage->run[i]));
    fputc('\n', out);
}

static void print_speed(const gm_cycle_stage *stage, FILE *out)
{
    fprintf(out, GAP "%-38s %-6s %12.4g", "processor time", "s",
            stage->detailed->work.cpu);
    for (int i = 0; i < stage->n_runs; i++)
        fprintf(out, " %*.4g", width_of(&stage->run[i]), stage->run[i].record->work.cpu);
    fprintf(out, "\n" GAP "%-38s %-6s %12.4g", "faster than real time", "times",
            real_time_factor(stage, stage->detailed));
    for (int i = 0; i < stage->n_runs; i++)
        fprintf(out, " %*.4g", width_of(&stage->run[i]),
                real_time_factor(stage, stage->run[i].record));
    fputc('\n', out);
}

void gm_cycle_stage_print_table(const gm_cycle_stage *stage, FILE *out)
{
    fprintf(out, "cycle   %s, %.0f s: one vehicle, detailed and reduced gearset\n\n",
            stage->cycle->name, gm_cycle_duration(stage->cycle));
    fprintf(out, GAP "%-45s %12s", "", "detailed");
    for (int i = 0; i < stage->n_runs; i++)
        print_heading(&stage->run[i], out);
    fputc('\n', out);
    print_speed(stage, out);
    line(stage, "processor time saved", "%", saved, out);
    line(stage, "engine speed, RMS of the difference", "rad/s", speed_of_engine, out);
    line(stage, "vehicle speed, RMS", "km/h", speed_of_vehicle, out);
    line(stage, "output torque below 5 Hz, RMS", "%", torque_of_output, out);
    line(stage, "input torque below 5 Hz, RMS", "%", torque_of_inputs, out);
    line(stage, "energy lost in the gearset", "%", energy_lost, out);
}

static void print_gears(const gm_cycle_run *run, FILE *out)
{
    const gm_comparison *c = &run->comparison;
    fprintf(out, "\n" GAP "%-8s %8s %16s %14s %12s\n", "gear", "time", "loss, detailed",
            "reduced", "difference");
    for (int i = 0; i < c->n_gears; i++) {
        const gm_gear_loss *g = &c->gear[i];
        fprintf(out, GAP "%-8d %6.1f s %14.1f J %12.1f J %10.2f %%\n", g->gear, g->time,
                g->detailed, g->reduced,
                g->detailed != 0.0 ? 100.0 * (g->reduced / g->detailed - 1.0) : 0.0);
    }
}

/* How much later the reduced gearset locks the new gear. */
static double later(const gm_shift *s)
{
    return s->engaged_reduced - s->engaged_detailed;
}

static void print_shifts(const gm_comparison *c, FILE *out)
{
    if (c->n_shifts == 0)
        return;
    fprintf(out, "\n" GAP "%-10s %10s %18s %26s\n", "shift", "at", "locked later by",
            "output torque below 5 Hz");
    for (int i = 0; i < c->n_shifts; i++)
        fprintf(out, GAP "%d to %-5d %8.1f s %15.3f s %22.3g N·m\n", c->shift[i].from,
                c->shift[i].to, c->shift[i].time, later(&c->shift[i]), c->shift[i].rms);
}

static void print_worst(const gm_comparison *c, FILE *out)
{
    fprintf(out, "\n" GAP "largest differences of output torque below 5 Hz\n");
    for (int i = 0; i < c->n_worst; i++)
        fprintf(out, GAP "%8.1f s %12.3g N·m  %s\n", c->worst[i].time,
                c->worst[i].difference, gm_cause_name(c->worst[i].cause));
}

void gm_cycle_stage_print(const gm_cycle_stage *stage, FILE *out)
{
    gm_cycle_stage_print_table(stage, out);
    for (int i = 0; i < stage->n_runs; i++) {
        print_title(&stage->run[i], out);
        print_gears(&stage->run[i], out);
        print_shifts(&stage->run[i].comparison, out);
        print_worst(&stage->run[i].comparison, out);
    }
}
