/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the stages print: text for people in rpm, N·m and %, JSON for machines.
 */
#include "stages.h"

#include "files.h"

#define RPM_PER_RAD_S 9.549296585513721 /* 60 / (2 pi) */
#define KELVIN 273.15

static const char *direction_name(int direction)
{
    return direction > 0 ? "forward" : "backward";
}

/* gm_verify_group_name is for machines. */
const char *gm_stage_group_title(int group)
{
    static const char *const titles[GM_VERIFY_GROUPS] = {
        [GM_VERIFY_SINGLE] = "one path engaged",
        [GM_VERIFY_PRESELECTED] = "with a preselected gear",
        [GM_VERIFY_BOTH_LOADED] = "both paths loaded",
        [GM_VERIFY_DRAG] = "drag of a shaft in neutral",
        [GM_VERIFY_REACTION] = "its reaction on the output",
    };
    return titles[group];
}

/* Taken when printing: a verification adds to the file. */
static long map_size(const gm_sweep_stage *stage)
{
    return stage->path ? gm_file_size(stage->path) : 0;
}

void gm_sweep_stage_json(const gm_sweep_stage *stage, gm_json *json)
{
    gm_json_text(json, "map", stage->path);
    gm_json_text(json, "content_hash", stage->map->content_hash);
    gm_json_integer(json, "points", stage->summary.points);
    gm_json_integer(json, "resumed", stage->summary.resumed);
    gm_json_integer(json, "tables", stage->map->n_tables);
    gm_json_number(json, "largest_ratio_deviation",
                   stage->summary.largest_ratio_deviation);
    gm_json_integer(json, "size_bytes", map_size(stage));
    gm_json_array(json, "oil_temperatures_degC");
    for (int k = 0; k < stage->map->n_oil; k++)
        gm_json_number(json, NULL, stage->map->oil[k] - KELVIN);
    gm_json_end(json);
    gm_json_number(json, "elapsed_s", stage->summary.elapsed);
    gm_json_text(json, "losses", gm_losses_name(stage->how.losses));
    gm_json_text(json, "inertia", gm_inertia_name(stage->how.inertia));
    gm_json_number(json, "uncertainty_Nm", stage->summary.uncertainty);
    gm_json_number(json, "inertia_uncertainty", stage->inertia_uncertainty);
    gm_json_array(json, "skipped");
    for (int i = 0; i < stage->summary.n_skipped; i++)
        gm_json_text(json, NULL, stage->summary.skipped[i].words);
    gm_json_end(json);
    gm_stage_missed_json(stage, json);
}

void gm_bake_stage_json(const gm_bake_stage *stage, const char *fmu, gm_json *json)
{
    gm_json_text(json, "fmu", fmu);
    gm_json_text(json, "guid", stage->summary.guid);
    gm_json_text(json, "compiler", stage->summary.compiler);
    gm_json_integer(json, "size_bytes", stage->summary.file_size);
    gm_json_integer(json, "library_size_bytes", stage->summary.library_size);
    gm_json_number(json, "elapsed_s", stage->elapsed);
}

static void case_gears(const gm_verify_case *c, gm_json *json)
{
    /* the gear of the path that is named; both gears where both paths take part */
    int single = c->gear[0] == 0 || c->gear[1] == 0;
    if (single) {
        gm_json_integer(json, "gear", c->gear[0] != 0 ? c->gear[0] : c->gear[1]);
        return;
    }
    gm_json_array(json, "gear");
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        gm_json_integer(json, NULL, c->gear[p]);
    gm_json_end(json);
}

/* axis: 1 with an oil axis */
static void case_json(const gm_verify_case *c, int axis, gm_json *json)
{
    double scale = c->largest_loss > 0.0 ? 1.0 / c->largest_loss : 0.0;
    gm_json_object(json, NULL);
    gm_json_text(json, "path", c->path);
    case_gears(c, json);
    gm_json_text(json, "direction", direction_name(c->direction));
    gm_json_integer(json, "points", c->points);
    gm_json_number(json, "largest_loss_Nm", c->largest_loss);
    gm_json_number(json, "max_Nm", c->max);
    gm_json_number(json, "rms_Nm", c->rms);
    gm_json_number(json, "max_relative", c->max * scale);
    gm_json_number(json, "rms_relative", c->rms * scale);
    gm_json_object(json, "worst");
    gm_json_number(json, "speed_rpm", c->worst_speed * RPM_PER_RAD_S);
    gm_json_number(json, "torque_Nm", c->worst_torque);
    if (axis)
        gm_json_number(json, "oil_degC", c->worst_oil - KELVIN);
    gm_json_end(json);
    gm_json_end(json);
}

