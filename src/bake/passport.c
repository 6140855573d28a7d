/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/passport.h"

#include "bake/json_put.h"
#include "base/alloc.h"

#include <string.h>

#define FORMAT 1
#define RPM 9.54929658551372 /* per rad/s */
#define KELVIN 273.15

/* ---- what a result must have ---- */

typedef struct member {
    const char *key;
    gm_json_kind kind;
} member;

static const member of_steady[] = {
    {"points", GM_JSON_NUMBER},       {"seed", GM_JSON_NUMBER},
    {"max_relative", GM_JSON_NUMBER}, {"rms_relative", GM_JSON_NUMBER},
    {"cases", GM_JSON_ARRAY},         {"groups", GM_JSON_OBJECT},
};
static const member of_group[] = {
    {"max_relative", GM_JSON_NUMBER},
    {"rms_relative", GM_JSON_NUMBER},
    {"cases", GM_JSON_ARRAY},
};
static const member of_case[] = {
    {"path", GM_JSON_TEXT},           {"direction", GM_JSON_TEXT},
    {"points", GM_JSON_NUMBER},       {"largest_loss_Nm", GM_JSON_NUMBER},
    {"max_Nm", GM_JSON_NUMBER},       {"rms_Nm", GM_JSON_NUMBER},
    {"max_relative", GM_JSON_NUMBER}, {"rms_relative", GM_JSON_NUMBER},
    {"worst", GM_JSON_OBJECT},
};
static const member of_cycle[] = {
    {"cycle", GM_JSON_TEXT},
    {"duration_s", GM_JSON_NUMBER},
    {"detailed", GM_JSON_OBJECT},
};
static const member of_drive[] = {
    {"cpu_s", GM_JSON_NUMBER},
    {"real_time_factor", GM_JSON_NUMBER},
};
static const member of_figures[] = {
    {"cpu_saved", GM_JSON_NUMBER},
    {"errors", GM_JSON_OBJECT},
};

/* The first member that is missing or of another kind; NULL: none. */
static const char *lacks(const gm_json_node *object, const member *members, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const gm_json_node *found = gm_json_member(object, members[i].key);
        if (!found || found->kind != members[i].kind)
            return members[i].key;
    }
    return NULL;
}

#define LACKS(object, members) lacks(object, members, sizeof members / sizeof *members)

static const char *cases_lack(const gm_json_node *object)
{
    const char *missing = NULL;
    const gm_json_node *cases = gm_json_member(object, "cases");
    for (const gm_json_node *c = cases->first; c && !missing; c = c->next)
        missing = LACKS(c, of_case);
    return missing;
}

static const char *steady_lacks(const gm_json_node *result)
{
    const char *missing = LACKS(result, of_steady);
    if (!missing)
        missing = cases_lack(result);
    if (missing)
        return missing;
    const gm_json_node *groups = gm_json_member(result, "groups");
    for (const gm_json_node *g = groups->first; g && !missing; g = g->next) {
        missing = LACKS(g, of_group);
        if (!missing)
            missing = cases_lack(g);
    }
    return missing;
}

static const char *cycle_lacks(const gm_json_node *result)
{
    const char *missing = LACKS(result, of_cycle);
    if (!missing)
        missing = LACKS(gm_json_member(result, "detailed"), of_drive);
    if (!missing && !gm_passport_first_run(result))
        return "reduced";
    for (const gm_json_node *run = gm_passport_first_run(result); run && !missing;
         run = gm_passport_next_run(result, run)) {
        missing = LACKS(run, of_drive);
        if (!missing && !*gm_json_member_text(run, "fidelity"))
            missing = "fidelity";
        if (!missing)
            missing = LACKS(gm_passport_figures(result, run), of_figures);
    }
    return missing;
}

static gm_status check_form(const char *name, const gm_json_node *result, gm_error *error)
{
    const bool steady = gm_json_member(result, "cases"),
               cycle = gm_json_member(result, "cycle");
    const char *missing = steady || cycle ? NULL : "cases";
    if (!gm_json_member(result, "measured"))
        missing = "measured";
    if (!missing && steady)
        missing = steady_lacks(result);
    if (!missing && cycle)
        missing = cycle_lacks(result);
    if (!missing)
        return GM_OK;
    return gm_fail(
        error, GM_ERR_FORMAT,
        "%s: is not what gearmap verify --json prints: '%s' is missing or wrong", name,
        missing);
}

