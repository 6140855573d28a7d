/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An FMI 2.0 FMU from a map: tables, model description, documentation, the component's
 * sources as they stand, and a library compiled from exactly these sources.
 *
 *   binaries/linux64/<name>.so   documentation/index.html, licenses/license.txt
 *   modelDescription.xml         model.png   sources/   extra/gearmap/<name>.map
 *   extra/gearmap/passport.json
 *
 * The GUID is a SHA-256 over the description and the tables (with an empty GUID in both),
 * in the shape of a UUID. So what is measured on the FMU can be put into it afterwards.
 */
#include "bake/gm_bake.h"

#include "bake/compile.h"
#include "bake/model_description.h"
#include "bake/package.h"
#include "bake/papers.h"
#include "bake/picture.h"
#include "bake/place.h"
#include "bake/speed_in.h"
#include "bake/tables.h"
#include "base/alloc.h"
#include "base/sha256.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What the steps of one bake share. */
typedef struct job {
    const gm_map *map;
    gm_reduced_map reduced; /* points into the view */
    gm_speed_in speed_in;
    const gm_bake_options *options;
    gm_compiler compiler;
    gm_package package;
    gm_passport passport;
    char identifier[GM_IDENTIFIER_SIZE];
    char guid[48];
    long library_size;
    char library_sha256[GM_SHA256_TEXT];
    gm_error *error;
} job;

/* Names of paths become parts of variable names and of C. */
static gm_status check_names(const job *j)
{
    for (int p = 0; p < j->map->n_paths; p++) {
        const char *name = j->map->paths[p].name;
        bool good = name[0] >= 'a' && name[0] <= 'z';
        for (const char *c = name; *c; c++)
            good = good && gm_is_word(*c);
        if (!good)
            return gm_fail(j->error, GM_ERR_FORMAT,
                           "the map's path name \"%s\" is not a lower-case word", name);
        if (!strcmp(name, "output"))
            return gm_fail(j->error, GM_ERR_FORMAT,
                           "a path of the map is named output, like the output flange");
    }
    return GM_OK;
}

static gm_status add_sources(job *j)
{
    static const char *const folder[] = {"core", "fmu", "fmi2"};
    char path[4096];
    gm_status status = GM_OK;
    if (!j->options->share)
        return gm_fail(j->error, GM_ERR_ARGUMENT,
                       "the folder with the component's sources is not known");
    for (int i = 0; status == GM_OK && i < 3; i++) {
        if (snprintf(path, sizeof path, "%s/%s", j->options->share, folder[i]) >=
            (int)sizeof path)
            return gm_fail(j->error, GM_ERR_IO, "%s: the path is too long",
                           j->options->share);
        status = gm_package_add_folder(&j->package, "sources/", path, j->error);
    }
    if (status != GM_OK)
        return status;
    snprintf(path, sizeof path, "%s/LICENSE", j->options->share);
    return gm_package_add_file(&j->package, "documentation/licenses/license.txt", path,
                               j->error);
}

/* Names of the C files in the package, sorted, pointing into it; NULL: no memory. */
static const char **list_sources(const gm_package *package, int *n)
{
    const char **names = gm_calloc((size_t)package->n, sizeof *names);
    *n = 0;
    for (int i = 0; names && i < package->n; i++) {
        const char *name = package->files[i].name;
        size_t length = strlen(name);
        if (!strncmp(name, "sources/", 8) && !strcmp(name + length - 2, ".c"))
            names[(*n)++] = name + 8;
    }
    return names;
}

static gm_status describe(const job *j, gm_buffer *buffer)
{
    int n;
    const char **sources = list_sources(&j->package, &n);
    if (!sources)
        return gm_fail(j->error, GM_ERR_MEMORY, "no memory to list the sources");
    gm_description_options options = {j->identifier, j->guid, j->speed_in, n, sources};
    gm_status status = gm_model_description_write(j->map, &options, buffer, j->error);
    gm_free(sources);
    return status;
}

static gm_status make_texts(const job *j, gm_buffer *description, gm_buffer *tables)
{
    gm_status status = describe(j, description);
    if (status == GM_OK)
        status = gm_tables_write(j->map, &j->reduced, j->guid, tables, j->error);
    return status;
}

