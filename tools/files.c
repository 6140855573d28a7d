/* SPDX-License-Identifier: BSD-2-Clause */
#include "files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static gm_status check_target(const char *output, const char *input, gm_error *error)
{
    struct stat out, in;
    if (stat(output, &out) != 0)
        return GM_OK;
    if (S_ISDIR(out.st_mode))
        return gm_fail(error, GM_ERR_IO, "%s: cannot be written: it is a folder", output);
    if (!S_ISREG(out.st_mode))
        return gm_fail(error, GM_ERR_IO,
                       "%s: cannot be written: it is not a regular file", output);
    if (stat(input, &in) == 0 && in.st_dev == out.st_dev && in.st_ino == out.st_ino)
        return gm_fail(error, GM_ERR_IO,
                       "%s: is the input; the output needs another name", output);
    return GM_OK;
}

/* Permissions alone do not tell (superuser, read-only file systems): create a file. */
gm_status gm_file_check_output(const char *output, const char *input, gm_error *error)
{
    char trial[GM_PATH_SIZE];
    gm_status status = check_target(output, input, error);
    if (status != GM_OK)
        return status;
    int n = snprintf(trial, sizeof trial, "%s.%ld", output, (long)getpid());
    if (n < 0 || n >= (int)sizeof trial)
        return gm_fail(error, GM_ERR_IO,
                       "%.60s...: cannot be written: the name is too long", output);
    int file = open(trial, O_WRONLY | O_CREAT | O_EXCL, 0600);
    if (file < 0)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", output,
                       strerror(errno));
    (void)close(file);
    (void)unlink(trial);
    return GM_OK;
}

/* Where path is: device and number of its folder, and its last name. A path without a
 * last name, such as "a/", names no file. */
static bool locate(const char *path, struct stat *folder, const char **name)
{
    char parent[GM_PATH_SIZE];
    const char *slash = strrchr(path, '/');
    *name = slash ? slash + 1 : path;
    int n = snprintf(parent, sizeof parent, "%.*s.", (int)(*name - path), path);
    return n < (int)sizeof parent && **name && stat(parent, folder) == 0;
}

bool gm_file_is_same(const char *a, const char *b)
{
    struct stat in_a, in_b;
    const char *name_a, *name_b;
    if (stat(a, &in_a) == 0 && stat(b, &in_b) == 0)
        return in_a.st_dev == in_b.st_dev && in_a.st_ino == in_b.st_ino;
    return locate(a, &in_a, &name_a) && locate(b, &in_b, &name_b) &&
           in_a.st_dev == in_b.st_dev && in_a.st_ino == in_b.st_ino &&
           strcmp(name_a, name_b) == 0;
}

gm_status gm_file_own_name(const char *path, char name[GM_PATH_SIZE], gm_error *error)
{
    int n = snprintf(name, GM_PATH_SIZE, "%s.%ld.new", path, (long)getpid());
    if (n > 0 && n < GM_PATH_SIZE)
        return GM_OK;
    return gm_fail(error, GM_ERR_IO, "%.60s...: cannot be written: the name is too long",
                   path);
}

long gm_file_size(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 ? (long)s.st_size : -1;
}

static bool is_share(const char *path)
{
    char probe[GM_PATH_SIZE];
    int n = snprintf(probe, sizeof probe, "%s/core/gm_reduced.h", path);
    return n > 0 && n < (int)sizeof probe && access(probe, R_OK) == 0;
}

/* The folder of the running program, without the last slash; empty when unknown. */
static void program_folder(char *folder, size_t size)
{
    ssize_t n = readlink("/proc/self/exe", folder, size - 1);
    folder[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = '\0';
}

gm_status gm_file_find_share(char path[GM_PATH_SIZE], gm_error *error)
{
    static const char *const places[] = {"/share/gearmap", "/../share/gearmap"};
    const char *given = getenv("GEARMAP_SHARE");
    if (given && *given != '\0') {
        (void)snprintf(path, GM_PATH_SIZE, "%s", given);
        if (is_share(path))
            return GM_OK;
        return gm_fail(error, GM_ERR_TOOL,
                       "%s: GEARMAP_SHARE names no folder with core/gm_reduced.h", given);
    }
    char folder[GM_PATH_SIZE - 32];
    program_folder(folder, sizeof folder);
    for (int i = 0; i < 2; i++) {
        (void)snprintf(path, GM_PATH_SIZE, "%s%s", folder, places[i]);
        if (is_share(path))
            return GM_OK;
    }
    return gm_fail(
        error, GM_ERR_TOOL,
        "the sources to bake are neither in %s%s nor in %s%s (GEARMAP_SHARE can "
        "name their folder)",
        folder, places[0], folder, places[1]);
}