/* ---- whose result it is ---- */

static gm_status check_origin(const char *name, const gm_json_node *result,
                              const gm_map *map, const char *guid, gm_error *error)
{
    const gm_json_node *measured = gm_json_member(result, "measured");
    const char *map_hash = gm_json_member_text(measured, "map_hash"),
               *measured_guid = gm_json_member_text(measured, "fmu_guid");
    if (strcmp(map_hash, map->content_hash) != 0)
        return gm_fail(
            error, GM_ERR_MODEL,
            "%s: was measured with another map (content hash %.16s, not %.16s)", name,
            *map_hash ? map_hash : "unknown", map->content_hash);
    if (strcmp(gm_json_member_text(measured, "description_sha256"), map->input_sha256) !=
        0)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s: was measured against another description than the map's",
                       name);
    if (strcmp(measured_guid, guid) != 0)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s: was measured on another component of this map (GUID %.38s, "
                       "not %s)",
                       name, *measured_guid ? measured_guid : "unknown", guid);
    return GM_OK;
}

static gm_status read_one(const gm_bake_result *result, const gm_map *map,
                          const char *guid, gm_json_tree **tree, gm_error *error)
{
    gm_json_tree *made = NULL;
    gm_status status = gm_json_read(result->name, result->json, &made, error);
    if (status == GM_OK)
        status = check_form(result->name, gm_json_root(made), error);
    if (status == GM_OK)
        status = check_origin(result->name, gm_json_root(made), map, guid, error);
    if (status == GM_OK)
        *tree = made;
    else
        gm_json_tree_destroy(made);
    return status;
}

gm_status gm_bake_check_result(const gm_bake_result *result, const gm_map *map,
                               const char *guid, gm_error *error)
{
    gm_json_tree *tree = NULL;
    gm_status status = read_one(result, map, guid, &tree, error);
    gm_json_tree_destroy(tree);
    return status;
}

/* ---- all results ---- */

static int count_steady(const gm_passport *passport)
{
    int n = 0;
    for (int i = 0; i < passport->n; i++)
        n += gm_json_member(gm_json_root(passport->tree[i]), "cases") != NULL;
    return n;
}

gm_status gm_passport_read(int n, const gm_bake_result *results, const gm_map *map,
                           const char *guid, gm_passport *passport, gm_error *error)
{
    gm_passport made = {.tree = gm_calloc((size_t)n, sizeof *made.tree)};
    gm_status status = GM_OK;
    if (!made.tree)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the passport");
    for (; made.n < n && status == GM_OK; made.n += status == GM_OK)
        status = read_one(&results[made.n], map, guid, &made.tree[made.n], error);
    if (status == GM_OK && count_steady(&made) > 1)
        status = gm_fail(error, GM_ERR_FORMAT,
                         "%s: a passport has one result with steady errors, not %d",
                         results[n - 1].name, count_steady(&made));
    if (status == GM_OK)
        *passport = made;
    else
        gm_passport_clear(&made);
    return status;
}

void gm_passport_clear(gm_passport *passport)
{
    for (int i = 0; i < passport->n; i++)
        gm_json_tree_destroy(passport->tree[i]);
    gm_free(passport->tree);
    *passport = (gm_passport){0};
}

/* ---- access ---- */

const gm_json_node *gm_passport_steady(const gm_passport *passport)
{
    for (int i = 0; i < passport->n; i++)
        if (gm_json_member(gm_json_root(passport->tree[i]), "cases"))
            return gm_json_root(passport->tree[i]);
    return NULL;
}

const gm_json_node *gm_passport_cycle(const gm_passport *passport, int i)
{
    const gm_json_node *result = gm_json_root(passport->tree[i]);
    return gm_json_member(result, "cycle") ? result : NULL;
}

const gm_json_node *gm_passport_first_run(const gm_json_node *cycle)
{
    const gm_json_node *reduced = gm_json_member(cycle, "reduced");
    return reduced && reduced->kind == GM_JSON_ARRAY ? reduced->first : reduced;
}

const gm_json_node *gm_passport_next_run(const gm_json_node *cycle,
                                         const gm_json_node *run)
{
    return run == gm_json_member(cycle, "reduced") ? NULL : run->next;
}

