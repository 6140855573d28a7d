/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A JSON writer: values in the order of the calls, numbers so that they read back to the
 * same bits, and never what JSON does not have (NaN and infinity become null).
 */
#ifndef JSON_H
#define JSON_H

#include <stdbool.h>
#include <stdio.h>

#define GM_JSON_DEPTH 16

typedef struct gm_json {
    FILE *out;
    int depth;
    char close[GM_JSON_DEPTH];  /* the bracket that ends each open level */
    bool filled[GM_JSON_DEPTH]; /* the level has a member already */
    bool one_line;              /* all on one line */
} gm_json;

/** Start a document: one object. */
void gm_json_start(gm_json *json, FILE *out);
/** The same, all of it on one line. */
void gm_json_start_line(gm_json *json, FILE *out);
/** End the document; all levels but the outermost must be closed. */
void gm_json_finish(gm_json *json);

/** key is NULL inside an array. Each begin has its end. */
void gm_json_object(gm_json *json, const char *key);
void gm_json_array(gm_json *json, const char *key);
void gm_json_end(gm_json *json);

/** text NULL gives null. Bytes that are no UTF-8 become U+FFFD. */
void gm_json_text(gm_json *json, const char *key, const char *text);
void gm_json_number(gm_json *json, const char *key, double value);
void gm_json_integer(gm_json *json, const char *key, long long value);
void gm_json_bool(gm_json *json, const char *key, bool value);

#endif
