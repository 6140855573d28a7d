/* SPDX-License-Identifier: BSD-2-Clause
 *
 * libfyaml's event stream becomes a tree of our own: its document layer resolves aliases
 * (a few lines can stand for gigabytes) and has no limit on depth. Its messages are
 * collected, never printed.
 */
#include "model/description_yaml.h"

#include "base/alloc.h"

#include <libfyaml.h>
#include <stdio.h>
#include <string.h>

enum { MAX_DEPTH = 12, MAX_NODES = 100000, SHOWN = 60 };

typedef struct parse {
    const char *file;
    struct fy_parser *parser;
    struct fy_diag *diag;
    int nodes;
    gm_error *error;
} parse;

void gm_yaml_destroy(gm_yaml *tree)
{
    if (!tree)
        return;
    for (int i = 0; i < tree->n; i++)
        gm_yaml_destroy(tree->item[i]);
    gm_free(tree->item);
    gm_free(tree->key);
    gm_free(tree->text);
    gm_free(tree);
}

const gm_yaml *gm_yaml_get(const gm_yaml *mapping, const char *key)
{
    for (int i = 0; i < mapping->n; i++)
        if (strcmp(mapping->item[i]->key, key) == 0)
            return mapping->item[i];
    return NULL;
}

const char *gm_yaml_show_text(const char *text, char quote, char buffer[GM_YAML_SHOW])
{
    size_t n = 0;
    buffer[n++] = quote;
    const char *s = text;
    while (*s && n < SHOWN) {
        unsigned char c = (unsigned char)*s++;
        buffer[n++] = (char)(c < 0x20 || c == 0x7f ? ' ' : c);
    }
    /* do not end within a character of several bytes */
    while (*s && ((unsigned char)*s & 0xc0) == 0x80 && n > 1) {
        s--;
        n--;
    }
    if (*s) {
        memcpy(buffer + n, "...", 3);
        n += 3;
    }
    buffer[n++] = quote;
    buffer[n] = '\0';
    return buffer;
}

const char *gm_yaml_show(const gm_yaml *node, char buffer[GM_YAML_SHOW])
{
    if (node->kind != GM_YAML_SCALAR)
        return node->kind == GM_YAML_LIST ? "a list" : "a group of fields";
    if (node->text[0] == '\0' && !node->quoted)
        return "nothing";
    return gm_yaml_show_text(node->text, node->quoted ? '"' : '\'', buffer);
}

static gm_status out_of_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

static int token_line(struct fy_token *token)
{
    const struct fy_mark *mark = token ? fy_token_start_mark(token) : NULL;
    return mark ? mark->line + 1 : 0;
}

/* The parser's first complaint as our sentence. */
static gm_status yaml_error(parse *p)
{
    void *cursor = NULL;
    char buffer[GM_YAML_SHOW];
    struct fy_diag_error *e = fy_diag_errors_iterate(p->diag, &cursor);
    if (!e || !e->msg)
        return gm_fail(p->error, GM_ERR_FORMAT, "%s:1: not YAML", p->file);
    return gm_fail(p->error, GM_ERR_FORMAT, "%s:%d: not YAML; found %s", p->file,
                   e->line > 0 ? e->line : 1, gm_yaml_show_text(e->msg, '\'', buffer));
}

static gm_status text_of(parse *p, struct fy_token *token, char **text)
{
    size_t length = 0;
    const char *s = token ? fy_token_get_text(token, &length) : NULL;
    *text = gm_calloc(length + 1, 1);
    if (!*text)
        return out_of_memory(p->error);
    if (s)
        memcpy(*text, s, length);
    return GM_OK;
}

static gm_status append(parse *p, gm_yaml *parent, gm_yaml *child)
{
    gm_yaml **item = gm_resize(parent->item, (size_t)parent->n + 1, sizeof *item);
    if (!item)
        return out_of_memory(p->error);
    parent->item = item;
    item[parent->n++] = child;
    return GM_OK;
}

static gm_status node_make(parse *p, gm_yaml_kind kind, int line, gm_yaml **node)
{
    if (++p->nodes > MAX_NODES)
        return gm_fail(p->error, GM_ERR_FORMAT,
                       "%s:%d: a description has at most %d values", p->file, line,
                       MAX_NODES);
    *node = gm_calloc(1, sizeof **node);
    if (!*node)
        return out_of_memory(p->error);
    (*node)->kind = kind;
    (*node)->line = line;
    return GM_OK;
}

