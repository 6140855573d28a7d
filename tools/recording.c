/* SPDX-License-Identifier: BSD-2-Clause */
#include "recording.h"

#include "base/alloc.h"
#include "base/text.h"

#include "files.h"

#include <errno.h>
#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define RPM 0.10471975511965977 /* rad/s */
#define PATTERN_SIZE 128

struct gm_recording {
    gm_recording_source source;
    void *motion;
    int n_flanges, n_signals, n_chosen, n_columns;
    int *chosen;   /* [n_signals], the first n_chosen hold */
    double *scale; /* [n_signals] */
    double *value; /* [n_signals] */
    long rows;
    const char *path;
    char own[GM_PATH_SIZE];
    FILE *out;
};

/* ---- the choice of signals ---- */

static gm_status no_signal(const gm_recording *r, const char *pattern, gm_error *error)
{
    const gm_dynamics_class *is = r->source.dynamics->is;
    size_t n = (size_t)r->n_signals;
    const char **names = gm_calloc(n, sizeof *names);
    int near = -1;
    for (size_t i = 0; i < n && names; i++)
        names[i] = is->signal(r->motion, (int)i).name;
    if (names)
        near = gm_text_nearest(pattern, names, r->n_signals);
    gm_status status =
        near >= 0
            ? gm_fail(error, GM_ERR_ARGUMENT,
                      "--signals: there is no signal %s, did you mean %s?", pattern,
                      names[near])
            : gm_fail(error, GM_ERR_ARGUMENT,
                      "--signals: %s fits none of the %d signals, such as %s", pattern,
                      r->n_signals, n > 0 ? is->signal(r->motion, 0).name : "none");
    gm_free(names);
    return status;
}

static gm_status choose_pattern(gm_recording *r, const char *pattern, int *take,
                                gm_error *error)
{
    int found = 0;
    for (int i = 0; i < r->n_signals; i++) {
        const char *name = r->source.dynamics->is->signal(r->motion, i).name;
        if (fnmatch(pattern, name, 0) == 0)
            take[i] = found = 1;
    }
    int everything = strcmp(pattern, "*") == 0;
    return found || everything ? GM_OK : no_signal(r, pattern, error);
}

static gm_status choose(gm_recording *r, const char *patterns, gm_error *error)
{
    int *take = gm_calloc((size_t)r->n_signals, sizeof *take);
    gm_status status = take ? GM_OK : gm_fail(error, GM_ERR_MEMORY, "out of memory");
    while (status == GM_OK && *patterns) {
        char pattern[PATTERN_SIZE];
        size_t n = strcspn(patterns, ",");
        if (n >= sizeof pattern)
            status = gm_fail(error, GM_ERR_ARGUMENT,
                             "--signals: %.40s... is longer than %d characters", patterns,
                             PATTERN_SIZE - 1);
        else {
            (void)snprintf(pattern, sizeof pattern, "%.*s", (int)n, patterns);
            if (n > 0)
                status = choose_pattern(r, pattern, take, error);
        }
        patterns += n + (patterns[n] == ',');
    }
    for (int i = 0; i < r->n_signals && status == GM_OK; i++)
        if (take[i])
            r->chosen[r->n_chosen++] = i;
    gm_free(take);
    return status;
}

/* ---- the first line ---- */

static const char *flange_name(const gm_recording *r, int f)
{
    return f == 0 ? "output" : r->source.info->path[f - 1].name;
}

/* The unit as it stands in a name, and how many of it one SI unit makes. */
static double unit_in_name(const char *unit, char text[32])
{
    size_t n = 0;
    if (strcmp(unit, "rad/s") == 0) {
        strcpy(text, "_rpm");
        return 1.0 / RPM;
    }
    if (*unit && strcmp(unit, "1") != 0)
        text[n++] = '_';
    for (const char *c = unit; *c && strcmp(unit, "1") != 0 && n < 31; c++)
        if (*c == '/')
            text[n++] = '_';
        else if (*c != '.')
            text[n++] = *c;
    text[n] = '\0';
    return 1.0;
}

