/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/accuracy.h"

#include "bake/page.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- cells ---- */

/* A cell with a number of so many digits; empty where it was not measured. */
static void cell(gm_buffer *page, double value, int digits, const char *unit)
{
    gm_buffer_text(page, "<td class=\"n\">");
    if (isfinite(value))
        gm_page_number(page, "", value, digits, unit);
    gm_buffer_text(page, "</td>");
}

static void text_cell(gm_buffer *page, const char *text)
{
    gm_buffer_text(page, "<td>");
    gm_page_escaped(page, text);
    gm_buffer_text(page, "</td>");
}

static double number(const json_t *object, const char *key)
{
    return gm_member_number(object, key);
}

/* ---- steady ---- */

static double count_points(const json_t *group)
{
    double n = 0.0;
    const json_t *cases = json_object_get(group, "cases");
    for (size_t i = 0; i < json_array_size(cases); i++)
        n += number(json_array_get(cases, i), "points");
    return n;
}

static void group_row(gm_buffer *page, const json_t *group, const char *words)
{
    if (!group)
        return;
    gm_buffer_text(page, "<tr><td>%s</td>", words);
    cell(page, count_points(group), 9, "");
    cell(page, 100 * number(group, "max_relative"), 3, " %");
    cell(page, 100 * number(group, "rms_relative"), 3, " %");
    gm_buffer_text(page, "</tr>\n");
}

static void groups(gm_buffer *page, const json_t *steady)
{
    static const char *const kinds[][2] = {
        {"preselected", "loss, with a preselected gear"},
        {"both_loaded", "loss, both paths loaded"},
        {"drag", "drag of a shaft in neutral"},
        {"reaction", "its reaction on the output"},
    };
    gm_page_table(page, "quantity|>points|>largest error|>RMS");
    group_row(page, steady, "loss, one path engaged");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        group_row(page, json_object_get(json_object_get(steady, "groups"), kinds[i][0]),
                  kinds[i][1]);
    gm_page_table_end(page);
}

static void gear_row(gm_buffer *page, const json_t *c)
{
    const json_t *worst = json_object_get(c, "worst");
    gm_buffer_text(page, "<tr>");
    text_cell(page, gm_member_text(c, "path"));
    cell(page, number(c, "gear"), 9, "");
    text_cell(page, gm_member_text(c, "direction"));
    cell(page, number(c, "largest_loss_Nm"), 4, " N·m");
    cell(page, 100 * number(c, "max_relative"), 3, " %");
    cell(page, 100 * number(c, "rms_relative"), 3, " %");
    cell(page, number(worst, "speed_rpm"), 4, " rpm");
    cell(page, number(worst, "torque_Nm"), 4, " N·m");
    gm_buffer_text(page, "</tr>\n");
}

static void steady_errors(gm_buffer *page, const json_t *steady)
{
    gm_buffer_text(page,
                   "<p>This FMU against the detailed model at random points off the "
                   "grid of the tables, relative to the largest value of each gear "
                   "and direction of rotation:</p>\n");
    groups(page, steady);
    gm_buffer_text(page, "<p>The first line by gear: the largest loss torque at the "
                         "input, errors relative to it, and the speed and torque of the "
                         "input where the error is largest.</p>\n");
    gm_page_table(
        page,
        "path|>gear|rotation|>largest loss|>largest error|>RMS|>at speed|>and torque");
    const json_t *cases = json_object_get(steady, "cases");
    for (size_t i = 0; i < json_array_size(cases); i++)
        gear_row(page, json_array_get(cases, i));
    gm_page_table_end(page);
}

/* ---- cycles ---- */

/* "rigid", or "rigid (CS, 1 ms)" in Co-Simulation. */
static void run_name(const json_t *run, char *name, size_t size)
{
    char step[GM_NUMBER_TEXT];
    const double h = number(run, "communication_step_s");
    const char *fidelity = gm_member_text(run, "fidelity");
    if (isfinite(h))
        (void)snprintf(name, size, "%.16s (CS, %s ms)", fidelity,
                       gm_number_text(1e3 * h, 4, step));
    else
        (void)snprintf(name, size, "%.16s", fidelity);
}

/* Column heads end where the text of a table's heads may. */
static void heads(gm_buffer *page, const char *first, const json_t *cycle)
{
    char text[512], name[80];
    (void)snprintf(text, sizeof text, "%s", first);
    const json_t *run;
    for (size_t i = 0; (run = gm_passport_run(cycle, i)) != NULL; i++) {
        run_name(run, name, sizeof name);
        if (strcspn(name, "<>&|") == strlen(name) &&
            strlen(text) + strlen(name) + 2 < sizeof text)
            (void)snprintf(text + strlen(text), sizeof text - strlen(text), "|>%s", name);
    }
    gm_page_table(page, text);
}

/* Where a line of the table finds its numbers: a member of the drive or its figures,
 * inside another one or not. */
typedef struct line {
    const char *words, *inside, *key;
    double scale;
    const char *unit;
} line;

static const line drive_lines[] = {
    {"processor time", NULL, "cpu_s", 1.0, " s"},
    {"faster than real time", NULL, "real_time_factor", 1.0, " times"},
    {"energy account left open, of what passes", NULL, "energy_balance_relative", 1.0,
     ""},
};
static const line figure_lines[] = {
    {"processor time saved", NULL, "cpu_saved", 100.0, " %"},
    {"engine speed, RMS of the difference", "errors", "engine_speed_rms_rad_s", 1.0,
     " rad/s"},
    {"vehicle speed, RMS", "errors", "vehicle_speed_rms_km_h", 1.0, " km/h"},
    {"output torque below 5 Hz, RMS, relative", "errors",
     "output_torque_5Hz_rms_relative", 100.0, " %"},
    {"input torque below 5 Hz, RMS, relative", "errors", "input_torque_5Hz_rms_relative",
     100.0, " %"},
    {"energy lost in the gearset", "errors", "loss_energy_relative", 100.0, " %"},
};

