/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/package.h"

#include "base/alloc.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zip.h>

gm_status gm_package_add(gm_package *package, const char *name, gm_buffer *content,
                         gm_error *error)
{
    gm_buffer moved = *content;
    *content = (gm_buffer){0};
    char *copy = gm_strdup(name);
    if (package->n == package->room && copy) {
        int room = 2 * package->room + 32;
        gm_package_file *files =
            gm_resize(package->files, (size_t)room, sizeof *package->files);
        if (files) {
            package->files = files;
            package->room = room;
        }
    }
    if (!copy || moved.failed || package->n == package->room) {
        gm_free(copy);
        gm_buffer_clear(&moved);
        return gm_fail(error, GM_ERR_MEMORY, "no memory for %s", name);
    }
    package->files[package->n++] = (gm_package_file){copy, moved};
    return GM_OK;
}

gm_status gm_package_add_file(gm_package *package, const char *name, const char *path,
                              gm_error *error)
{
    FILE *file = fopen(path, "rb");
    gm_buffer content = {0};
    char block[8192];
    size_t n;
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", path,
                       strerror(errno));
    while ((n = fread(block, 1, sizeof block, file)) > 0)
        gm_buffer_bytes(&content, block, n);
    int bad = ferror(file);
    fclose(file);
    if (bad) {
        gm_buffer_clear(&content);
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read", path);
    }
    return gm_package_add(package, name, &content, error);
}

static bool has_ending(const char *name, const char *ending)
{
    size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0;
}

static gm_status add_if_source(gm_package *package, const char *prefix,
                               const char *folder, const char *name, int *found,
                               gm_error *error)
{
    char path[4096], entry[512];
    struct stat info;
    if (!has_ending(name, ".c") && !has_ending(name, ".h") && !has_ending(name, ".def"))
        return GM_OK;
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path ||
        snprintf(entry, sizeof entry, "%s%s", prefix, name) >= (int)sizeof entry)
        return gm_fail(error, GM_ERR_IO, "%s: the path is too long", folder);
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode))
        return GM_OK;
    ++*found;
    return gm_package_add_file(package, entry, path, error);
}

gm_status gm_package_add_folder(gm_package *package, const char *prefix,
                                const char *folder, gm_error *error)
{
    DIR *directory = opendir(folder);
    struct dirent *entry;
    gm_status status = GM_OK;
    int found = 0;
    if (!directory)
        return gm_fail(
            error, GM_ERR_IO,
            "%s: the folder with the component's C sources cannot be opened: %s", folder,
            strerror(errno));
    while (status == GM_OK && (entry = readdir(directory)) != NULL)
        status = add_if_source(package, prefix, folder, entry->d_name, &found, error);
    closedir(directory);
    if (status == GM_OK && found == 0)
        return gm_fail(error, GM_ERR_IO, "%s: there are no C sources in this folder",
                       folder);
    return status;
}

static int compare(const void *a, const void *b)
{
    return strcmp(((const gm_package_file *)a)->name, ((const gm_package_file *)b)->name);
}

void gm_package_sort(gm_package *package)
{
    if (package->n > 1)
        qsort(package->files, (size_t)package->n, sizeof *package->files, compare);
}

static gm_status write_file(const char *path, const gm_buffer *content, gm_error *error)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", path,
                       strerror(errno));
    size_t n = content->size ? fwrite(content->data, 1, content->size, file) : 0;
    if (fclose(file) != 0 || n != content->size)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", path,
                       strerror(errno));
    return GM_OK;
}

gm_status gm_package_extract(const gm_package *package, const char *prefix,
                             const char *folder, gm_error *error)
{
    char path[4096];
    gm_status status = GM_OK;
    size_t skip = strlen(prefix);
    for (int i = 0; status == GM_OK && i < package->n; i++) {
        const gm_package_file *file = &package->files[i];
        if (strncmp(file->name, prefix, skip) != 0)
            continue;
        if (snprintf(path, sizeof path, "%s/%s", folder, file->name + skip) >=
            (int)sizeof path)
            return gm_fail(error, GM_ERR_IO, "%s: the path is too long", folder);
        status = write_file(path, &file->content, error);
    }
    return status;
}

/* Year 0 of zip's clock: 1980-01-01 00:00. */
enum { ZIP_DATE = (1 << 5) | 1, ZIP_TIME = 0 };

/* Nothing of this machine and moment in an entry. */
static bool set_entry(zip_t *zip, zip_int64_t index)
{
    zip_uint64_t i = (zip_uint64_t)index;
    return zip_set_file_compression(zip, i, ZIP_CM_DEFLATE, 9) == 0 &&
           zip_file_set_dostime(zip, i, ZIP_TIME, ZIP_DATE, 0) == 0 &&
           zip_file_set_external_attributes(zip, i, 0, ZIP_OPSYS_UNIX, 0100644u << 16) ==
               0;
}

static zip_source_t *source_of(zip_t *zip, const gm_buffer *content)
{
    return zip_source_buffer(zip, content->data ? content->data : "", content->size, 0);
}

static bool add_entry(zip_t *zip, const gm_package_file *file)
{
    zip_source_t *source = source_of(zip, &file->content);
    if (!source)
        return false;
    zip_int64_t index = zip_file_add(zip, file->name, source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(source);
        return false;
    }
    return set_entry(zip, index);
}

static bool replace_entry(zip_t *zip, const char *name, const gm_buffer *content)
{
    zip_int64_t index = zip_name_locate(zip, name, 0);
    zip_source_t *source = index < 0 || content->failed ? NULL : source_of(zip, content);
    if (!source)
        return false;
    if (zip_file_replace(zip, (zip_uint64_t)index, source, ZIP_FL_ENC_UTF_8) < 0) {
        zip_source_free(source);
        return false;
    }
    return set_entry(zip, index);
}

/* Close with what was changed; on failure nothing was. */
static gm_status close_archive(zip_t *zip, bool good, const char *path, gm_error *error)
{
    if (good && zip_close(zip) == 0)
        return GM_OK;
    gm_status status = gm_fail(error, GM_ERR_IO, "%s: the archive cannot be written%s%s",
                               path, zip ? ": " : "", zip ? zip_strerror(zip) : "");
    if (zip)
        zip_discard(zip);
    return status;
}

gm_status gm_package_write(const gm_package *package, const char *path, gm_error *error)
{
    int code;
    zip_t *zip = zip_open(path, ZIP_CREATE | ZIP_TRUNCATE, &code);
    bool good = zip != NULL;
    for (int i = 0; good && i < package->n; i++)
        good = add_entry(zip, &package->files[i]);
    return close_archive(zip, good, path, error);
}

gm_status gm_package_replace(const char *path, int n, const char *const *names,
                             gm_buffer *const *contents, gm_error *error)
{
    struct stat info;
    int code;
    bool known = stat(path, &info) == 0;
    zip_t *zip = zip_open(path, 0, &code);
    bool good = known && zip;
    for (int i = 0; good && i < n; i++)
        good = replace_entry(zip, names[i], contents[i]);
    gm_status status = close_archive(zip, good, path, error);
    for (int i = 0; i < n; i++)
        gm_buffer_clear(contents[i]);
    /* the archive library replaces the file by one with rights of its own choice */
    if (status == GM_OK && chmod(path, info.st_mode & 0777) != 0)
        status =
            gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
    return status;
}

void gm_package_clear(gm_package *package)
{
    for (int i = 0; i < package->n; i++) {
        gm_free(package->files[i].name);
        gm_buffer_clear(&package->files[i].content);
    }
    gm_free(package->files);
    *package = (gm_package){0};
}