const gm_json_node *gm_passport_figures(const gm_json_node *cycle,
                                        const gm_json_node *run)
{
    return run == gm_json_member(cycle, "reduced") ? cycle : run;
}

/* ---- the document ---- */

static const char *or_null(const char *text)
{
    return *text ? text : NULL;
}

static void put_origin(gm_json_put *put, const gm_passport_component *c)
{
    const gm_map *map = c->map;
    gm_json_put_open(put, "model", '{');
    gm_json_put_text(put, "name", map->name);
    gm_json_put_text(put, "title", map->title);
    gm_json_put_text(put, "description_sha256", or_null(map->input_sha256));
    gm_json_put_close(put, '}');
    gm_json_put_open(put, "map", '{');
    gm_json_put_text(put, "content_hash", or_null(map->content_hash));
    gm_json_put_text(put, "tool_version", map->tool_version);
    gm_json_put_text(put, "options", map->options);
    gm_json_put_number(put, "speed_max_rpm", map->speed_max * RPM);
    gm_json_put_number(put, "torque_max_Nm", map->torque_max);
    gm_json_put_number(put, "oil_temperature_degC", map->oil_temperature - KELVIN);
    gm_json_put_close(put, '}');
    gm_json_put_open(put, "fmu", '{');
    gm_json_put_text(put, "guid", c->guid);
    gm_json_put_text(put, "interpolation", c->interpolation);
    gm_json_put_text(put, "platform", GM_FMI2_PLATFORM);
    gm_json_put_text(put, "binary_sha256", c->library_sha256);
    gm_json_put_close(put, '}');
}

static void put_members(gm_json_put *put, const gm_json_node *from,
                        const char *const *keys)
{
    for (; *keys; keys++)
        gm_json_put_node(put, *keys, gm_json_member(from, *keys));
}

static void put_steady(gm_json_put *put, const gm_json_node *result)
{
    static const char *const keys[] = {"measured",     "points", "seed",   "max_relative",
                                       "rms_relative", "cases",  "groups", NULL};
    if (!result) {
        gm_json_put_text(put, "steady", NULL);
        return;
    }
    gm_json_put_open(put, "steady", '{');
    put_members(put, result, keys);
    gm_json_put_close(put, '}');
}

/* A drive with its figures, which stand beside it where there is one drive only. */
static void put_run(gm_json_put *put, const gm_json_node *cycle, const gm_json_node *run)
{
    static const char *const keys[] = {
        "cpu_saved", "errors", "differences", "loss_by_gear", "shifts", "worst", NULL};
    const gm_json_node *figures = gm_passport_figures(cycle, run);
    gm_json_put_open(put, NULL, '{');
    for (const gm_json_node *n = run->first; n; n = n->next)
        gm_json_put_node(put, n->key, n);
    if (figures != run)
        put_members(put, figures, keys);
    gm_json_put_close(put, '}');
}

static void put_cycle(gm_json_put *put, const gm_json_node *cycle)
{
    static const char *const keys[] = {
        "measured",       "cycle",     "duration_s", "distance_m",
        "vehicle_sha256", "tolerance", "detailed",   NULL};
    gm_json_put_open(put, NULL, '{');
    put_members(put, cycle, keys);
    gm_json_put_open(put, "reduced", '[');
    for (const gm_json_node *run = gm_passport_first_run(cycle); run;
         run = gm_passport_next_run(cycle, run))
        put_run(put, cycle, run);
    gm_json_put_close(put, ']');
    gm_json_put_close(put, '}');
}

void gm_passport_write(const gm_passport *passport,
                       const gm_passport_component *component, gm_buffer *buffer)
{
    gm_json_put put = {.buffer = buffer};
    gm_json_put_open(&put, NULL, '{');
    gm_json_put_number(&put, "passport", FORMAT);
    put_origin(&put, component);
    put_steady(&put, gm_passport_steady(passport));
    gm_json_put_open(&put, "cycles", '[');
    for (int i = 0; i < passport->n; i++)
        if (gm_passport_cycle(passport, i))
            put_cycle(&put, gm_passport_cycle(passport, i));
    gm_json_put_close(&put, ']');
    gm_json_put_close(&put, '}');
    gm_buffer_text(buffer, "\n");
}