/* Errors of a group in an interval of the oil axis. */
typedef struct interval_errors {
    double low, high; /* K */
    int points;
    double max, rms; /* relative */
} interval_errors;

static interval_errors errors_between(const gm_verify_stage *stage, int group, int k)
{
    interval_errors e = {.low = stage->oil[k], .high = stage->oil[k + 1]};
    gm_verify_between(&stage->result, (gm_verify_group)group, e.low, e.high, &e.points,
                      &e.max, &e.rms);
    return e;
}

static void intervals_json(const gm_verify_stage *stage, int group, gm_json *json)
{
    if (stage->n_oil == 0)
        return;
    gm_json_array(json, "by_oil_temperature");
    for (int k = 0; k + 1 < stage->n_oil; k++) {
        const interval_errors e = errors_between(stage, group, k);
        gm_json_object(json, NULL);
        gm_json_number(json, "from_degC", e.low - KELVIN);
        gm_json_number(json, "to_degC", e.high - KELVIN);
        gm_json_integer(json, "points", e.points);
        gm_json_number(json, "max_relative", e.max);
        gm_json_number(json, "rms_relative", e.rms);
        gm_json_end(json);
    }
    gm_json_end(json);
}

/* max_relative, rms_relative and cases of one group */
static void group_json(const gm_verify_stage *stage, int group, gm_json *json)
{
    const gm_verify_result *r = &stage->result;
    gm_json_number(json, "max_relative", r->max_relative[group]);
    gm_json_number(json, "rms_relative", r->rms_relative[group]);
    gm_json_array(json, "cases");
    for (int i = 0; i < r->n_cases[group]; i++)
        case_json(&r->cases[group][i], stage->n_oil > 0, json);
    gm_json_end(json);
    intervals_json(stage, group, json);
}

void gm_verify_stage_json(const gm_verify_stage *stage, gm_json *json)
{
    const gm_verify_result *r = &stage->result;
    gm_json_integer(json, "points", r->points);
    gm_json_integer(json, "seed", (long long)r->seed);
    gm_json_integer(json, "skipped", r->n_skipped);
    group_json(stage, GM_VERIFY_SINGLE, json);
    gm_json_object(json, "groups");
    for (int group = GM_VERIFY_SINGLE + 1; group < GM_VERIFY_GROUPS; group++) {
        if (r->n_cases[group] == 0)
            continue;
        gm_json_object(json, gm_verify_group_name((gm_verify_group)group));
        group_json(stage, group, json);
        gm_json_end(json);
    }
    gm_json_end(json);
    gm_json_number(json, "elapsed_s", stage->elapsed);
}

/* Of a simulated gearset: how it was measured, and how far that may be off. */
static void print_experiments(const gm_sweep_stage *stage, FILE *out)
{
    const gm_experiment_choice *how = &stage->how;
    if (how->losses == GM_LOSSES_STEADY && how->inertia == GM_INERTIA_MATRIX)
        return;
    fprintf(out, "                    losses by %s", gm_losses_name(how->losses));
    if (how->losses != GM_LOSSES_STEADY)
        fprintf(out, ", within %.2g N·m", stage->summary.uncertainty);
    fprintf(out, "; inertia by %s", gm_inertia_name(how->inertia));
    if (how->inertia == GM_INERTIA_RAMPS)
        fprintf(out, ", within %.2g %%", 100.0 * stage->inertia_uncertainty);
    fputc('\n', out);
}

