/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Which variants there are, and their names. A name is the file's without its ending;
 * where that is not unlike all others the folders before it are added one by one, so that
 * a name does not depend on the order of the list.
 */
#include "batch.h"

#include "base/alloc.h"
#include "plant/gm_rig_file.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char *gm_variant_state_name(gm_variant_state state)
{
    static const char *const names[] = {"waiting", "running", "done", "kept", "failed"};
    return names[state];
}

void gm_batch_clear(gm_batch *batch)
{
    for (int i = 0; i < batch->n; i++)
        gm_free(batch->variants[i].description);
    for (int i = 0; i < batch->n_passed_over; i++)
        gm_free(batch->passed_over[i]);
    gm_free(batch->variants);
    gm_free(batch->passed_over);
    *batch = (gm_batch){.n = 0};
}

static gm_status no_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "no memory for the list of variants");
}

/* ---- collecting ---- */

static gm_status add(gm_batch *batch, const char *path, gm_error *error)
{
    gm_variant *more =
        gm_resize(batch->variants, (size_t)batch->n + 1, sizeof *batch->variants);
    if (!more)
        return no_memory(error);
    batch->variants = more;
    more[batch->n] = (gm_variant){.description = gm_strdup(path)};
    if (!more[batch->n].description)
        return no_memory(error);
    batch->n++;
    return GM_OK;
}

static gm_status pass_over(gm_batch *batch, const char *path, gm_error *error)
{
    char **more = gm_resize(batch->passed_over, (size_t)batch->n_passed_over + 1,
                            sizeof *batch->passed_over);
    if (!more)
        return no_memory(error);
    batch->passed_over = more;
    more[batch->n_passed_over] = gm_strdup(path);
    if (!more[batch->n_passed_over])
        return no_memory(error);
    batch->n_passed_over++;
    return GM_OK;
}

static bool ends_with(const char *name, const char *ending)
{
    size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0;
}

/* A gearset has shafts, and a rig file is taken as well; a folder may hold other files in
 * YAML too, such as vehicles. What cannot be read is taken: its reduction says why. */
static bool has_shafts(const char *path)
{
    char line[256];
    bool found = false, begins = true;
    FILE *file = fopen(path, "r");
    if (!file)
        return true;
    while (!found && fgets(line, sizeof line, file)) {
        found = begins && strncmp(line, "shafts:", 7) == 0;
        begins = strchr(line, '\n') != NULL;
    }
    (void)fclose(file);
    return found;
}

static int is_yaml(const struct dirent *entry)
{
    return entry->d_name[0] != '.' &&
           (ends_with(entry->d_name, ".yaml") || ends_with(entry->d_name, ".yml"));
}

static gm_status add_entry(gm_batch *batch, const char *folder, const char *name,
                           gm_error *error)
{
    char path[GM_PATH_SIZE];
    struct stat info;
    const char *slash = ends_with(folder, "/") ? "" : "/";
    if (snprintf(path, sizeof path, "%s%s%s", folder, slash, name) >= (int)sizeof path)
        return gm_fail(error, GM_ERR_IO, "%s: the path is too long", folder);
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return GM_OK;
    bool taken = has_shafts(path) || gm_rig_file_is_one(path);
    return taken ? add(batch, path, error) : pass_over(batch, path, error);
}

static gm_status read_folder(const char *folder, gm_batch *batch, gm_error *error)
{
    struct dirent **entries;
    int n = scandir(folder, &entries, is_yaml, alphasort);
    if (n < 0)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read: %s", folder,
                       strerror(errno));
    gm_status status = GM_OK;
    for (int i = 0; i < n; i++) {
        if (status == GM_OK)
            status = add_entry(batch, folder, entries[i]->d_name, error);
        free(entries[i]); /* the C library's own */
    }
    free(entries);
    return status;
}

/* Blanks around a line and comments away. */
static char *trim(char *line)
{
    line[strcspn(line, "#\r\n")] = '\0';
    line += strspn(line, " \t");
    size_t n = strlen(line);
    while (n > 0 && strchr(" \t", line[n - 1]))
        line[--n] = '\0';
    return line;
}

static gm_status add_line(gm_batch *batch, const char *list, const char *line,
                          gm_error *error)
{
    char path[GM_PATH_SIZE];
    const char *slash = strrchr(list, '/');
    int before = line[0] == '/' || !slash ? 0 : (int)(slash + 1 - list);
    if (snprintf(path, sizeof path, "%.*s%s", before, list, line) >= (int)sizeof path)
        return gm_fail(error, GM_ERR_IO, "%s: a path in it is too long", list);
    return add(batch, path, error);
}

