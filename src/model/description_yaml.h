/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A YAML text as a tree with line numbers. Anchors, aliases and tags are refused,
 * repeated keys too; depth and size are bounded, so that no file can exhaust memory or
 * stack.
 */
#ifndef DESCRIPTION_YAML_H
#define DESCRIPTION_YAML_H

#include "base/gm_status.h"
#include "base/sha256.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum gm_yaml_kind { GM_YAML_SCALAR, GM_YAML_MAPPING, GM_YAML_LIST } gm_yaml_kind;

typedef struct gm_yaml {
    gm_yaml_kind kind;
    int line;    /* from 1; of its key where it has one */
    char *key;   /* in a mapping, else NULL */
    bool quoted; /* scalar in quotes: text, never a number */
    char *text;  /* scalar */
    int n;       /* mapping, list */
    struct gm_yaml **item;
} gm_yaml;

/** Parse size bytes. file is the name used in messages. On success *tree is the caller's
 *  (gm_yaml_destroy). GM_ERR_FORMAT with a sentence "file:line: ...", GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_yaml_parse(const char *file, const char *bytes, size_t size,
                                     gm_yaml **tree, gm_error *error);

/** Read and parse a file of UTF-8 text; sha256: hash of its bytes. Like gm_yaml_parse,
 *  and GM_ERR_IO. */
GM_NODISCARD gm_status gm_yaml_read(const char *path, char sha256[GM_SHA256_TEXT],
                                    gm_yaml **tree, gm_error *error);
void gm_yaml_destroy(gm_yaml *tree);

/** The entry of a mapping, or NULL. */
const gm_yaml *gm_yaml_get(const gm_yaml *mapping, const char *key);

/** What a node is, for messages: '30 mm', a list, nothing. At most 60 bytes of text,
 *  one line, valid UTF-8. Returns buffer. */
enum { GM_YAML_SHOW = 80 };
const char *gm_yaml_show(const gm_yaml *node, char buffer[GM_YAML_SHOW]);

/** Bytes of text that are fit for a message on one line: cut to 60, no control
 *  characters. */
const char *gm_yaml_show_text(const char *text, char quote, char buffer[GM_YAML_SHOW]);

#endif
