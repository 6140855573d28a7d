/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From a file to its tree: bytes, that they are text, their hash.
 */
#include "model/description_yaml.h"

#include "base/alloc.h"
#include "base/text.h"
#include "model/check.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define MAX_BYTES ((size_t)4 * 1024 * 1024) /* the example has 12 kB */

/* Bytes of the UTF-8 character at s, 0 if it is none or a control character. */
static size_t character_length(const char *s, size_t left)
{
    bool control = ((unsigned char)*s < 0x20 || *s == 0x7f) && !strchr("\t\n\r", *s);
    return control || *s == '\0' ? 0 : gm_text_utf8_length(s, left);
}

static gm_status check_text(const char *path, const char *bytes, size_t size,
                            gm_error *error)
{
    int line = 1;
    for (size_t i = 0; i < size;) {
        size_t n = character_length(bytes + i, size - i);
        if (n == 0)
            return gm_description_fail(path, line, "", GM_ERR_FORMAT, error,
                                       "not a text file; found the byte 0x%02x, expected "
                                       "YAML in UTF-8",
                                       (unsigned char)bytes[i]);
        line += bytes[i] == '\n';
        i += n;
    }
    return GM_OK;
}

static gm_status read_stream(const char *path, FILE *file, char *bytes, size_t *size,
                             gm_error *error)
{
    *size = fread(bytes, 1, MAX_BYTES + 1, file);
    if (ferror(file))
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
    if (*size > MAX_BYTES)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: too large; a description has at most %zu bytes", path,
                       MAX_BYTES);
    bytes[*size] = '\0';
    return check_text(path, bytes, *size, error);
}

/* The whole file in memory; *bytes is the caller's. */
static gm_status read_bytes(const char *path, char **bytes, size_t *size, gm_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", path,
                       strerror(errno));
    char *buffer = gm_calloc(MAX_BYTES + 2, 1);
    gm_status status = buffer ? read_stream(path, file, buffer, size, error)
                              : gm_fail(error, GM_ERR_MEMORY, "out of memory");
    (void)fclose(file);
    if (status != GM_OK) {
        gm_free(buffer);
        return status;
    }
    *bytes = buffer;
    return GM_OK;
}

static gm_status hash_bytes(const char *bytes, size_t size, char text[GM_SHA256_TEXT],
                            gm_error *error)
{
    gm_sha256 *sum = gm_sha256_create();
    if (!sum)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_sha256_bytes(sum, bytes, size);
    gm_sha256_finish(sum, text);
    gm_sha256_destroy(sum);
    return GM_OK;
}

gm_status gm_yaml_read(const char *path, char sha256[GM_SHA256_TEXT], gm_yaml **tree,
                       gm_error *error)
{
    char *bytes = NULL;
    size_t size = 0;
    gm_status status = read_bytes(path, &bytes, &size, error);
    if (status != GM_OK)
        return status;
    status = hash_bytes(bytes, size, sha256, error);
    if (status == GM_OK)
        status = gm_yaml_parse(path, bytes, size, tree, error);
    gm_free(bytes);
    return status;
}
