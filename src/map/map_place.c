/* SPDX-License-Identifier: BSD-2-Clause */
#include "map/map_place.h"

#include "base/alloc.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define JOURNAL_SUFFIX ".part"

/* The folder a path lies in; NULL when there is no memory. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash)
        return gm_strdup(".");
    char *folder = gm_strdup(path);
    if (folder)
        folder[slash == path ? 1 : slash - path] = '\0';
    return folder;
}

static gm_status check_folder(const char *path, const char *folder, gm_error *error)
{
    struct stat info;
    if (stat(folder, &info) != 0)
        return gm_fail(error, GM_ERR_IO, "%s cannot be written: %s: %s", path, folder,
                       strerror(errno));
    if (!S_ISDIR(info.st_mode))
        return gm_fail(error, GM_ERR_IO, "%s cannot be written: %s is not a folder", path,
                       folder);
    if (access(folder, W_OK | X_OK) != 0)
        return gm_fail(error, GM_ERR_IO, "%s cannot be written: folder %s: %s", path,
                       folder, strerror(errno));
    return GM_OK;
}

gm_status gm_place_check(const char *path, gm_error *error)
{
    struct stat info;
    if (path[0] == '\0')
        return gm_fail(error, GM_ERR_IO, "the map's file has no name");
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return gm_fail(error, GM_ERR_IO, "%s cannot be written: it is %s", path,
                       S_ISDIR(info.st_mode) ? "a folder" : "not a file");
    char *folder = folder_of(path);
    if (!folder)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to write %s", path);
    gm_status status = check_folder(path, folder, error);
    gm_free(folder);
    return status;
}

char *gm_place_name(const char *path, const char *suffix)
{
    size_t size = strlen(path) + strlen(suffix) + 1;
    char *joined = gm_calloc(size, 1);
    if (joined)
        (void)snprintf(joined, size, "%s%s", path, suffix);
    return joined;
}

char *gm_place_journal(const char *path)
{
    return gm_place_name(path, JOURNAL_SUFFIX);
}

bool gm_place_exists(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0;
}

void gm_place_remove(const char *database)
{
    static const char *const suffixes[] = {"", "-journal", "-wal", "-shm"};
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++) {
        char *name = gm_place_name(database, suffixes[i]);
        if (name)
            (void)unlink(name);
        gm_free(name);
    }
}

static bool write_all(int descriptor, const unsigned char *bytes, size_t size)
{
    while (size > 0) {
        ssize_t n = write(descriptor, bytes, size);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        bytes += n;
        size -= (size_t)n;
    }
    return fsync(descriptor) == 0;
}

gm_status gm_place_write(const char *path, const void *bytes, size_t size,
                         gm_error *error)
{
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    bool written = descriptor >= 0 && write_all(descriptor, bytes, size);
    int why = errno;
    if (descriptor >= 0 && close(descriptor) != 0 && written) {
        why = errno;
        written = false;
    }
    if (written)
        return GM_OK;
    return gm_fail(error, GM_ERR_IO, "%s cannot be written: %s", path, strerror(why));
}

gm_status gm_place_rename(const char *from, const char *to, gm_error *error)
{
    if (rename(from, to) != 0)
        return gm_fail(error, GM_ERR_IO, "%s cannot be renamed to %s: %s", from, to,
                       strerror(errno));
    char *folder = folder_of(to);
    int descriptor = folder ? open(folder, O_RDONLY) : -1;
    if (descriptor >= 0) { /* the map is whole either way; this only keeps its name */
        (void)fsync(descriptor);
        (void)close(descriptor);
    }
    gm_free(folder);
    return GM_OK;
}
