/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A guess as the text of a rig file. Comments that begin "guessed" want to be looked at,
 * fields that are TODO to be filled in: reading the file refuses them by name.
 */
#include "plant/rig_guess.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define RPM 0.10471975511965977 /* 2 pi / 60 rad/s */

enum { LINE = 512, LEAST_GEAR = -1, MOST_GEAR = 30 };

typedef struct writer {
    const rig_guess *g;
    void (*write)(void *context, const char *text);
    void *context;
    gm_rig_guess_summary summary;
} writer;

GM_PRINTF(2, 3) static void say(writer *w, const char *format, ...)
{
    char text[LINE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    w->write(w->context, text);
}

/* A text as YAML: in quotes, with what would end them escaped. */
static void say_text(writer *w, const char *text)
{
    char piece[3] = "";
    w->write(w->context, "\"");
    for (; *text; text++) {
        int escaped = *text == '"' || *text == '\\';
        piece[0] = escaped ? '\\' : *text;
        piece[1] = escaped ? *text : '\0';
        w->write(w->context, (unsigned char)*text < ' ' ? " " : piece);
    }
    w->write(w->context, "\"");
}

/* A number; the point does not depend on the locale. */
static void say_number(writer *w, double value)
{
    char text[40];
    (void)snprintf(text, sizeof text, "%.15g", value);
    for (char *c = text; *c; c++)
        if (*c == ',')
            *c = '.';
    w->write(w->context, text);
}

static void guessed(writer *w, const char *what)
{
    say(w, "  # guessed: %s", what);
    w->summary.guessed++;
}

static void missing(writer *w, const char *what)
{
    say(w, "TODO  # %s", what);
    w->summary.missing++;
}

/* ---- variables ---- */

static void say_unit(writer *w, const fmu_variable *v, const char *si)
{
    double factor, offset;
    if (!v->unit || !v->unit[0]) {
        say(w, ", unit: %s}", si);
        guessed(w, "the FMU states no unit");
    } else if (gm_foreign_unit(w->g->of, v->unit, &factor, &offset)) {
        say(w, "}  # %s", v->unit);
    } else {
        say(w, ", unit: ");
        say_text(w, v->unit);
        say(w, "}");
        guessed(w, "this unit is not known; say one that is");
    }
}

static void say_signal(writer *w, const char *indent, const char *key,
                       const fmu_variable *v, const char *si)
{
    int outward = strcmp(key, "torque") == 0 && gm_rig_words_outward(v->description);
    say(w, "%s%s: {variable: ", indent, key);
    say_text(w, v->name);
    if (outward)
        say(w, ", sign: minus");
    say_unit(w, v, si);
    if (outward) {
        say(w, "\n%s#", indent);
        guessed(w, "minus, as its description says that it counts out of the gearset");
    }
    say(w, "\n");
}

static void say_flange(writer *w, const char *indent, const rig_flange_guess *f)
{
    say(w, "%sdrive: %s", indent, f->takes_speed ? "speed" : "torque");
    if (f->by_elimination)
        guessed(w, "these two variables were left over; their names differ");
    say(w, "\n");
    say_signal(w, indent, "torque", f->torque, "N.m");
    say_signal(w, indent, "speed", f->speed, "rad/s");
    if (f->angle)
        say_signal(w, indent, "angle", f->angle, "rad");
}

/* ---- gears ---- */

static int has_gears(const fmu_description *d, const char *path)
{
    for (int i = 0; i < d->n_gears; i++)
        if (strcmp(d->gears[i].path, path) == 0)
            return 1;
    return 0;
}

/* As a component of this program says. Returns whether it can be in neutral. */
static void say_stated(writer *w, const char *path)
{
    const fmu_description *d = w->g->of;
    say(w, "    gears:\n");
    for (int i = 0; i < d->n_gears; i++) {
        if (strcmp(d->gears[i].path, path) != 0)
            continue;
        say(w, "      %d: {ratio: ", d->gears[i].number);
        say_number(w, d->gears[i].ratio);
        say(w, "}\n");
    }
}

static int is_range_of_gears(const fmu_variable *v)
{
    return v->least >= LEAST_GEAR && v->greatest <= MOST_GEAR &&
           v->greatest >= fmax(1.0, v->least);
}

/* Of two paths one has the odd gears, the other the even ones. */
static int has_gear(const rig_guess *g, int p, int number)
{
    return number == -1 || g->n_paths == 1 || number % 2 == (p == 0);
}

static void say_gear(writer *w, int number, int takes_speed)
{
    say(w, "      %d: {", number);
    if (takes_speed) {
        say(w, "ratio: ");
        missing(w, "input speed over output speed, negative for reverse; then }");
    } else {
        say(w, "}");
    }
    say(w, "\n");
}

static void say_range(writer *w, int p, const fmu_variable *v)
{
    const rig_guess *g = w->g;
    int takes_speed = g->flange[1 + p].takes_speed;
    say(w, "    gears:");
    guessed(w, g->n_paths == 1 ? "the whole range of the variable"
                               : "odd or even numbers in the range of the variable");
    say(w, "\n");
    for (int n = (int)ceil(v->least); n <= (int)v->greatest; n++)
        if (n != 0 && has_gear(g, p, n))
            say_gear(w, n, takes_speed);
}

/* A path without a variable for gears has one gear. */
static void say_fixed(writer *w, int p)
{
    say(w, "    neutral: false");
    guessed(w, "no variable for gears was found; so it has one gear");
    say(w, "\n    inertia_kgm2: ");
    missing(w, "what turns with this flange; without neutral it cannot be measured");
    say(w, "\n    gears:\n");
    say_gear(w, 1, w->g->flange[1 + p].takes_speed);
}

static void say_gears(writer *w, int p)
{
    const rig_guess *g = w->g;
    const fmu_variable *v = g->gear[p];
    const char *path = gm_rig_guess_path(g, p);
    int takes_speed = g->flange[1 + p].takes_speed;
    if (!v) {
        say_fixed(w, p);
        return;
    }
    say(w, "    gear: {variable: ");
    say_text(w, v->name);
    say(w, "}");
    if (g->gear_guessed[p])
        guessed(w, "its name does not say this path");
    say(w, "\n");
    if (has_gears(g->of, path)) {
        say_stated(w, path);
    } else if (v->kind == FMU_BOOLEAN) {
        say(w, "    gears:");
        guessed(w, "a switch has one gear");
        say(w, "\n");
        say_gear(w, 1, takes_speed);
    } else if (is_range_of_gears(v)) {
        say_range(w, p, v);
    } else {
        say(w, "    gears: ");
        missing(w, "such as {-1: {ratio: -12}, 1: {ratio: 14}}; ratios may be left out "
                   "where the model takes torque");
        say(w, "\n");
    }
}

/* A component of this program whose path has no neutral says the path's inertia. */
static void say_neutral(writer *w, int p)
{
    const rig_guess *g = w->g;
    const fmu_description *d = g->of;
    const char *path = gm_rig_guess_path(g, p);
    int n = 0;
    double inertia = (double)NAN;
    for (int i = 0; i < d->n_gears; i++)
        if (strcmp(d->gears[i].path, path) == 0) {
            inertia = d->gears[i].inertia;
            n++;
        }
    if (n != 1 || !g->gear[p] || !(g->gear[p]->least == g->gear[p]->greatest))
        return;
    say(w, "    neutral: false\n    inertia_kgm2: ");
    say_number(w, inertia);
    say(w, "\n");
}

/* ---- limits and the rest ---- */

/* The greatest value that the FMU allows at an input flange, SI; NAN: not stated. */
static double greatest(const rig_guess *g, int speed)
{
    double least = (double)NAN, factor = 1.0, offset = 0.0;
    for (int p = 0; p < g->n_paths; p++) {
        const rig_flange_guess *f = &g->flange[1 + p];
        const fmu_variable *v = speed ? f->speed : f->torque;
        if (v->unit && v->unit[0])
            (void)gm_foreign_unit(g->of, v->unit, &factor, &offset);
        least = fmin(least, factor * v->greatest);
    }
    return least;
}

static void say_limit(writer *w, const char *key, double given, double own, double stated,
                      double unit, const char *option)
{
    double found = !isnan(given) ? given : !isnan(own) ? own : stated;
    say(w, "  %s: ", key);
    if (isnan(found)) {
        char line[96];
        (void)snprintf(line, sizeof line,
                       "how far to measure; the FMU does not say it (%s)", option);
        missing(w, line);
    } else {
        say_number(w, found / unit);
        if (isnan(given) && isnan(own))
            guessed(w, "the greatest value that the FMU allows");
    }
    say(w, "\n");
}

static void say_limits(writer *w, const gm_rig_hints *hints)
{
    const fmu_description *d = w->g->of;
    say(w, "limits:\n");
    say_limit(w, "input_speed_max_rpm", hints->speed_max, d->speed_max, greatest(w->g, 1),
              RPM, "--speed-max");
    say_limit(w, "input_torque_max_Nm", hints->torque_max, d->torque_max,
              greatest(w->g, 0), 1.0, "--torque-max");
}

static void say_oil(writer *w)
{
    const rig_guess *g = w->g;
    double own = g->of->oil_temperature;
    say(w, "oil_temperature_degC: ");
    say_number(w, isnan(own) ? 80.0 : own - 273.15);
    if (isnan(own))
        guessed(w, "a warm gearbox");
    say(w, "\n");
    if (!g->oil) {
        say(w,
            "# no variable for the oil temperature was found: the model has its own\n");
        return;
    }
    say_signal(w, "", "oil_temperature", g->oil, "K");
    if (g->oil_guessed) {
        say(w, "#");
        guessed(w, "it may be the temperature of something else");
        say(w, "\n");
    }
}

static int is_used(const rig_guess *g, const fmu_variable *v)
{
    int used = v == g->oil;
    for (int f = 0; f <= g->n_paths; f++) {
        const rig_flange_guess *flange = &g->flange[f];
        used |= v == flange->torque || v == flange->speed || v == flange->angle;
    }
    for (int p = 0; p < g->n_paths; p++)
        used |= v == g->gear[p];
    return used;
}

static void say_unused(writer *w)
{
    const fmu_description *d = w->g->of;
    int n = 0;
    for (int i = 0; i < d->n_variables; i++) {
        if (d->variables[i].causality != FMU_INPUT || is_used(w->g, &d->variables[i]))
            continue;
        say(w, n++ ? "#   " : "# inputs that keep their start values:\n#   ");
        say_text(w, d->variables[i].name);
        say(w, "\n");
    }
}

static void say_head(writer *w, const gm_rig_hints *hints)
{
    const fmu_description *d = w->g->of;
    const char *name = d->identifier ? d->identifier : d->exchange_identifier;
    char shown[48];
    (void)snprintf(shown, sizeof shown, "%.47s", name);
    say(w, "# A first rig file, by names, units and causalities of the FMU.\n"
           "# Look at what was guessed, fill in what is TODO; all fields: gearmap help "
           "rig-file\n"
           "format: 1\nname: ");
    say_text(w, shown);
    say(w, "\nmodel: ");
    say_text(w, hints->model);
    say(w, "\n");
    if (d->identifier && d->exchange_identifier)
        say(w, "interface: co_simulation  # the FMU offers model_exchange too\n");
}

void gm_rig_guess_write(const rig_guess *g, const gm_rig_hints *hints,
                        void (*write)(void *context, const char *text), void *context,
                        gm_rig_guess_summary *summary)
{
    writer w = {.g = g, .write = write, .context = context};
    say_head(&w, hints);
    say_limits(&w, hints);
    say_oil(&w);
    say(&w, "paths:");
    if (g->sides_guessed)
        guessed(&w, "the names do not say which flange is which");
    say(&w, "\n");
    for (int p = 0; p < g->n_paths; p++) {
        say(&w, "  %s:\n", gm_rig_guess_path(g, p));
        say_flange(&w, "    ", &g->flange[1 + p]);
        say_neutral(&w, p);
        say_gears(&w, p);
    }
    say(&w, "output:\n");
    say_flange(&w, "  ", &g->flange[0]);
    say_unused(&w);
    *summary = w.summary;
}