/* {8-4-4-4-12} of the first 32 hexadecimal digits. */
static gm_status make_guid(job *j)
{
    gm_buffer description = {0}, tables = {0};
    char hash[GM_SHA256_TEXT];
    gm_sha256 *sum = gm_sha256_create();
    gm_status status = sum ? make_texts(j, &description, &tables)
                           : gm_fail(j->error, GM_ERR_MEMORY, "no memory for a hash");
    if (status == GM_OK) {
        gm_sha256_text(sum, description.data);
        gm_sha256_text(sum, tables.data);
        gm_sha256_finish(sum, hash);
        snprintf(j->guid, sizeof j->guid, "{%.8s-%.4s-%.4s-%.4s-%.12s}", hash, hash + 8,
                 hash + 12, hash + 16, hash + 20);
    }
    gm_sha256_destroy(sum);
    gm_buffer_clear(&description);
    gm_buffer_clear(&tables);
    return status;
}

static void summarise(const job *j, gm_bake_summary *summary)
{
    *summary = (gm_bake_summary){.library_size = j->library_size,
                                 .interpolation = j->options->interpolation,
                                 .speed_in = j->speed_in};
    snprintf(summary->compiler, sizeof summary->compiler, "%.255s", j->compiler.path);
    snprintf(summary->guid, sizeof summary->guid, "%s", j->guid);
    snprintf(summary->library_sha256, sizeof summary->library_sha256, "%s",
             j->library_sha256);
}

/* The library is there: the passport names its hash. */
static gm_status add_papers(job *j)
{
    gm_bake_summary summary;
    summarise(j, &summary);
    gm_papers papers = gm_papers_write(j->map, &summary, &j->passport);
    gm_status status =
        gm_package_add(&j->package, GM_PASSPORT, &papers.passport, j->error);
    if (status == GM_OK)
        status = gm_package_add(&j->package, GM_DOCUMENTATION, &papers.page, j->error);
    gm_buffer_clear(&papers.passport);
    gm_buffer_clear(&papers.page);
    gm_package_sort(&j->package);
    return status;
}

static gm_status add_picture(job *j)
{
    gm_buffer picture = {0};
    gm_status status = gm_picture_write(j->map, &j->reduced, &picture, j->error);
    if (status == GM_OK)
        status = gm_package_add(&j->package, "model.png", &picture, j->error);
    gm_buffer_clear(&picture);
    return status;
}

static gm_status add_map(job *j)
{
    char name[GM_IDENTIFIER_SIZE + 32];
    unsigned char *bytes = NULL;
    size_t size = 0;
    gm_buffer file = {0};
    gm_status status = gm_map_to_bytes(j->map, &bytes, &size, j->error);
    if (status != GM_OK)
        return status;
    gm_buffer_bytes(&file, bytes, size);
    gm_free(bytes);
    snprintf(name, sizeof name, "extra/gearmap/%s.map", j->identifier);
    return gm_package_add(&j->package, name, &file, j->error);
}

static gm_status add_texts(job *j)
{
    gm_buffer description = {0}, tables = {0};
    gm_status status = make_texts(j, &description, &tables);
    if (status == GM_OK)
        status =
            gm_package_add(&j->package, "modelDescription.xml", &description, j->error);
    if (status == GM_OK)
        status = gm_package_add(&j->package, "sources/gm_tables.h", &tables, j->error);
    gm_buffer_clear(&description);
    gm_buffer_clear(&tables);
    gm_package_sort(&j->package);
    return status;
}

static void remove_folder(const char *folder)
{
    DIR *directory = opendir(folder);
    struct dirent *entry;
    char path[4096];
    while (directory && (entry = readdir(directory)) != NULL)
        if (snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) <
            (int)sizeof path)
            (void)unlink(path); /* "." and ".." are refused by the system */
    if (directory)
        closedir(directory);
    (void)rmdir(folder);
}

