/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading a description: tree, fields, order, checks; and its life.
 */
#include "base/alloc.h"
#include "model/bearing.h"
#include "model/check.h"
#include "model/description_fields.h"
#include "model/description_yaml.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHOWN_PATH ((size_t)200)

static gm_status fail_va(const char *file, int line, const char *element,
                         gm_status status, gm_error *error, const char *format,
                         va_list args)
{
    char sentence[GM_ERROR_MESSAGE_SIZE];
    size_t length = strlen(file);
    const char *shown = length > SHOWN_PATH ? file + length - SHOWN_PATH : file;
    (void)vsnprintf(sentence, sizeof sentence, format, args);
    return gm_fail(error, status, "%s%s:%d: %s%s%s", shown == file ? "" : "...", shown,
                   line, element, element[0] ? ": " : "", sentence);
}

gm_status gm_description_fail(const char *file, int line, const char *element,
                              gm_status status, gm_error *error, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    (void)fail_va(file, line, element, status, error, format, args);
    va_end(args);
    return status;
}

gm_status gm_part_fail(const gm_description *d, const char *word, const gm_label *part,
                       gm_error *error, const char *format, ...)
{
    char element[2 * GM_NAME_SIZE];
    va_list args;
    (void)snprintf(element, sizeof element, "%s '%s'", word, part->name);
    va_start(args, format);
    (void)fail_va(d->file, part->line, element, GM_ERR_MODEL, error, format, args);
    va_end(args);
    return GM_ERR_MODEL;
}

static int by_number(const void *a, const void *b)
{
    const gm_path_gear *x = a, *y = b;
    return (x->number > y->number) - (x->number < y->number);
}

/* Number 0 stands apart: what is locked while the path is in no gear. A second one stays
 * and is refused like any number that stands twice. */
static void take_neutral_out(gm_path_part *path)
{
    int i = 0;
    while (i < path->n_gears && path->gears[i].number != 0)
        i++;
    int found = i < path->n_gears;
    path->neutral = (gm_path_gear){.ratio = (double)NAN, .line = path->id.line};
    if (found) {
        path->neutral = path->gears[i];
        path->n_gears--;
        memmove(&path->gears[i], &path->gears[i + 1],
                (size_t)(path->n_gears - i) * sizeof *path->gears);
    }
    path->has_neutral =
        path->n_gears != 1 || !gm_same_locks(&path->gears[0], &path->neutral);
}

/* Splines without play. */
static void complete_clutches(gm_description *d)
{
    for (int i = 0; i < d->n_clutches; i++)
        d->clutches[i].closed.model = GM_CONTACT_LINEAR;
}

/* Order that does not depend on the file: odd before even, gears by number. */
static void arrange(gm_description *d)
{
    for (int p = 0; p < d->n_paths; p++) {
        qsort(d->paths[p].gears, (size_t)d->paths[p].n_gears, sizeof *d->paths[p].gears,
              by_number);
        take_neutral_out(&d->paths[p]);
    }
    if (d->n_paths == 2 && strcmp(d->paths[0].id.name, "even") == 0) {
        gm_path_part even = d->paths[0];
        d->paths[0] = d->paths[1];
        d->paths[1] = even;
    }
}

/* A series that no friction model would look at. */
static gm_status check_series(const gm_description *d, const char *word,
                              const gm_label *id, const gm_bearing_data *data,
                              gm_error *error)
{
    if (data->series[0] == '\0')
        return GM_OK;
    if (data->designation[0] != '\0')
        return gm_part_fail(d, word, id, error,
                            "the series follows from the designation; found series '%s' "
                            "beside designation '%s'",
                            data->series, data->designation);
    if (data->type == GM_BEARING_NEEDLE_ROLLER)
        return gm_part_fail(d, word, id, error,
                            "the series of a needle roller bearing has no effect, found "
                            "'%s'",
                            data->series);
    return GM_OK;
}

static gm_status complete_bearing(const gm_description *d, const char *word,
                                  const gm_label *id, gm_bearing_data *data,
                                  gm_error *error)
{
    gm_error why = {GM_OK, ""};
    gm_status status = check_series(d, word, id, data, error);
    if (status != GM_OK || data->designation[0] == '\0')
        return status;
    if (!isnan(data->d) || !isnan(data->D) || !isnan(data->B) || !isnan(data->C0))
        return gm_part_fail(d, word, id, error,
                            "a bearing has either a designation or dimensions; found "
                            "designation '%s' and dimensions",
                            data->designation);
    if (gm_bearing_data_complete(data, &why) != GM_OK)
        return gm_part_fail(d, word, id, error, "%s", why.message);
    return GM_OK;
}

/* What follows from other values: bearing dimensions from the designation, bores. */
static gm_status complete(gm_description *d, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < d->n_bearings && status == GM_OK; i++)
        status = complete_bearing(d, "bearing", &d->bearings[i].id, &d->bearings[i].data,
                                  error);
    for (int i = 0; i < d->n_wheels && status == GM_OK; i++) {
        gm_wheel *w = &d->wheels[i];
        status = complete_bearing(d, "gear", &w->id, &w->bearing, error);
        const gm_segment *s = gm_shaft_segment(&d->shafts[w->shaft], w->position);
        if (isnan(w->bore) && w->bearing.D > 0.0)
            w->bore = w->bearing.D;
        if (isnan(w->bore) && s)
            w->bore = s->diameter;
        if (w->planets > 0 && isnan(w->pin_angle))
            w->pin_angle = 0.0;
    }
    return status;
}

static gm_status read_into(const char *path, gm_description *d, gm_error *error)
{
    gm_yaml *tree = NULL;
    d->file = gm_strdup(path);
    gm_status status = d->file ? gm_yaml_read(path, d->sha256, &tree, error)
                               : gm_fail(error, GM_ERR_MEMORY, "out of memory");
    if (status == GM_OK)
        status = gm_fields_read(path, gm_schema_root(), tree, d, error);
    if (status == GM_OK) {
        arrange(d);
        complete_clutches(d);
        status = complete(d, error);
    }
    if (status == GM_OK)
        status = gm_check_description(d, error);
    gm_yaml_destroy(tree);
    return status;
}

gm_status gm_description_read(const char *path, gm_description **description,
                              gm_error *error)
{
    gm_description *d = gm_calloc(1, sizeof *d);
    if (!d)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = read_into(path, d, error);
    if (status != GM_OK) {
        gm_description_destroy(d);
        return status;
    }
    *description = d;
    return GM_OK;
}

static void destroy_path(gm_path_part *path)
{
    for (int i = 0; path->gears && i < path->n_gears; i++)
        gm_free(path->gears[i].locks);
    gm_free(path->neutral.locks);
    gm_free(path->gears);
}

void gm_description_destroy(gm_description *d)
{
    if (!d)
        return;
    for (int i = 0; d->shafts && i < d->n_shafts; i++)
        gm_free(d->shafts[i].segments);
    for (int i = 0; d->synchronisers && i < d->n_synchronisers; i++)
        gm_free(d->synchronisers[i].wheels);
    for (int i = 0; i < GM_MAX_INPUT_PATHS; i++)
        destroy_path(&d->paths[i]);
    gm_free(d->shafts);
    gm_free(d->wheels);
    gm_free(d->meshes);
    gm_free(d->bearings);
    gm_free(d->seals);
    gm_free(d->gaps);
    gm_free(d->jets);
    gm_free(d->synchronisers);
    gm_free(d->clutches);
    gm_free(d->title);
    gm_free(d->file);
    gm_free(d);
}
