/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/fmu_archive.h"

#include "base/alloc.h"

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

/* Larger than any component of ours by orders of magnitude, small against a disk. */
enum { MOST_ENTRIES = 10000 };
#define MOST_BYTES ((zip_uint64_t)512 * 1024 * 1024)

/* Does every part of the name stay below the folder? */
static bool is_inside(const char *name)
{
    if (name[0] == '/' || name[0] == '\0' || strchr(name, '\\') || strchr(name, ':'))
        return false;
    while (*name) {
        size_t n = strcspn(name, "/");
        if ((n == 2 && name[0] == '.' && name[1] == '.') || (n == 1 && name[0] == '.'))
            return false;
        name += n + (name[n] == '/');
    }
    return true;
}

/* Make the folders on the way to path, below the first `known` characters. */
static bool make_folders(char *path, size_t known)
{
    for (char *c = path + known + 1; *c; c++) {
        if (*c != '/')
            continue;
        *c = '\0';
        bool made = mkdir(path, 0700) == 0 || errno == EEXIST;
        *c = '/';
        if (!made)
            return false;
    }
    return true;
}

/* Copy an entry into a file; false when either fails or the size is not as announced. */
static bool copy_entry(zip_t *zip, zip_uint64_t index, zip_uint64_t size,
                       const char *path)
{
    char block[16384];
    zip_int64_t n = 0;
    zip_uint64_t total = 0;
    zip_file_t *from = zip_fopen_index(zip, index, 0);
    FILE *to = from ? fopen(path, "wbx") : NULL;
    bool good = to != NULL;
    while (good && (n = zip_fread(from, block, sizeof block)) > 0) {
        total += (zip_uint64_t)n;
        good = total <= size && fwrite(block, 1, (size_t)n, to) == (size_t)n;
    }
    good = good && n == 0 && total == size;
    if (to && fclose(to) != 0)
        good = false;
    if (from && zip_fclose(from) != 0) /* reports a wrong checksum */
        good = false;
    return good;
}

static gm_status unpack_entry(zip_t *zip, zip_uint64_t index, const char *archive,
                              const char *folder, zip_uint64_t *total, gm_error *error)
{
    char path[4096];
    zip_stat_t info;
    zip_uint8_t system;
    zip_uint32_t attributes;
    if (zip_stat_index(zip, index, 0, &info) != 0 || !(info.valid & ZIP_STAT_NAME) ||
        !(info.valid & ZIP_STAT_SIZE))
        return gm_fail(error, GM_ERR_FORMAT, "%s: an entry of the archive is damaged",
                       archive);
    bool is_link =
        zip_file_get_external_attributes(zip, index, 0, &system, &attributes) == 0 &&
        system == ZIP_OPSYS_UNIX && S_ISLNK((mode_t)(attributes >> 16));
    if (!is_inside(info.name) || is_link ||
        snprintf(path, sizeof path, "%s/%s", folder, info.name) >= (int)sizeof path)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the archive's entry %.200s would leave its folder", archive,
                       info.name);
    if (info.size > MOST_BYTES || (*total += info.size) > MOST_BYTES)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the archive unpacks to more than 512 MB", archive);
    if (!make_folders(path, strlen(folder)))
        return gm_fail(error, GM_ERR_IO, "%s: cannot be made: %s", path, strerror(errno));
    if (path[strlen(path) - 1] == '/' || copy_entry(zip, index, info.size, path))
        return GM_OK;
    return gm_fail(error, GM_ERR_FORMAT, "%s: the archive's entry %.200s is damaged",
                   archive, info.name);
}

static gm_status unpack_all(zip_t *zip, const char *archive, const char *folder,
                            gm_error *error)
{
    zip_int64_t n = zip_get_num_entries(zip, 0);
    zip_uint64_t total = 0;
    gm_status status = GM_OK;
    if (n > MOST_ENTRIES)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the archive has %lld entries", archive,
                       (long long)n);
    for (zip_int64_t i = 0; status == GM_OK && i < n; i++)
        status = unpack_entry(zip, (zip_uint64_t)i, archive, folder, &total, error);
    return status;
}

gm_status gm_fmu_unpack(const char *path, char folder[FMU_FOLDER_SIZE], gm_error *error)
{
    const char *base = getenv("TMPDIR");
    char made[FMU_FOLDER_SIZE];
    int code = 0;
    if (access(path, R_OK) != 0)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
    zip_t *zip = zip_open(path, ZIP_RDONLY, &code);
    if (!zip)
        return gm_fail(error, GM_ERR_FORMAT, "%s: is not an FMU: not a zip archive",
                       path);
    gm_status status = GM_OK;
    if (snprintf(made, sizeof made, "%s/gearmap-XXXXXX", base && *base ? base : "/tmp") >=
            (int)sizeof made ||
        !mkdtemp(made))
        status = gm_fail(error, GM_ERR_IO, "%s: no temporary folder can be made: %s",
                         made, strerror(errno));
    if (status == GM_OK) {
        status = unpack_all(zip, path, made, error);
        if (status == GM_OK)
            memcpy(folder, made, sizeof made);
        else
            gm_fmu_remove(made);
    }
    zip_discard(zip);
    return status;
}

enum { DEEPEST = 16 };

/* Remove what is in a folder, not following links. */
static void empty_folder(const char *folder, int depth)
{
    DIR *directory = opendir(folder);
    struct dirent *entry;
    char path[4096];
    struct stat info;
    while (directory && (entry = readdir(directory)) != NULL) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..") ||
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) >=
                (int)sizeof path ||
            lstat(path, &info) != 0)
            continue;
        if (!S_ISDIR(info.st_mode)) {
            (void)unlink(path);
        } else if (depth < DEEPEST) {
            empty_folder(path, depth + 1);
            (void)rmdir(path);
        }
    }
    if (directory)
        closedir(directory);
}

void gm_fmu_remove(const char *folder)
{
    empty_folder(folder, 0);
    (void)rmdir(folder);
}