/* What makes an event more than plain data. */
static gm_status refuse_extras(parse *p, const struct fy_event *event, int line)
{
    const struct fy_token *anchor = NULL, *tag = NULL;
    if (event->type == FYET_SCALAR) {
        anchor = event->scalar.anchor;
        tag = event->scalar.tag;
    } else if (event->type == FYET_MAPPING_START) {
        anchor = event->mapping_start.anchor;
        tag = event->mapping_start.tag;
    } else if (event->type == FYET_SEQUENCE_START) {
        anchor = event->sequence_start.anchor;
        tag = event->sequence_start.tag;
    }
    if (anchor || tag || event->type == FYET_ALIAS)
        return gm_fail(p->error, GM_ERR_FORMAT,
                       "%s:%d: anchors, aliases and tags (& * !) are not allowed in a "
                       "description",
                       p->file, line > 0 ? line : 1);
    return GM_OK;
}

static int event_line(const struct fy_event *event)
{
    switch (event->type) {
    case FYET_SCALAR:
        return token_line(event->scalar.value);
    case FYET_MAPPING_START:
        return token_line(event->mapping_start.mapping_start);
    case FYET_SEQUENCE_START:
        return token_line(event->sequence_start.sequence_start);
    case FYET_ALIAS:
        return token_line(event->alias.anchor);
    default:
        return 0;
    }
}

static gm_status read_node(parse *p, struct fy_event *event, int line, int depth,
                           gm_yaml **node);

/* The next event, which the caller frees; an error when the stream ends or breaks. */
static gm_status next_event(parse *p, struct fy_event **event)
{
    *event = fy_parser_parse(p->parser);
    return *event ? GM_OK : yaml_error(p);
}

static gm_status read_list(parse *p, gm_yaml *list, int depth)
{
    for (;;) {
        struct fy_event *event;
        gm_status status = next_event(p, &event);
        if (status != GM_OK)
            return status;
        bool end = event->type == FYET_SEQUENCE_END;
        gm_yaml *child = NULL;
        if (!end)
            status = read_node(p, event, list->line, depth, &child);
        fy_parser_event_free(p->parser, event);
        if (end || status != GM_OK)
            return status;
        status = append(p, list, child);
        if (status != GM_OK) {
            gm_yaml_destroy(child);
            return status;
        }
    }
}

static gm_status read_key(parse *p, const gm_yaml *mapping, struct fy_event *event,
                          char **key, int *line)
{
    *line = event_line(event) > 0 ? event_line(event) : mapping->line;
    if (event->type != FYET_SCALAR)
        return gm_fail(p->error, GM_ERR_FORMAT, "%s:%d: a key must be a word or a number",
                       p->file, *line);
    gm_status status = refuse_extras(p, event, *line);
    if (status == GM_OK)
        status = text_of(p, event->scalar.value, key);
    if (status != GM_OK)
        return status;
    const gm_yaml *before = gm_yaml_get(mapping, *key);
    if (before) {
        char shown[GM_YAML_SHOW];
        status = gm_fail(p->error, GM_ERR_FORMAT,
                         "%s:%d: the key %s stands twice, first in line %d", p->file,
                         *line, gm_yaml_show_text(*key, '\'', shown), before->line);
        gm_free(*key);
        *key = NULL;
    }
    return status;
}

/* A value and its key into the mapping; takes key. */
static gm_status read_value(parse *p, gm_yaml *mapping, char *key, int line, int depth)
{
    struct fy_event *event;
    gm_yaml *child = NULL;
    gm_status status = next_event(p, &event);
    if (status == GM_OK) {
        status = read_node(p, event, line, depth, &child);
        fy_parser_event_free(p->parser, event);
    }
    if (status == GM_OK)
        status = append(p, mapping, child);
    if (status == GM_OK) {
        child->key = key;
        child->line = line;
        return GM_OK;
    }
    gm_yaml_destroy(child);
    gm_free(key);
    return status;
}

