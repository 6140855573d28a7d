/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A document has at most one value more than it has opening brackets and commas, and its
 * texts are never longer than their escaped form with its quotes, so both are allocated
 * once, before reading.
 */
#include "base/json_tree.h"

#include "base/alloc.h"
#include "base/text.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

struct gm_json_tree {
    gm_json_node *node; /* [n], the first is the document */
    int n;
    char *texts;
};

typedef struct reader {
    const char *name, *at; /* at: what comes next */
    gm_json_tree *tree;
    char *place; /* where the next text goes */
    int line, level;
    gm_error *error;
} reader;

static gm_status wrong(const reader *r, const char *expected)
{
    return gm_fail(r->error, GM_ERR_FORMAT, "%s:%d: is not JSON: expected %s", r->name,
                   r->line, expected);
}

static void skip_space(reader *r)
{
    for (; *r->at == ' ' || *r->at == '\t' || *r->at == '\r' || *r->at == '\n'; r->at++)
        r->line += *r->at == '\n';
}

/* ---- texts ---- */

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* The four digits after \u; -1 when they are none. */
static long read_unit(const char *s)
{
    long unit = 0;
    for (int i = 0; i < 4; i++) {
        int digit = hex_digit(s[i]);
        if (digit < 0)
            return -1;
        unit = 16 * unit + digit;
    }
    return unit;
}

static void put_utf8(reader *r, unsigned long c)
{
    if (c < 0x80) {
        *r->place++ = (char)c;
        return;
    }
    int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const unsigned char lead[] = {0, 0xC0, 0xE0, 0xF0};
    *r->place++ = (char)(lead[more] | (c >> (6 * more)));
    for (int i = more - 1; i >= 0; i--)
        *r->place++ = (char)(0x80 | ((c >> (6 * i)) & 0x3F));
}

/* After "\u": one character, perhaps of two surrogates. No zero: texts end with it. */
static bool read_code(reader *r)
{
    long high = read_unit(r->at), low = 0;
    if (high <= 0 || (high >= 0xDC00 && high < 0xE000))
        return false;
    r->at += 4;
    if (high < 0xD800 || high >= 0xE000) {
        put_utf8(r, (unsigned long)high);
        return true;
    }
    if (r->at[0] != '\\' || r->at[1] != 'u')
        return false;
    low = read_unit(r->at + 2);
    if (low < 0xDC00 || low >= 0xE000)
        return false;
    r->at += 6;
    put_utf8(r, 0x10000ul + ((unsigned long)(high - 0xD800) << 10) +
                    (unsigned long)(low - 0xDC00));
    return true;
}

static bool read_escape(reader *r)
{
    static const char from[] = "\"\\/bfnrt", to[] = "\"\\/\b\f\n\r\t";
    char c = *r->at;
    const char *known = c ? strchr(from, c) : NULL;
    if (!known && c != 'u')
        return false;
    r->at++;
    if (!known)
        return read_code(r);
    *r->place++ = to[known - from];
    return true;
}

static gm_status read_text(reader *r, const char **text)
{
    *text = r->place;
    if (*r->at != '"')
        return wrong(r, "a text in quotes");
    r->at++;
    while (*r->at != '"') {
        size_t n = gm_text_utf8_length(r->at, strnlen(r->at, 4));
        if (n == 0 || (unsigned char)*r->at < 0x20)
            return wrong(r, "the end of a text");
        if (*r->at == '\\') {
            r->at++;
            if (!read_escape(r))
                return wrong(r, "an escape such as \\n or \\u00e4");
            continue;
        }
        memcpy(r->place, r->at, n);
        r->place += n;
        r->at += n;
    }
    r->at++;
    *r->place++ = '\0';
    return GM_OK;
}

/* ---- numbers and words ---- */

static size_t digits(const char *s)
{
    return strspn(s, "0123456789");
}

/* Length of the number at s, 0 when there is none: no plus, no leading zeros. */
static size_t number_length(const char *s)
{
    size_t n = *s == '-', whole = digits(s + n);
    if (whole == 0 || (s[n] == '0' && whole > 1))
        return 0;
    n += whole;
    if (s[n] == '.') {
        size_t part = digits(s + n + 1);
        if (part == 0)
            return 0;
        n += 1 + part;
    }
    if (s[n] == 'e' || s[n] == 'E') {
        size_t sign = s[n + 1] == '+' || s[n + 1] == '-';
        size_t part = digits(s + n + 1 + sign);
        if (part == 0)
            return 0;
        n += 1 + sign + part;
    }
    return n;
}

static gm_status read_number(reader *r, gm_json_node *node)
{
    size_t n = number_length(r->at);
    if (n == 0)
        return wrong(r, "a value");
    node->kind = GM_JSON_NUMBER;
    node->text = r->place;
    memcpy(r->place, r->at, n);
    r->place += n;
    *r->place++ = '\0';
    r->at += n;
    return gm_text_to_double(node->text, &node->number) ? GM_OK
                                                        : wrong(r, "a finite number");
}

