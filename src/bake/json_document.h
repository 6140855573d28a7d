/* SPDX-License-Identifier: BSD-2-Clause
 *
 * JSON documents (jansson): read with a sentence when they are none, members that may be
 * missing, and writing into a buffer.
 */
#ifndef JSON_DOCUMENT_H
#define JSON_DOCUMENT_H

#include "bake/buffer.h"
#include "base/gm_status.h"

#include <jansson.h>

/** Read one document; an object names every member once. name: what messages call it.
 *  The caller gives it back with json_decref. GM_ERR_FORMAT with name, line and what is
 *  wrong; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_document_read(const char *name, const char *text,
                                        json_t **document, gm_error *error);

/** A member's number, and its text; NAN and "" when it is none, or no member at all. */
double gm_member_number(const json_t *object, const char *key);
const char *gm_member_text(const json_t *object, const char *key);

/** A new text; null for NULL. Bytes that are no UTF-8 become U+FFFD: a document is one,
 *  whatever a map says. NULL: no memory. */
json_t *gm_document_text(const char *text);

/** Append a document and a line end; reals read back to the same bits. NULL, or no
 *  memory: the buffer has failed. */
void gm_document_write(const json_t *document, gm_buffer *buffer);

#endif