static gm_status read_mapping(parse *p, gm_yaml *mapping, int depth)
{
    for (;;) {
        struct fy_event *event;
        gm_status status = next_event(p, &event);
        if (status != GM_OK)
            return status;
        bool end = event->type == FYET_MAPPING_END;
        char *key = NULL;
        int line = 0;
        if (!end)
            status = read_key(p, mapping, event, &key, &line);
        fy_parser_event_free(p->parser, event);
        if (!end && status == GM_OK)
            status = read_value(p, mapping, key, line, depth);
        if (end || status != GM_OK)
            return status;
    }
}

static gm_status fill_node(parse *p, struct fy_event *event, int depth, gm_yaml *node)
{
    switch (event->type) {
    case FYET_SCALAR:
        node->quoted = fy_token_scalar_style(event->scalar.value) != FYSS_PLAIN;
        return text_of(p, event->scalar.value, &node->text);
    case FYET_MAPPING_START:
        return read_mapping(p, node, depth + 1);
    case FYET_SEQUENCE_START:
        return read_list(p, node, depth + 1);
    default:
        return yaml_error(p);
    }
}

static gm_yaml_kind kind_of(const struct fy_event *event)
{
    if (event->type == FYET_MAPPING_START)
        return GM_YAML_MAPPING;
    return event->type == FYET_SEQUENCE_START ? GM_YAML_LIST : GM_YAML_SCALAR;
}

static gm_status read_node(parse *p, struct fy_event *event, int line, int depth,
                           gm_yaml **node)
{
    int own = event_line(event);
    gm_yaml *made = NULL;
    gm_status status = refuse_extras(p, event, own > 0 ? own : line);
    if (status == GM_OK && depth > MAX_DEPTH)
        status = gm_fail(p->error, GM_ERR_FORMAT,
                         "%s:%d: nested deeper than %d levels; a description needs 6",
                         p->file, own > 0 ? own : line, MAX_DEPTH);
    if (status == GM_OK)
        status = node_make(p, kind_of(event), own > 0 ? own : line, &made);
    if (status == GM_OK)
        status = fill_node(p, event, depth, made);
    if (status != GM_OK) {
        gm_yaml_destroy(made);
        return status;
    }
    *node = made;
    return GM_OK;
}

/* Stream start, document start, the node, and no second document. */
static gm_status read_stream(parse *p, gm_yaml **tree)
{
    bool done = false;
    while (!done) {
        struct fy_event *event;
        gm_status status = next_event(p, &event);
        if (status != GM_OK)
            return status;
        int line = event_line(event);
        switch (event->type) {
        case FYET_STREAM_START:
        case FYET_DOCUMENT_END:
            break;
        case FYET_DOCUMENT_START:
            if (*tree)
                status = gm_fail(p->error, GM_ERR_FORMAT,
                                 "%s:%d: only one document (---) per file", p->file,
                                 token_line(event->document_start.document_start));
            break;
        case FYET_STREAM_END:
            done = true;
            break;
        default:
            status = read_node(p, event, line > 0 ? line : 1, 0, tree);
            break;
        }
        fy_parser_event_free(p->parser, event);
        if (status != GM_OK)
            return status;
    }
    return *tree
               ? GM_OK
               : gm_fail(p->error, GM_ERR_FORMAT,
                         "%s:1: the file is empty; a description was expected", p->file);
}

static gm_status parse_open(parse *p, const char *bytes, size_t size)
{
    struct fy_diag_cfg diag;
    fy_diag_cfg_default(&diag);
    diag.fp = NULL;
    p->diag = fy_diag_create(&diag);
    if (!p->diag)
        return out_of_memory(p->error);
    fy_diag_set_collect_errors(p->diag, true);
    struct fy_parse_cfg cfg = {.search_path = "", .flags = FYPCF_QUIET, .diag = p->diag};
    p->parser = fy_parser_create(&cfg);
    if (!p->parser || fy_parser_set_string(p->parser, bytes, size) != 0)
        return out_of_memory(p->error);
    return GM_OK;
}

gm_status gm_yaml_parse(const char *file, const char *bytes, size_t size, gm_yaml **tree,
                        gm_error *error)
{
    parse p = {.file = file, .error = error};
    gm_yaml *made = NULL;
    gm_status status = parse_open(&p, bytes, size);
    if (status == GM_OK)
        status = read_stream(&p, &made);
    fy_parser_destroy(p.parser);
    fy_diag_destroy(p.diag);
    if (status != GM_OK) {
        gm_yaml_destroy(made);
        return status;
    }
    *tree = made;
    return GM_OK;
}
