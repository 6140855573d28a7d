/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/place.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool gm_is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           c == '_';
}

void gm_make_identifier(const char *name, char identifier[GM_IDENTIFIER_SIZE])
{
    int n = 0;
    if (!gm_is_word(name[0]) || (name[0] >= '0' && name[0] <= '9'))
        n = snprintf(identifier, GM_IDENTIFIER_SIZE, "gearset%s", name[0] ? "_" : "");
    for (; *name && n < GM_IDENTIFIER_SIZE - 1; name++)
        identifier[n++] = gm_is_word(*name) ? *name : '_';
    identifier[n] = '\0';
}

/* A new file beside the target, with the rights of any new file; -1 when there cannot be
 * one. Leftovers of killed programs are passed by. */
static int create_part(gm_place *place)
{
    int file = -1;
    for (int i = 0; i < 100 && file < 0; i++) {
        if (snprintf(place->part, sizeof place->part, "%s.%ld-%d.part", place->target,
                     (long)getpid(), i) >= (int)sizeof place->part) {
            errno = ENAMETOOLONG;
            return -1;
        }
        file = open(place->part, O_CREAT | O_EXCL | O_WRONLY, 0666);
        if (file < 0 && errno != EEXIST)
            return -1;
    }
    return file;
}

static gm_status failed(const gm_place *place, gm_error *error)
{
    return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", place->target,
                   strerror(errno));
}

gm_status gm_place_reserve(const char *target, gm_place *place, gm_error *error)
{
    struct stat info;
    *place = (gm_place){.target = target};
    if (stat(target, &info) == 0 && !S_ISREG(info.st_mode))
        return gm_fail(error, GM_ERR_IO, "%s: is not a file that could be replaced",
                       target);
    int file = create_part(place);
    if (file < 0)
        return failed(place, error);
    place->reserved = true;
    int unknown = fstat(file, &info);
    (void)close(file);
    if (unknown)
        return failed(place, error);
    place->rights = info.st_mode & 0777;
    return GM_OK;
}

gm_status gm_place_put(gm_place *place, const gm_package *package, gm_error *error)
{
    gm_status status = gm_package_write(package, place->part, error);
    if (status != GM_OK)
        return status;
    /* the archive library replaces the file by one with rights of its own choice */
    if (chmod(place->part, place->rights) != 0 || rename(place->part, place->target) != 0)
        return failed(place, error);
    place->reserved = false;
    return GM_OK;
}

void gm_place_release(gm_place *place)
{
    if (place->reserved)
        (void)unlink(place->part);
    place->reserved = false;
}