static bool read_word(reader *r, gm_json_node *node)
{
    static const struct {
        const char *word;
        gm_json_kind kind;
    } words[] = {
        {"null", GM_JSON_NULL}, {"false", GM_JSON_FALSE}, {"true", GM_JSON_TRUE}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        size_t n = strlen(words[i].word);
        if (strncmp(r->at, words[i].word, n) == 0) {
            node->kind = words[i].kind;
            r->at += n;
            return true;
        }
    }
    return false;
}

/* ---- values ---- */

static gm_status read_value(reader *r, gm_json_node *node);

static gm_status read_key(reader *r, gm_json_node *node)
{
    skip_space(r);
    gm_status status = read_text(r, &node->key);
    if (status != GM_OK)
        return status;
    skip_space(r);
    if (*r->at != ':')
        return wrong(r, "a colon");
    r->at++;
    return GM_OK;
}

static gm_status read_inside(reader *r, gm_json_node *node, char end)
{
    const gm_json_node **link = &node->first;
    gm_status status = GM_OK;
    r->at++;
    skip_space(r);
    if (*r->at == end) {
        r->at++;
        return GM_OK;
    }
    do {
        gm_json_node *inner = &r->tree->node[r->tree->n++];
        *link = inner;
        link = &inner->next;
        if (node->kind == GM_JSON_OBJECT)
            status = read_key(r, inner);
        if (status == GM_OK)
            status = read_value(r, inner);
        skip_space(r);
    } while (status == GM_OK && *r->at == ',' && r->at++);
    if (status != GM_OK)
        return status;
    if (*r->at != end)
        return wrong(r, end == '}' ? "a comma or }" : "a comma or ]");
    r->at++;
    return GM_OK;
}

static gm_status read_level(reader *r, gm_json_node *node)
{
    if (++r->level > GM_JSON_MAX_LEVELS)
        return wrong(r, "fewer levels");
    node->kind = *r->at == '{' ? GM_JSON_OBJECT : GM_JSON_ARRAY;
    gm_status status = read_inside(r, node, *r->at == '{' ? '}' : ']');
    r->level--;
    return status;
}

static gm_status read_value(reader *r, gm_json_node *node)
{
    skip_space(r);
    if (*r->at == '{' || *r->at == '[')
        return read_level(r, node);
    if (*r->at == '"') {
        node->kind = GM_JSON_TEXT;
        return read_text(r, &node->text);
    }
    return read_word(r, node) ? GM_OK : read_number(r, node);
}

/* ---- the document ---- */

static size_t count_nodes(const char *text)
{
    size_t n = 1;
    for (; *text; text++)
        n += *text == '{' || *text == '[' || *text == ',';
    return n;
}

void gm_json_tree_destroy(gm_json_tree *tree)
{
    if (!tree)
        return;
    gm_free(tree->node);
    gm_free(tree->texts);
    gm_free(tree);
}

static gm_json_tree *make_tree(const char *text)
{
    gm_json_tree *tree = gm_calloc(1, sizeof *tree);
    if (!tree)
        return NULL;
    tree->node = gm_calloc(count_nodes(text), sizeof *tree->node);
    tree->texts = gm_calloc(strlen(text) + 2, 1);
    if (tree->node && tree->texts)
        return tree;
    gm_json_tree_destroy(tree);
    return NULL;
}

gm_status gm_json_read(const char *name, const char *text, gm_json_tree **tree,
                       gm_error *error)
{
    gm_json_tree *made = make_tree(text);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "%s: no memory to read it", name);
    reader r = {.name = name,
                .at = text,
                .tree = made,
                .place = made->texts,
                .line = 1,
                .error = error};
    made->n = 1;
    gm_status status = read_value(&r, &made->node[0]);
    skip_space(&r);
    if (status == GM_OK && *r.at)
        status = wrong(&r, "the end");
    if (status == GM_OK)
        *tree = made;
    else
        gm_json_tree_destroy(made);
    return status;
}

const gm_json_node *gm_json_root(const gm_json_tree *tree)
{
    return &tree->node[0];
}

const gm_json_node *gm_json_member(const gm_json_node *object, const char *key)
{
    if (!object || object->kind != GM_JSON_OBJECT)
        return NULL;
    for (const gm_json_node *n = object->first; n; n = n->next)
        if (strcmp(n->key, key) == 0)
            return n;
    return NULL;
}

double gm_json_member_number(const gm_json_node *object, const char *key)
{
    const gm_json_node *n = gm_json_member(object, key);
    return n && n->kind == GM_JSON_NUMBER ? n->number : (double)NAN;
}

const char *gm_json_member_text(const gm_json_node *object, const char *key)
{
    const gm_json_node *n = gm_json_member(object, key);
    return n && n->kind == GM_JSON_TEXT ? n->text : "";
}
