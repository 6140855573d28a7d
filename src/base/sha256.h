/* SPDX-License-Identifier: BSD-2-Clause
 *
 * SHA-256 as a running sum (libmd), for content hashes and provenance.
 */
#ifndef SHA256_H
#define SHA256_H

#include "base/gm_status.h"

#include <stddef.h>
#include <stdint.h>

#define GM_SHA256_TEXT 65 /* 64 hexadecimal digits and the end */

typedef struct gm_sha256 gm_sha256;

/** New running sum, or NULL when there is no memory. Free with gm_sha256_destroy. */
gm_sha256 *gm_sha256_create(void);
void gm_sha256_destroy(gm_sha256 *sum);

void gm_sha256_bytes(gm_sha256 *sum, const void *bytes, size_t size);

/** Text with its terminating zero, so that ("ab","c") differs from ("a","bc"). */
void gm_sha256_text(gm_sha256 *sum, const char *text);

/** The number's IEEE bits, little endian; -0.0 counts as 0.0. */
void gm_sha256_double(gm_sha256 *sum, double value);
void gm_sha256_int(gm_sha256 *sum, int64_t value);

/** Finish: 64 lower-case hexadecimal digits. The sum cannot be continued. */
void gm_sha256_finish(gm_sha256 *sum, char text[GM_SHA256_TEXT]);

/** Hash of a file's bytes. GM_ERR_IO with a sentence when it cannot be read. */
GM_NODISCARD gm_status gm_sha256_file(const char *path, char text[GM_SHA256_TEXT],
                                      gm_error *error);

#endif
