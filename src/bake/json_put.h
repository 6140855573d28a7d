/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Writing JSON into a buffer: members in the order of the calls, indented.
 */
#ifndef JSON_PUT_H
#define JSON_PUT_H

#include "bake/buffer.h"
#include "base/json_tree.h"

typedef struct gm_json_put {
    gm_buffer *buffer;
    int level;
    bool filled; /* the open level has a member already */
} gm_json_put;

/** Open and close a level with these brackets; key NULL: in an array, or the document. */
void gm_json_put_open(gm_json_put *put, const char *key, char bracket);
void gm_json_put_close(gm_json_put *put, char bracket);

/** One member; NULL gives null, bytes that are no UTF-8 become U+FFFD. Finite numbers,
 *  with 12 digits. */
void gm_json_put_text(gm_json_put *put, const char *key, const char *text);
void gm_json_put_number(gm_json_put *put, const char *key, double value);

/** A copy of a value with all that is in it; numbers keep their digits. */
void gm_json_put_node(gm_json_put *put, const char *key, const gm_json_node *node);

#endif
