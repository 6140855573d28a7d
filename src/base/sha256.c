/* SPDX-License-Identifier: BSD-2-Clause */
/* libmd's header uses u_int8_t, which glibc declares only with this. */
#define _DEFAULT_SOURCE
#include "base/sha256.h"

#include "base/alloc.h"

#include <errno.h>
#include <sha2.h>
#include <stdio.h>
#include <string.h>

struct gm_sha256 {
    SHA2_CTX context;
};

gm_sha256 *gm_sha256_create(void)
{
    gm_sha256 *sum = gm_calloc(1, sizeof *sum);
    if (sum)
        SHA256Init(&sum->context);
    return sum;
}

void gm_sha256_destroy(gm_sha256 *sum)
{
    gm_free(sum);
}

void gm_sha256_bytes(gm_sha256 *sum, const void *bytes, size_t size)
{
    SHA256Update(&sum->context, bytes, size);
}

void gm_sha256_text(gm_sha256 *sum, const char *text)
{
    gm_sha256_bytes(sum, text, strlen(text) + 1);
}

void gm_sha256_int(gm_sha256 *sum, int64_t value)
{
    uint8_t bytes[8];
    uint64_t bits = (uint64_t)value;
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(bits >> (8 * i));
    gm_sha256_bytes(sum, bytes, sizeof bytes);
}

void gm_sha256_double(gm_sha256 *sum, double value)
{
    int64_t bits;
    double positive_zero = value + 0.0;
    memcpy(&bits, &positive_zero, sizeof bits);
    gm_sha256_int(sum, bits);
}

void gm_sha256_finish(gm_sha256 *sum, char text[GM_SHA256_TEXT])
{
    uint8_t digest[SHA256_DIGEST_LENGTH];
    SHA256Final(digest, &sum->context);
    for (int i = 0; i < SHA256_DIGEST_LENGTH; i++)
        (void)snprintf(text + 2 * i, 3, "%02x", digest[i]);
}

static gm_status add_stream(gm_sha256 *sum, FILE *file, const char *path, gm_error *error)
{
    unsigned char buffer[8192];
    size_t n;
    while ((n = fread(buffer, 1, sizeof buffer, file)) > 0)
        gm_sha256_bytes(sum, buffer, n);
    if (ferror(file))
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read", path);
    return GM_OK;
}

gm_status gm_sha256_file(const char *path, char text[GM_SHA256_TEXT], gm_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", path,
                       strerror(errno));
    gm_sha256 *sum = gm_sha256_create();
    gm_status status = sum ? add_stream(sum, file, path, error)
                           : gm_fail(error, GM_ERR_MEMORY, "out of memory");
    (void)fclose(file);
    if (status == GM_OK)
        gm_sha256_finish(sum, text);
    gm_sha256_destroy(sum);
    return status;
}
