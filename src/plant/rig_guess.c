/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A flange is a torque and a speed whose names say the same place, one of them an input,
 * the other an output. What is left over is taken by elimination.
 */
#include "plant/rig_guess.h"

#include "plant/fmu_archive.h"

#include <stdio.h>
#include <string.h>

static int can_be_set(const fmu_variable *v)
{
    return v->causality == FMU_INPUT || v->causality == FMU_PARAMETER;
}

static int is_integer(const fmu_variable *v)
{
    return v->kind != FMU_REAL && v->kind != FMU_FLOAT32 && v->kind != FMU_OTHER;
}

/* ---- flanges ---- */

static int is(const fmu_description *d, int i, rig_quantity quantity, int causality)
{
    const fmu_variable *v = &d->variables[i];
    return (int)v->causality == causality && gm_rig_words_quantity(d, v) == quantity;
}

/* The first variable of this place, from the start. */
static const fmu_variable *find_at(const fmu_description *d, rig_quantity quantity,
                                   int causality, const char *stem)
{
    char other[RIG_STEM];
    for (int i = 0; i < d->n_variables; i++) {
        if (!is(d, i, quantity, causality))
            continue;
        gm_rig_words_stem(d->variables[i].name, other);
        if (strcmp(stem, other) == 0)
            return &d->variables[i];
    }
    return NULL;
}

static int is_taken(const rig_flange_guess *flange, int n, const fmu_variable *v)
{
    for (int i = 0; i < n; i++)
        if (flange[i].torque == v || flange[i].speed == v)
            return 1;
    return 0;
}

/* The only variable that no flange has; NULL: none or several. */
static const fmu_variable *find_left(const fmu_description *d, rig_quantity quantity,
                                     int causality, const rig_flange_guess *flange, int n)
{
    const fmu_variable *left = NULL;
    for (int i = 0; i < d->n_variables; i++) {
        if (!is(d, i, quantity, causality) || is_taken(flange, n, &d->variables[i]))
            continue;
        if (left)
            return NULL;
        left = &d->variables[i];
    }
    return left;
}

static rig_flange_guess flange_of(const fmu_description *d, const fmu_variable *in,
                                  const fmu_variable *out, int takes_speed)
{
    rig_flange_guess f = {.torque = takes_speed ? out : in,
                          .speed = takes_speed ? in : out,
                          .takes_speed = takes_speed};
    gm_rig_words_stem(in->name, f.stem);
    f.angle = takes_speed ? find_at(d, RIG_ANGLE, FMU_INPUT, f.stem) : NULL;
    return f;
}

/* Flanges whose names go together, for inputs of one quantity. */
static int find_flanges(const fmu_description *d, int takes_speed,
                        rig_flange_guess *flange, int n)
{
    rig_quantity given = takes_speed ? RIG_SPEED : RIG_TORQUE;
    rig_quantity answered = takes_speed ? RIG_TORQUE : RIG_SPEED;
    char stem[RIG_STEM];
    for (int i = 0; i < d->n_variables && n < RIG_GUESS_FLANGES; i++) {
        const fmu_variable *in = &d->variables[i];
        if (!is(d, i, given, FMU_INPUT))
            continue;
        gm_rig_words_stem(in->name, stem);
        const fmu_variable *out = find_at(d, answered, FMU_OUTPUT, stem);
        if (out && !is_taken(flange, n, out))
            flange[n++] = flange_of(d, in, out, takes_speed);
    }
    return n;
}

static int find_rest(const fmu_description *d, int takes_speed, rig_flange_guess *flange,
                     int n)
{
    rig_quantity given = takes_speed ? RIG_SPEED : RIG_TORQUE;
    rig_quantity answered = takes_speed ? RIG_TORQUE : RIG_SPEED;
    const fmu_variable *in = find_left(d, given, FMU_INPUT, flange, n);
    const fmu_variable *out = find_left(d, answered, FMU_OUTPUT, flange, n);
    if (!in || !out || n >= RIG_GUESS_FLANGES)
        return n;
    flange[n] = flange_of(d, in, out, takes_speed);
    flange[n++].by_elimination = 1;
    return n;
}

/* ---- which is which ---- */

static int count_side(const rig_flange_guess *flange, int n, int side, int *last)
{
    int found = 0;
    for (int i = 0; i < n; i++)
        if (gm_rig_words_side(flange[i].stem) == side) {
            *last = i;
            found++;
        }
    return found;
}

/* The one that says so, else the one that is not said to be an input. */
static int find_output(const rig_flange_guess *flange, int n, int *guessed)
{
    int found = n - 1, inputs, ignored = 0;
    *guessed = 0;
    if (count_side(flange, n, 1, &found) == 1)
        return found;
    inputs = count_side(flange, n, -1, &ignored);
    *guessed = inputs != n - 1;
    for (int i = 0; i < n && inputs == n - 1; i++)
        if (gm_rig_words_side(flange[i].stem) != -1)
            found = i;
    return *guessed ? n - 1 : found;
}

static int is_first_path(const char *stem)
{
    return gm_rig_words_has(stem, "odd") || gm_rig_words_has(stem, "1");
}

static int is_second_path(const char *stem)
{
    return gm_rig_words_has(stem, "even") || gm_rig_words_has(stem, "2");
}

