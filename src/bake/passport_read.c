/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a result must have to be put into a passport, and whose it must be.
 */
#include "bake/passport.h"

#include "base/alloc.h"

#include <stdbool.h>
#include <string.h>

/* ---- what a result must have ---- */

typedef struct member {
    const char *key;
    json_type type; /* JSON_REAL: any number */
} member;

static const member of_steady[] = {
    {"points", JSON_REAL},       {"seed", JSON_REAL},   {"max_relative", JSON_REAL},
    {"rms_relative", JSON_REAL}, {"cases", JSON_ARRAY}, {"groups", JSON_OBJECT},
};
static const member of_group[] = {
    {"max_relative", JSON_REAL},
    {"rms_relative", JSON_REAL},
    {"cases", JSON_ARRAY},
};
static const member of_case[] = {
    {"path", JSON_STRING},          {"direction", JSON_STRING},  {"points", JSON_REAL},
    {"largest_loss_Nm", JSON_REAL}, {"max_Nm", JSON_REAL},       {"rms_Nm", JSON_REAL},
    {"max_relative", JSON_REAL},    {"rms_relative", JSON_REAL}, {"worst", JSON_OBJECT},
};
static const member of_cycle[] = {
    {"cycle", JSON_STRING},
    {"duration_s", JSON_REAL},
    {"detailed", JSON_OBJECT},
};
static const member of_drive[] = {
    {"cpu_s", JSON_REAL},
    {"real_time_factor", JSON_REAL},
};
static const member of_figures[] = {
    {"cpu_saved", JSON_REAL},
    {"errors", JSON_OBJECT},
};

static bool is_of(const json_t *value, json_type type)
{
    return type == JSON_REAL ? json_is_number(value)
                             : value && json_typeof(value) == type;
}

/* The first member that is missing or of another type; NULL: none. */
static const char *lacks(const json_t *object, const member *members, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!is_of(json_object_get(object, members[i].key), members[i].type))
            return members[i].key;
    return NULL;
}

#define LACKS(object, members) lacks(object, members, sizeof members / sizeof *members)

static const char *cases_lack(const json_t *object)
{
    const char *missing = NULL;
    const json_t *cases = json_object_get(object, "cases");
    for (size_t i = 0; !missing && i < json_array_size(cases); i++)
        missing = LACKS(json_array_get(cases, i), of_case);
    return missing;
}

static const char *group_lacks(const json_t *group)
{
    const char *missing = LACKS(group, of_group);
    return missing ? missing : cases_lack(group);
}

static const char *steady_lacks(const json_t *result)
{
    const char *missing = LACKS(result, of_steady), *key;
    json_t *group;
    if (!missing)
        missing = cases_lack(result);
    if (missing)
        return missing;
    json_object_foreach (json_object_get(result, "groups"), key, group)
        missing = missing ? missing : group_lacks(group);
    return missing;
}

static const char *cycle_lacks(const json_t *result)
{
    const char *missing = LACKS(result, of_cycle);
    if (!missing)
        missing = LACKS(json_object_get(result, "detailed"), of_drive);
    if (!missing && !gm_passport_run(result, 0))
        return "reduced";
    const json_t *run;
    for (size_t i = 0; !missing && (run = gm_passport_run(result, i)) != NULL; i++) {
        missing = LACKS(run, of_drive);
        if (!missing && !*gm_member_text(run, "fidelity"))
            missing = "fidelity";
        if (!missing)
            missing = LACKS(gm_passport_figures(result, run), of_figures);
    }
    return missing;
}

static gm_status check_form(const char *name, const json_t *result, gm_error *error)
{
    const bool steady = json_object_get(result, "cases"),
               cycle = json_object_get(result, "cycle");
    const char *missing = steady || cycle ? NULL : "cases";
    if (!json_object_get(result, "measured"))
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

static gm_status check_origin(const char *name, const json_t *result, const gm_map *map,
                              const char *guid, gm_error *error)
{
    const json_t *measured = json_object_get(result, "measured");
    const char *map_hash = gm_member_text(measured, "map_hash"),
               *measured_guid = gm_member_text(measured, "fmu_guid");
    if (strcmp(map_hash, map->content_hash) != 0)
        return gm_fail(
            error, GM_ERR_MODEL,
            "%s: was measured with another map (content hash %.16s, not %.16s)", name,
            *map_hash ? map_hash : "unknown", map->content_hash);
    if (strcmp(gm_member_text(measured, "description_sha256"), map->input_sha256) != 0)
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
                          const char *guid, json_t **document, gm_error *error)
{
    json_t *made = NULL;
    gm_status status = gm_document_read(result->name, result->json, &made, error);
    if (status == GM_OK)
        status = check_form(result->name, made, error);
    if (status == GM_OK)
        status = check_origin(result->name, made, map, guid, error);
    if (status == GM_OK)
        *document = made;
    else
        json_decref(made);
    return status;
}

gm_status gm_bake_check_result(const gm_bake_result *result, const gm_map *map,
                               const char *guid, gm_error *error)
{
    json_t *document = NULL;
    gm_status status = read_one(result, map, guid, &document, error);
    json_decref(document);
    return status;
}

/* ---- all results ---- */

static int count_steady(const gm_passport *passport)
{
    int n = 0;
    for (int i = 0; i < passport->n; i++)
        n += json_object_get(passport->result[i], "cases") != NULL;
    return n;
}

gm_status gm_passport_read(int n, const gm_bake_result *results, const gm_map *map,
                           const char *guid, gm_passport *passport, gm_error *error)
{
    gm_passport made = {.result = gm_calloc((size_t)n, sizeof *made.result)};
    gm_status status = GM_OK;
    if (!made.result)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the passport");
    for (; made.n < n && status == GM_OK; made.n += status == GM_OK)
        status = read_one(&results[made.n], map, guid, &made.result[made.n], error);
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
        json_decref(passport->result[i]);
    gm_free(passport->result);
    *passport = (gm_passport){0};
}
