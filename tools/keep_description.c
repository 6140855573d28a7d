/* SPDX-License-Identifier: BSD-2-Clause */
#include "keep_description.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "map/gm_map_file.h"

#include <stdio.h>
#include <string.h>

enum { SIZE_MAX_READ = 4 << 20 }; /* of a description: docs/description.md */

/* The file's bytes; 0 when it cannot be read as a whole. */
static size_t read_file(const char *path, char *text)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    size_t n = fread(text, 1, SIZE_MAX_READ, file);
    int failed = ferror(file);
    (void)fclose(file);
    return failed ? 0 : n;
}

static gm_status hash(const char *text, size_t size, char sum[GM_SHA256_TEXT],
                      gm_error *error)
{
    gm_sha256 *running = gm_sha256_create();
    if (!running)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_sha256_bytes(running, text, size);
    gm_sha256_finish(running, sum);
    gm_sha256_destroy(running);
    return GM_OK;
}

gm_status gm_keep_description(const gm_description *description, const char *map,
                              gm_error *error)
{
    char sum[GM_SHA256_TEXT];
    char *text = gm_calloc(SIZE_MAX_READ, 1);
    if (!text)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    size_t size = read_file(description->file, text);
    gm_status status = hash(text, size, sum, error);
    if (status == GM_OK && strcmp(sum, description->sha256) == 0)
        status = gm_map_put_description(map, text, size, error);
    else if (status == GM_OK)
        fprintf(stderr,
                "gearmap: note: %s has changed meanwhile; %s does not keep its text\n",
                description->file, map);
    gm_free(text);
    return status;
}
