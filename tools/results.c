/* SPDX-License-Identifier: BSD-2-Clause */
#include "results.h"

#include "base/alloc.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define BLOCK 16384

static void clear_one(gm_bake_result *result)
{
    gm_free((void *)result->name);
    gm_free((void *)result->json);
    *result = (gm_bake_result){NULL, NULL};
}

void gm_results_clear(gm_results *results)
{
    for (int i = 0; i < results->n; i++)
        clear_one(&results->list[i]);
    gm_free(results->list);
    *results = (gm_results){0, NULL};
}

static gm_status no_memory(const char *name, gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "%s: no memory to read it", name);
}

/* One more result; json is taken over, also on failure. */
static gm_status add(gm_results *results, const char *name, char *json, gm_error *error)
{
    gm_bake_result *list =
        gm_resize(results->list, (size_t)results->n + 1, sizeof *results->list);
    if (list)
        results->list = list;
    char *copy = list ? gm_strdup(name) : NULL;
    if (!copy) {
        gm_free(json);
        return no_memory(name, error);
    }
    results->list[results->n++] = (gm_bake_result){copy, json};
    return GM_OK;
}

/* ---- from files ---- */

static gm_status read_open_file(FILE *file, const char *name, char **text,
                                gm_error *error)
{
    char *read = NULL;
    size_t size = 0, n = BLOCK;
    while (n == BLOCK) {
        char *longer = gm_resize(read, size + BLOCK + 1, 1);
        if (!longer) {
            gm_free(read);
            return no_memory(name, error);
        }
        read = longer;
        n = fread(read + size, 1, BLOCK, file);
        size += n;
    }
    read[size] = '\0';
    if (!ferror(file) && strlen(read) == size) {
        *text = read;
        return GM_OK;
    }
    gm_free(read);
    return ferror(file) ? gm_fail(error, GM_ERR_IO, "%s: cannot be read: %s", name,
                                  strerror(errno))
                        : gm_fail(error, GM_ERR_FORMAT, "%s: is no text", name);
}

static gm_status add_file(gm_results *results, const char *name, gm_error *error)
{
    char *text = NULL;
    FILE *file = fopen(name, "rb");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read: %s", name, strerror(errno));
    gm_status status = read_open_file(file, name, &text, error);
    fclose(file);
    return status == GM_OK ? add(results, name, text, error) : status;
}

gm_status gm_results_read(const char *names, gm_results *results, gm_error *error)
{
    gm_results made = {0, NULL};
    gm_status status = GM_OK;
    char *list = gm_strdup(names), *rest = list;
    if (!list)
        return no_memory(names, error);
    for (char *name = strtok_r(list, ",", &rest); name && status == GM_OK;
         name = strtok_r(NULL, ",", &rest))
        status = add_file(&made, name, error);
    gm_free(list);
    if (status == GM_OK)
        *results = made;
    else
        gm_results_clear(&made);
    return status;
}

/* ---- from a map ---- */

gm_status gm_results_of_map(const char *path, gm_results *results, gm_error *error)
{
    gm_results made = {0, NULL};
    char **texts = NULL;
    int n = 0;
    gm_status status = gm_map_get_results(path, &n, &texts, error);
    for (int i = 0; i < n && status == GM_OK; i++) {
        status = add(&made, path, texts[i], error);
        texts[i] = NULL;
    }
    gm_map_results_free(n, texts);
    if (status == GM_OK)
        *results = made;
    else
        gm_results_clear(&made);
    return status;
}

gm_status gm_results_keep_fitting(gm_results *results, const gm_map *map,
                                  const char *guid, gm_error *error)
{
    int kept = 0;
    for (int i = 0; i < results->n; i++) {
        gm_bake_result *result = &results->list[i];
        gm_status status = gm_bake_check_result(result, map, guid, error);
        if (status == GM_ERR_MODEL) {
            fprintf(stderr, "gearmap: note: a result is left out of the passport, %s\n",
                    error->message);
            clear_one(result);
        } else if (status != GM_OK) {
            return status;
        } else {
            const gm_bake_result fits = *result;
            *result = (gm_bake_result){NULL, NULL};
            results->list[kept++] = fits;
        }
    }
    results->n = kept;
    return GM_OK;
}