void gm_sweep_stage_print(const gm_sweep_stage *stage, FILE *out)
{
    const gm_sweep_summary *s = &stage->summary;
    fprintf(out, "sweep   %8.2f s  %ld steady points", s->elapsed,
            s->points + s->resumed);
    if (s->resumed > 0)
        fprintf(out, " (%ld of them resumed)", s->resumed);
    fprintf(out, " in %d tables\n", stage->map->n_tables);
    print_experiments(stage, out);
    if (stage->path)
        fprintf(out, "                    %s, %ld kB, content hash %.16s\n", stage->path,
                map_size(stage) / 1024, stage->map->content_hash);
    if (stage->map->n_oil > 0)
        fprintf(out, "                    oil at");
    for (int k = 0; k < stage->map->n_oil; k++)
        fprintf(out, "%s %.4g", k > 0 ? "," : "", stage->map->oil[k] - KELVIN);
    if (stage->map->n_oil > 0)
        fprintf(out, " °C\n");
}

void gm_bake_stage_print(const gm_bake_stage *stage, const char *fmu, FILE *out)
{
    fprintf(out, "bake    %8.2f s  %s, %ld kB, binary %ld kB\n", stage->elapsed, fmu,
            stage->summary.file_size / 1024, stage->summary.library_size / 1024);
}

/* Each interval with the largest values there. */
static void print_intervals(const gm_verify_stage *stage, FILE *out)
{
    if (stage->n_oil == 0)
        return;
    fprintf(out, "\n    %-34s", "by oil temperature, max");
    for (int k = 0; k + 1 < stage->n_oil; k++)
        fprintf(out, " %4.0f .. %3.0f °C", stage->oil[k] - KELVIN,
                stage->oil[k + 1] - KELVIN);
    fputc('\n', out);
    for (int group = 0; group < GM_VERIFY_GROUPS; group++) {
        if (stage->result.n_cases[group] == 0)
            continue;
        fprintf(out, "    %-34s", gm_stage_group_title(group));
        for (int k = 0; k + 1 < stage->n_oil; k++)
            fprintf(out, " %12.3f %%", 100.0 * errors_between(stage, group, k).max);
        fputc('\n', out);
    }
}

void gm_verify_stage_print_groups(const gm_verify_stage *stage, FILE *out)
{
    const gm_verify_result *r = &stage->result;
    fprintf(out,
            "verify  %8.2f s  error against the detailed model at %d random points\n",
            stage->elapsed, r->points);
    fprintf(out,
            "                    off the grid, of the largest value of each case:\n\n");
    fprintf(out, "    %-34s %9s %9s\n", "", "max", "RMS");
    for (int group = 0; group < GM_VERIFY_GROUPS; group++)
        if (r->n_cases[group] > 0)
            fprintf(out, "    %-34s %7.3f %% %7.3f %%\n", gm_stage_group_title(group),
                    100.0 * r->max_relative[group], 100.0 * r->rms_relative[group]);
    print_intervals(stage, out);
}

static void print_case(const gm_verify_case *c, FILE *out)
{
    char gear[32];
    int both = c->gear[0] != 0 && c->gear[1] != 0;
    if (both)
        (void)snprintf(gear, sizeof gear, "%d, %d", c->gear[0], c->gear[1]);
    else
        (void)snprintf(gear, sizeof gear, "%d",
                       c->gear[0] != 0 ? c->gear[0] : c->gear[1]);
    double scale = c->largest_loss > 0.0 ? 100.0 / c->largest_loss : 0.0;
    fprintf(out, "    %-6s %-6s %-9s %10.3f %9.3f %% %7.3f %% %9.0f %8.1f\n", c->path,
            gear, direction_name(c->direction), c->largest_loss, c->max * scale,
            c->rms * scale, c->worst_speed * RPM_PER_RAD_S, c->worst_torque);
}

void gm_verify_stage_print(const gm_verify_stage *stage, FILE *out)
{
    const gm_verify_result *r = &stage->result;
    gm_verify_stage_print_groups(stage, out);
    for (int group = 0; group < GM_VERIFY_GROUPS; group++) {
        if (r->n_cases[group] == 0)
            continue;
        fprintf(out, "\n%s\n", gm_stage_group_title(group));
        fprintf(out, "    %-6s %-6s %-9s %10s %11s %9s %18s\n", "path", "gear",
                "rotation", "largest", "max", "RMS", "worst at");
        fprintf(out, "    %-6s %-6s %-9s %10s %11s %9s %9s %8s\n", "", "", "", "[N·m]",
                "", "", "[rpm]", "[N·m]");
        for (int i = 0; i < r->n_cases[group]; i++)
            print_case(&r->cases[group][i], out);
    }
}