static void write_names(gm_recording *r)
{
    fputs("time_s", r->out);
    for (int f = 0; f < r->n_flanges; f++) {
        const char *name = flange_name(r, f);
        fprintf(r->out, ",%s.speed_rpm,%s.tau_Nm,%s.a_rad_s2", name, name, name);
    }
    for (int f = 1; f < r->n_flanges; f++)
        fprintf(r->out, ",%s.gear,%s.state", flange_name(r, f), flange_name(r, f));
    fputs(",loss_power_W,stored_energy_J", r->out);
    for (int i = 0; i < r->n_chosen; i++) {
        char unit[32];
        gm_motion_signal signal = r->source.dynamics->is->signal(r->motion, r->chosen[i]);
        r->scale[i] = unit_in_name(signal.unit, unit);
        fprintf(r->out, ",%s%s", signal.name, unit);
    }
    fputc('\n', r->out);
    r->n_columns = 1 + 3 * r->n_flanges + 2 * (r->n_flanges - 1) + 2 + r->n_chosen;
}

/* ---- public ---- */

static gm_status failed(const gm_recording *r, gm_error *error)
{
    return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", r->path,
                   strerror(errno));
}

static gm_status make_room(gm_recording *r, gm_error *error)
{
    size_t n = (size_t)r->n_signals;
    r->chosen = gm_calloc(n, sizeof *r->chosen);
    r->scale = gm_calloc(n, sizeof *r->scale);
    r->value = gm_calloc(n, sizeof *r->value);
    return r->chosen && r->scale && r->value
               ? GM_OK
               : gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

gm_status gm_recording_open(const char *path, const gm_recording_source *source,
                            const char *patterns, gm_recording **recording,
                            gm_error *error)
{
    gm_recording *r = gm_calloc(1, sizeof *r);
    if (!r)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    r->source = *source;
    r->path = path;
    r->motion = gm_driven_motion(source->driven);
    r->n_flanges = 1 + source->dynamics->n_paths;
    r->n_signals = source->dynamics->is->n_signals(r->motion);
    gm_status status = make_room(r, error);
    if (status == GM_OK)
        status = choose(r, patterns, error);
    if (status == GM_OK)
        status = gm_file_own_name(path, r->own, error);
    if (status == GM_OK && !(r->out = fopen(r->own, "wb")))
        status = failed(r, error);
    if (status != GM_OK) {
        gm_recording_close(r);
        return status;
    }
    write_names(r);
    *recording = r;
    return GM_OK;
}

gm_status gm_recording_row(gm_recording *r, double t, const double *x, gm_error *error)
{
    const gm_dynamics_class *is = r->source.dynamics->is;
    gm_motion_input input;
    gm_motion_view view;
    if (gm_driven_input(r->source.driven, t, x, &input))
        return gm_fail(error, GM_ERR_SOLVE, "the plant cannot be evaluated at t = %.9g s",
                       t);
    is->view(r->motion, &input, x, &view);
    fprintf(r->out, "%.9g", t);
    for (int f = 0; f < r->n_flanges; f++)
        fprintf(r->out, ",%.9g,%.9g,%.9g", view.speed[f] / RPM, input.torque[f],
                view.acceleration[f]);
    for (int p = 0; p + 1 < r->n_flanges; p++)
        fprintf(r->out, ",%d,%d", input.gear[p], view.state[p]);
    fprintf(r->out, ",%.9g,%.9g", view.loss_power, view.stored_energy);
    if (r->n_chosen > 0)
        is->observe(r->motion, &input, x, r->value);
    for (int i = 0; i < r->n_chosen; i++)
        fprintf(r->out, ",%.7g", r->value[r->chosen[i]] * r->scale[i]);
    r->rows++;
    return fputc('\n', r->out) == EOF ? failed(r, error) : GM_OK;
}

long gm_recording_rows(const gm_recording *r)
{
    return r->rows;
}

int gm_recording_columns(const gm_recording *r)
{
    return r->n_columns;
}

gm_status gm_recording_finish(gm_recording *r, gm_error *error)
{
    FILE *out = r->out;
    r->out = NULL;
    int bad = fflush(out) != 0 || ferror(out);
    bad |= fclose(out) != 0;
    if (bad || rename(r->own, r->path) != 0) {
        gm_status status = failed(r, error);
        (void)unlink(r->own);
        return status;
    }
    return GM_OK;
}

void gm_recording_close(gm_recording *r)
{
    if (!r)
        return;
    if (r->out) {
        (void)fclose(r->out);
        (void)unlink(r->own);
    }
    gm_free(r->chosen);
    gm_free(r->scale);
    gm_free(r->value);
    gm_free(r);
}
