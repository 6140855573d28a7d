/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/passport.h"

#include <stdbool.h>
#include <string.h>

#define FORMAT 1
#define RPM 9.54929658551372 /* per rad/s */
#define KELVIN 273.15

/* ---- access ---- */

static bool is_steady(const json_t *result)
{
    return json_object_get(result, "cases") != NULL;
}

const json_t *gm_passport_steady(const gm_passport *passport)
{
    for (int i = 0; i < passport->n; i++)
        if (is_steady(passport->result[i]))
            return passport->result[i];
    return NULL;
}

const json_t *gm_passport_cycle(const gm_passport *passport, int i)
{
    const json_t *result = passport->result[i];
    return json_object_get(result, "cycle") ? result : NULL;
}

const json_t *gm_passport_run(const json_t *cycle, size_t i)
{
    const json_t *reduced = json_object_get(cycle, "reduced");
    if (json_is_array(reduced))
        return json_array_get(reduced, i);
    return i == 0 ? reduced : NULL;
}

const json_t *gm_passport_figures(const json_t *cycle, const json_t *run)
{
    return run == json_object_get(cycle, "reduced") ? cycle : run;
}

/* ---- the document: functions that make a part of it give NULL without memory ---- */

/* A text that may be empty, which is null then. */
static json_t *text_or_null(const char *text)
{
    return gm_document_text(*text ? text : NULL);
}

static json_t *model_of(const gm_map *map)
{
    return json_pack("{s:o, s:o, s:o}", "name", gm_document_text(map->name), "title",
                     gm_document_text(map->title), "description_sha256",
                     text_or_null(map->input_sha256));
}

/* Empty without an oil axis. */
static json_t *oil_axis_of(const gm_map *map)
{
    json_t *made = json_array();
    for (int k = 0; k < map->n_oil; k++)
        (void)json_array_append_new(made, json_real(map->oil[k] - KELVIN));
    return made;
}

static json_t *map_of(const gm_map *map)
{
    return json_pack("{s:o, s:o, s:o, s:f, s:f, s:f, s:o}", "content_hash",
                     text_or_null(map->content_hash), "tool_version",
                     gm_document_text(map->tool_version), "options",
                     gm_document_text(map->options), "speed_max_rpm",
                     map->speed_max * RPM, "torque_max_Nm", map->torque_max,
                     "oil_temperature_degC", map->oil_temperature - KELVIN,
                     "oil_temperatures_degC", oil_axis_of(map));
}

static json_t *fmu_of(const gm_passport_component *c)
{
    return json_pack("{s:o, s:o, s:s, s:o}", "guid", gm_document_text(c->guid),
                     "interpolation", gm_document_text(c->interpolation), "platform",
                     GM_FMI2_PLATFORM, "binary_sha256",
                     gm_document_text(c->library_sha256));
}

/* Copy members; one that is missing becomes null. */
static bool copy_members(json_t *to, const json_t *from, const char *const *keys)
{
    bool copied = true;
    for (; *keys; keys++) {
        json_t *member = json_object_get(from, *keys);
        copied &= json_object_set(to, *keys, member ? member : json_null()) == 0;
    }
    return copied;
}

static json_t *kept(json_t *made, bool complete)
{
    if (complete)
        return made;
    json_decref(made);
    return NULL;
}

static json_t *steady_of(const json_t *result)
{
    static const char *const keys[] = {"measured",     "points", "seed",   "max_relative",
                                       "rms_relative", "cases",  "groups", NULL};
    if (!result)
        return json_null();
    json_t *made = json_object(), *by_oil = json_object_get(result, "by_oil_temperature");
    bool complete = copy_members(made, result, keys);
    if (by_oil) /* of a component with an oil axis */
        complete &= json_object_set(made, "by_oil_temperature", by_oil) == 0;
    return kept(made, complete);
}

/* A drive with its figures, which stand beside it where there is one drive only. */
static json_t *run_of(const json_t *cycle, const json_t *run)
{
    static const char *const keys[] = {
        "cpu_saved", "errors", "differences", "loss_by_gear", "shifts", "worst", NULL};
    const json_t *figures = gm_passport_figures(cycle, run);
    json_t *made = json_copy((json_t *)run);
    return kept(made, made && (figures == run || copy_members(made, figures, keys)));
}

static json_t *cycle_of(const json_t *cycle)
{
    static const char *const keys[] = {
        "measured",       "cycle",     "duration_s", "distance_m",
        "vehicle_sha256", "tolerance", "detailed",   NULL};
    json_t *made = json_object(), *runs = json_array();
    const json_t *run;
    bool complete = copy_members(made, cycle, keys);
    for (size_t i = 0; (run = gm_passport_run(cycle, i)) != NULL; i++)
        complete &= json_array_append_new(runs, run_of(cycle, run)) == 0;
    complete &= json_object_set_new(made, "reduced", runs) == 0;
    return kept(made, complete);
}

static json_t *cycles_of(const gm_passport *passport)
{
    json_t *made = json_array();
    bool complete = true;
    for (int i = 0; i < passport->n; i++)
        if (gm_passport_cycle(passport, i))
            complete &= json_array_append_new(
                            made, cycle_of(gm_passport_cycle(passport, i))) == 0;
    return kept(made, complete);
}

void gm_passport_write(const gm_passport *passport,
                       const gm_passport_component *component, gm_buffer *buffer)
{
    json_t *document = json_pack(
        "{s:i, s:o, s:o, s:o, s:o, s:o}", "passport", FORMAT, "model",
        model_of(component->map), "map", map_of(component->map), "fmu", fmu_of(component),
        "steady", steady_of(gm_passport_steady(passport)), "cycles", cycles_of(passport));
    gm_document_write(document, buffer);
    json_decref(document);
}
