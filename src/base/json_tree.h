/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading JSON (RFC 8259) into a tree: strict, so that what is read and passed on is
 * valid JSON again. Numbers keep the text they were written with, so that a copy has
 * the same digits.
 */
#ifndef JSON_TREE_H
#define JSON_TREE_H

#include "base/gm_status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_JSON_MAX_LEVELS 32

typedef enum gm_json_kind {
    GM_JSON_NULL,
    GM_JSON_FALSE,
    GM_JSON_TRUE,
    GM_JSON_NUMBER,
    GM_JSON_TEXT,
    GM_JSON_ARRAY,
    GM_JSON_OBJECT
} gm_json_kind;

/** One value. All texts are UTF-8 without the escapes of JSON. */
typedef struct gm_json_node {
    gm_json_kind kind;
    const char *key;  /* of a member of an object; NULL in an array and at the top */
    const char *text; /* of a text; a number as it was written; else NULL */
    double number;    /* of a number */
    const struct gm_json_node *first, *next; /* inside this one; beside it */
} gm_json_node;

typedef struct gm_json_tree gm_json_tree;

/** Read one document. name: what messages call it. The tree is the caller's and holds
 *  copies of all texts. GM_ERR_FORMAT with name, line and what is wrong;
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_json_read(const char *name, const char *text,
                                    gm_json_tree **tree, gm_error *error);
void gm_json_tree_destroy(gm_json_tree *tree);

/** The whole document; lives as long as the tree. */
const gm_json_node *gm_json_root(const gm_json_tree *tree);

/** The first member of this name; NULL when there is none, or no object at all. */
const gm_json_node *gm_json_member(const gm_json_node *object, const char *key);

/** The member's number, and its text; NAN and "" when it is none. */
double gm_json_member_number(const gm_json_node *object, const char *key);
const char *gm_json_member_text(const gm_json_node *object, const char *key);

#ifdef __cplusplus
}
#endif
#endif