static void order_paths(rig_guess *g)
{
    rig_flange_guess *a = &g->flange[1], *b = &g->flange[2];
    if (g->n_paths != 2)
        return;
    if (is_second_path(a->stem) && is_first_path(b->stem)) {
        rig_flange_guess first = *b;
        *b = *a;
        *a = first;
    }
    g->sides_guessed |= !is_first_path(a->stem) || !is_second_path(b->stem);
}

static gm_status choose_flanges(rig_guess *g, const char *fmu, gm_error *error)
{
    rig_flange_guess all[RIG_GUESS_FLANGES];
    int n = find_flanges(g->of, 0, all, 0);
    n = find_flanges(g->of, 1, all, n);
    n = find_rest(g->of, 0, all, n);
    n = find_rest(g->of, 1, all, n);
    if (n < 2 || n > GM_MAX_FLANGES)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: %d shafts were found that have torque and speed, one as an "
                       "input and the other as an output; a gearset has an output and 1 "
                       "or %d inputs (a rig file can be written by hand: gearmap help "
                       "rig-file)",
                       fmu, n, GM_MAX_INPUT_PATHS);
    int output = find_output(all, n, &g->sides_guessed), next = 1;
    g->flange[0] = all[output];
    for (int i = 0; i < n; i++)
        if (i != output)
            g->flange[next++] = all[i];
    g->n_paths = n - 1;
    order_paths(g);
    return GM_OK;
}

const char *gm_rig_guess_path(const rig_guess *g, int p)
{
    static const char *const names[2] = {"odd", "even"};
    return g->n_paths == 1 ? "input" : names[p];
}

/* ---- gears and temperature ---- */

static int may_be_gear(const rig_guess *g, const fmu_variable *v)
{
    if (!can_be_set(v) || v == g->oil || v->kind == FMU_OTHER ||
        is_taken(g->flange, 1 + g->n_paths, v) || v == g->gear[0])
        return 0;
    return gm_rig_words_gear(v->name) && (is_integer(v) || !v->unit || !v->unit[0]);
}

/* By its place, else the only one; an input is better than a parameter. */
static const fmu_variable *find_gear(const rig_guess *g, const char *stem,
                                     fmu_causality causality, int *n)
{
    const fmu_variable *found = NULL;
    char other[RIG_STEM];
    *n = 0;
    for (int i = 0; i < g->of->n_variables; i++) {
        const fmu_variable *v = &g->of->variables[i];
        if (v->causality != causality || !may_be_gear(g, v))
            continue;
        gm_rig_words_stem(v->name, other);
        if (stem && strcmp(stem, other) != 0)
            continue;
        found = v;
        ++*n;
    }
    return found;
}

static const fmu_variable *only_integer(const rig_guess *g)
{
    const fmu_variable *found = NULL;
    for (int i = 0; i < g->of->n_variables; i++) {
        const fmu_variable *v = &g->of->variables[i];
        if (v->causality != FMU_INPUT || !is_integer(v))
            continue;
        if (found)
            return NULL;
        found = v;
    }
    return found;
}

static void choose_gear(rig_guess *g, int p)
{
    static const fmu_causality order[] = {FMU_INPUT, FMU_PARAMETER};
    for (int i = 0; i < 4 && !g->gear[p]; i++) {
        int n;
        const char *stem = i < 2 ? g->flange[1 + p].stem : NULL;
        const fmu_variable *found = find_gear(g, stem, order[i % 2], &n);
        if (stem ? n > 0 : n == 1 && p == g->n_paths - 1) {
            g->gear[p] = found;
            g->gear_guessed[p] = !stem && g->n_paths > 1;
        }
    }
    if (g->gear[p] || g->n_paths > 1)
        return;
    g->gear[p] = only_integer(g);
    g->gear_guessed[p] = g->gear[p] != NULL;
}

static void choose_oil(rig_guess *g)
{
    int n = 0, with_oil = 0;
    for (int i = 0; i < g->of->n_variables; i++) {
        const fmu_variable *v = &g->of->variables[i];
        if (!can_be_set(v) || gm_rig_words_quantity(g->of, v) != RIG_TEMPERATURE)
            continue;
        int oil = gm_rig_words_oil(v->name);
        if (!g->oil || (oil && !with_oil))
            g->oil = v;
        n++;
        with_oil += oil;
    }
    g->oil_guessed = n > 1 ? with_oil != 1 : with_oil == 0;
}

/* ---- all ---- */

static gm_status guess(const fmu_description *d, const char *fmu, rig_guess *g,
                       gm_error *error)
{
    *g = (rig_guess){.of = d};
    gm_status status = choose_flanges(g, fmu, error);
    if (status != GM_OK)
        return status;
    choose_oil(g);
    for (int p = 0; p < g->n_paths; p++)
        choose_gear(g, p);
    return GM_OK;
}

gm_status gm_rig_guess(const char *fmu, const gm_rig_hints *hints,
                       void (*write)(void *context, const char *text), void *context,
                       gm_rig_guess_summary *summary, gm_error *error)
{
    char folder[FMU_FOLDER_SIZE] = "", path[FMU_FOLDER_SIZE + 32];
    fmu_description d = {0};
    rig_guess g;
    gm_status status = gm_fmu_unpack(fmu, folder, error);
    if (status != GM_OK)
        return status;
    (void)snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    status = gm_fmu_description_read(path, fmu, &d, error);
    if (status == GM_OK)
        status = guess(&d, fmu, &g, error);
    if (status == GM_OK)
        gm_rig_guess_write(&g, hints, write, context, summary);
    gm_fmu_description_clear(&d);
    gm_fmu_remove(folder);
    return status;
}