static gm_status read_list(const char *list, gm_batch *batch, gm_error *error)
{
    char line[GM_PATH_SIZE];
    FILE *file = fopen(list, "r");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", list,
                       strerror(errno));
    gm_status status = GM_OK;
    for (int n = 1; status == GM_OK && fgets(line, sizeof line, file); n++) {
        if (!strchr(line, '\n') && !feof(file))
            status =
                gm_fail(error, GM_ERR_FORMAT, "%s:%d: the line is too long", list, n);
        else if (trim(line)[0])
            status = add_line(batch, list, trim(line), error);
    }
    if (status == GM_OK && ferror(file))
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be read", list);
    (void)fclose(file);
    return status;
}

static void remove_repeated(gm_batch *batch)
{
    int kept = 0;
    for (int i = 0; i < batch->n; i++) {
        bool repeated = false;
        for (int k = 0; k < kept; k++)
            repeated |= gm_file_is_same(batch->variants[k].description,
                                        batch->variants[i].description);
        if (repeated)
            gm_free(batch->variants[i].description);
        else
            batch->variants[kept++] = batch->variants[i];
    }
    batch->n = kept;
}

/* ---- names ---- */

/* The last `parts` parts of the path, without the ending; what is not fit for a name of a
 * file or a cell of a table becomes "_". */
static void name_of(const char *path, int parts, char name[GM_BATCH_NAME])
{
    const char *begin = path + strlen(path), *dot = strrchr(path, '.');
    const char *last = strrchr(path, '/');
    const char *end = dot && dot > (last ? last + 1 : path) ? dot : begin;
    for (int found = 0; begin > path; begin--)
        if (begin[-1] == '/' && ++found == parts)
            break;
    int n = 0;
    for (const char *c = begin; c < end && n < GM_BATCH_NAME - 1; c++)
        name[n++] = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') ||
                            (*c >= '0' && *c <= '9') || *c == '-' || *c == '.'
                        ? *c
                        : '_';
    name[n] = '\0';
}

static bool is_taken(const gm_batch *batch, int i)
{
    for (int k = 0; k < batch->n; k++)
        if (k != i && strcmp(batch->variants[k].name, batch->variants[i].name) == 0)
            return true;
    return false;
}

/* Rounds: all that share a name get one more part of their path. */
static gm_status find_names(gm_batch *batch, gm_error *error)
{
    enum { PARTS_MAX = 32 };
    int *parts = gm_calloc((size_t)batch->n, sizeof *parts);
    bool *taken = gm_calloc((size_t)batch->n, sizeof *taken);
    bool clear = false;
    for (int round = 0; parts && taken && !clear && round < PARTS_MAX; round++) {
        for (int i = 0; i < batch->n; i++)
            name_of(batch->variants[i].description, 1 + parts[i],
                    batch->variants[i].name);
        clear = true;
        for (int i = 0; i < batch->n; i++)
            taken[i] = is_taken(batch, i);
        for (int i = 0; i < batch->n; i++) {
            parts[i] += taken[i];
            clear = clear && !taken[i];
        }
    }
    bool memory = parts && taken;
    gm_free(parts);
    gm_free(taken);
    if (!memory)
        return no_memory(error);
    return clear ? GM_OK
                 : gm_fail(error, GM_ERR_FORMAT,
                           "the names of the variants cannot be told apart");
}

gm_status gm_batch_path(const gm_batch *batch, const gm_variant *variant,
                        const char *ending, char path[GM_PATH_SIZE], gm_error *error)
{
    if (snprintf(path, GM_PATH_SIZE, "%s/%s%s", batch->folder, variant->name, ending) <
        GM_PATH_SIZE)
        return GM_OK;
    return gm_fail(error, GM_ERR_IO, "%.60s...: the path is too long", batch->folder);
}

gm_status gm_batch_find(const char *source, gm_batch *batch, gm_error *error)
{
    struct stat info;
    gm_status status = stat(source, &info) == 0 && S_ISDIR(info.st_mode)
                           ? read_folder(source, batch, error)
                           : read_list(source, batch, error);
    if (status == GM_OK && batch->n == 0)
        status = gm_fail(error, GM_ERR_FORMAT, "%s: names no description of a gearset",
                         source);
    if (status != GM_OK)
        return status;
    remove_repeated(batch);
    return find_names(batch, error);
}