static gm_status compile_in(job *j, const char *folder)
{
    char library[GM_IDENTIFIER_SIZE + 8], path[4096], entry[160];
    int n;
    gm_status status = gm_package_extract(&j->package, "sources/", folder, j->error);
    if (status != GM_OK)
        return status;
    const char **sources = list_sources(&j->package, &n);
    if (!sources)
        return gm_fail(j->error, GM_ERR_MEMORY, "no memory to list the sources");
    snprintf(library, sizeof library, "%s" GM_LIBRARY_ENDING, j->identifier);
    status = gm_compile(&j->compiler, folder, n, sources, library, j->error);
    gm_free(sources);
    snprintf(path, sizeof path, "%s/%s", folder, library);
    snprintf(entry, sizeof entry, "binaries/" GM_FMI2_PLATFORM "/%s", library);
    if (status == GM_OK)
        status = gm_sha256_file(path, j->library_sha256, j->error);
    if (status == GM_OK)
        status = gm_package_add_file(&j->package, entry, path, j->error);
    if (status == GM_OK)
        j->library_size = (long)j->package.files[j->package.n - 1].content.size;
    return status;
}

static gm_status add_library(job *j)
{
    const char *base = getenv("TMPDIR");
    char folder[2048];
    if (snprintf(folder, sizeof folder, "%s/gearmap-XXXXXX",
                 base && *base ? base : "/tmp") >= (int)sizeof folder ||
        !mkdtemp(folder))
        return gm_fail(j->error, GM_ERR_IO, "%s: no temporary folder can be made: %s",
                       folder, strerror(errno));
    gm_status status = compile_in(j, folder);
    remove_folder(folder);
    gm_package_sort(&j->package);
    return status;
}

static gm_status begin_package(job *j)
{
    gm_status status = check_names(j);
    if (status == GM_OK)
        status = add_sources(j);
    gm_package_sort(&j->package);
    return status == GM_OK ? make_guid(j) : status;
}

static gm_status build_package(job *j)
{
    gm_status status = begin_package(j);
    if (status == GM_OK)
        status = gm_passport_read(j->options->n_results, j->options->results, j->map,
                                  j->guid, &j->passport, j->error);
    if (status == GM_OK)
        status = add_texts(j);
    if (status == GM_OK)
        status = add_picture(j);
    if (status == GM_OK)
        status = add_map(j);
    if (status == GM_OK)
        status = add_library(j);
    return status == GM_OK ? add_papers(j) : status;
}

/* The tables as they will be baked. */
static gm_status make_view(job *j, gm_map_view **view)
{
    gm_status status = gm_map_view_create(j->map, view, j->error);
    if (status != GM_OK)
        return status;
    if (j->options->interpolation == GM_INTERPOLATION_MONOTONE)
        gm_map_view_make_monotone(*view);
    j->reduced = *gm_map_view_reduced(*view);
    return gm_speed_in_read(j->map, j->options->speed_in, &j->reduced, &j->speed_in,
                            j->error);
}

static void end_job(job *j, gm_map_view *view)
{
    gm_map_view_destroy(view);
    gm_passport_clear(&j->passport);
    gm_package_clear(&j->package);
}

gm_status gm_bake_fmu2(const gm_map *map, const gm_bake_options *options,
                       const char *path, gm_bake_summary *summary, gm_error *error)
{
    job j = {.map = map, .options = options, .error = error};
    gm_map_view *view = NULL;
    struct stat info;
    gm_place place;
    gm_make_identifier(map->name, j.identifier);
    gm_status status = gm_place_reserve(path, &place, error);
    if (status == GM_OK)
        status = gm_compiler_find(options->compiler, &j.compiler, error);
    if (status == GM_OK)
        status = make_view(&j, &view);
    if (status == GM_OK)
        status = build_package(&j);
    if (status == GM_OK)
        status = gm_place_put(&place, &j.package, error);
    gm_place_release(&place);
    if (status == GM_OK && summary) {
        summarise(&j, summary);
        summary->file_size = stat(path, &info) == 0 ? (long)info.st_size : 0;
    }
    end_job(&j, view);
    return status;
}

gm_status gm_bake_guid(const gm_map *map, const gm_bake_options *options, char guid[64],
                       gm_error *error)
{
    job j = {.map = map, .options = options, .error = error};
    gm_map_view *view = NULL;
    gm_make_identifier(map->name, j.identifier);
    gm_status status = make_view(&j, &view);
    if (status == GM_OK)
        status = begin_package(&j);
    if (status == GM_OK)
        snprintf(guid, 64, "%s", j.guid);
    end_job(&j, view);
    return status;
}