static void line_cell(gm_buffer *page, const line *l, const json_t *object)
{
    cell(page,
         l->scale *
             number(l->inside ? json_object_get(object, l->inside) : object, l->key),
         4, l->unit);
}

static void drive_line(gm_buffer *page, const line *l, const json_t *cycle)
{
    gm_buffer_text(page, "<tr><td>%s</td>", l->words);
    line_cell(page, l, json_object_get(cycle, "detailed"));
    const json_t *run;
    for (size_t i = 0; (run = gm_passport_run(cycle, i)) != NULL; i++)
        line_cell(page, l, run);
    gm_buffer_text(page, "</tr>\n");
}

static void figure_line(gm_buffer *page, const line *l, const json_t *cycle)
{
    gm_buffer_text(page, "<tr><td>%s</td><td></td>", l->words);
    const json_t *run;
    for (size_t i = 0; (run = gm_passport_run(cycle, i)) != NULL; i++)
        line_cell(page, l, gm_passport_figures(cycle, run));
    gm_buffer_text(page, "</tr>\n");
}

static void cycle_table(gm_buffer *page, const json_t *cycle)
{
    heads(page, "what|>detailed", cycle);
    for (size_t i = 0; i < sizeof drive_lines / sizeof *drive_lines; i++)
        drive_line(page, &drive_lines[i], cycle);
    for (size_t i = 0; i < sizeof figure_lines / sizeof *figure_lines; i++)
        figure_line(page, &figure_lines[i], cycle);
    gm_page_table_end(page);
}

/* Row i of an array of the drive's figures; NULL where it ends. */
static const json_t *row_of(const json_t *cycle, const json_t *run, const char *array,
                            size_t i)
{
    const json_t *rows = json_object_get(gm_passport_figures(cycle, run), array);
    return json_array_get(rows, i);
}

/* All drives have the same gears in the same order: they follow one plan. */
static void gear_losses(gm_buffer *page, const json_t *cycle)
{
    const json_t *first = gm_passport_run(cycle, 0), *gear, *run;
    if (!row_of(cycle, first, "loss_by_gear", 0))
        return;
    gm_buffer_text(page, "<p>Energy lost while the wheels are driven in a gear:</p>\n");
    heads(page, "gear|>time|>detailed", cycle);
    for (size_t i = 0; (gear = row_of(cycle, first, "loss_by_gear", i)) != NULL; i++) {
        gm_buffer_text(page, "<tr>");
        cell(page, number(gear, "gear"), 9, "");
        cell(page, number(gear, "time_s"), 4, " s");
        cell(page, number(gear, "detailed_J"), 5, " J");
        for (size_t k = 0; (run = gm_passport_run(cycle, k)) != NULL; k++)
            cell(page, number(row_of(cycle, run, "loss_by_gear", i), "reduced_J"), 5,
                 " J");
        gm_buffer_text(page, "</tr>\n");
    }
    gm_page_table_end(page);
}

static void worst_of(gm_buffer *page, const json_t *cycle, const json_t *run)
{
    char name[80];
    const json_t *place;
    run_name(run, name, sizeof name);
    for (size_t i = 0; (place = row_of(cycle, run, "worst", i)) != NULL; i++) {
        gm_buffer_text(page, "<tr>");
        text_cell(page, i == 0 ? name : "");
        cell(page, number(place, "output_torque_5Hz_Nm"), 3, " N·m");
        cell(page, number(place, "time_s"), 4, " s");
        text_cell(page, gm_member_text(place, "cause"));
        gm_buffer_text(page, "</tr>\n");
    }
}

static void worst_places(gm_buffer *page, const json_t *cycle)
{
    const json_t *run;
    gm_buffer_text(page, "<p>The largest differences of output torque below 5 Hz, and "
                         "what happens there:</p>\n");
    gm_page_table(page, "component|>difference|>at|what happens");
    for (size_t i = 0; (run = gm_passport_run(cycle, i)) != NULL; i++)
        worst_of(page, cycle, run);
    gm_page_table_end(page);
}

static void cycle_errors(gm_buffer *page, const json_t *cycle)
{
    gm_buffer_text(page, "<h3>In a car over the cycle ");
    gm_page_escaped(page, gm_member_text(cycle, "cycle"));
    gm_buffer_text(page, "</h3>\n<p>One vehicle, driven twice: with the detailed gearset "
                         "and with this FMU. ");
    gm_page_number(page, "The cycle has ", number(cycle, "duration_s"), 5,
                   " s. Processor times are of the machine it was measured on.</p>\n");
    cycle_table(page, cycle);
    gear_losses(page, cycle);
    worst_places(page, cycle);
}

void gm_accuracy_write(const gm_passport *passport, gm_buffer *page)
{
    const json_t *steady = gm_passport_steady(passport);
    gm_page_heading(page, "Measured accuracy");
    if (passport->n == 0) {
        gm_buffer_text(page, "<p>Not measured when this file was made.</p>\n");
        return;
    }
    gm_buffer_text(page,
                   "<p>For programs, with hashes of model, map and FMU, the same is in "
                   "<code>extra/gearmap/passport.json</code>.</p>\n");
    if (steady)
        steady_errors(page, steady);
    for (int i = 0; i < passport->n; i++)
        if (gm_passport_cycle(passport, i))
            cycle_errors(page, gm_passport_cycle(passport, i));
}
