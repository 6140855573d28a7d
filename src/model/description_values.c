/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Single values: numbers, words, choices and references to named parts, each checked and
 * written in SI through memcpy at its place in the description.
 */
#include "model/description_values.h"

#include "base/alloc.h"
#include "base/text.h"
#include "model/check.h"

#include <stdio.h>
#include <string.h>

enum { EXPECTED = 256, MAX_CANDIDATES = 128 };

static gm_status out_of_memory(const gm_field_reader *r)
{
    return gm_fail(r->error, GM_ERR_MEMORY, "out of memory");
}

gm_status gm_slot_wrong(const gm_field_reader *r, const gm_slot *s, const char *hint)
{
    char expected[EXPECTED], found[GM_YAML_SHOW];
    gm_schema_expectation(s->field, expected, sizeof expected);
    return gm_description_fail(r->file, s->node->line, s->in->element, GM_ERR_FORMAT,
                               r->error, "%s must be %s, found %s%s", s->field->key,
                               expected, gm_yaml_show(s->node, found), hint);
}

/* ", did you mean 'input_odd'?" or nothing. */
static const char *suggest(const char *word, int n, const char *const *names,
                           char *buffer, size_t size)
{
    int near = gm_text_nearest(word, names, n);
    buffer[0] = '\0';
    if (near >= 0)
        (void)snprintf(buffer, size, "; did you mean '%s'?", names[near]);
    return buffer;
}

static int in_range(const gm_field *f, double v)
{
    int above = f->open & GM_OPEN_LOW ? v > f->low : v >= f->low;
    int below = f->open & GM_OPEN_HIGH ? v < f->high : v <= f->high;
    return above && below;
}

static int plain_scalar(const gm_yaml *node)
{
    return node->kind == GM_YAML_SCALAR && !node->quoted;
}

static gm_status read_number(const gm_field_reader *r, const gm_slot *s)
{
    double value;
    if (!plain_scalar(s->node) || !gm_text_to_double(s->node->text, &value) ||
        !in_range(s->field, value))
        return gm_slot_wrong(r, s, "");
    value = gm_unit_to_si(gm_schema_unit(s->field->key), value);
    memcpy(s->target, &value, sizeof value);
    return GM_OK;
}

static gm_status read_integer(const gm_field_reader *r, const gm_slot *s)
{
    int value;
    if (!plain_scalar(s->node) || !gm_text_to_int(s->node->text, &value) ||
        !in_range(s->field, value))
        return gm_slot_wrong(r, s, "");
    memcpy(s->target, &value, sizeof value);
    return GM_OK;
}

static gm_status read_boolean(const gm_field_reader *r, const gm_slot *s)
{
    int value = plain_scalar(s->node) && strcmp(s->node->text, "true") == 0;
    if (!value && !(plain_scalar(s->node) && strcmp(s->node->text, "false") == 0))
        return gm_slot_wrong(r, s, "");
    memcpy(s->target, &value, sizeof value);
    return GM_OK;
}

/* In quotes YAML allows \n and the like; names go into messages of one line. */
static int one_line(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < 0x20 || *text == 0x7f)
            return 0;
    return 1;
}

/* What YAML takes for no value at all. */
static int is_null(const gm_yaml *node)
{
    static const char *const words[] = {"", "~", "null", "Null", "NULL"};
    for (size_t i = 0; plain_scalar(node) && i < sizeof words / sizeof words[0]; i++)
        if (strcmp(node->text, words[i]) == 0)
            return 1;
    return 0;
}

static gm_status read_words(const gm_field_reader *r, const gm_slot *s)
{
    if (s->node->kind != GM_YAML_SCALAR || strlen(s->node->text) >= GM_NAME_SIZE ||
        !one_line(s->node->text) || strspn(s->node->text, " ") == strlen(s->node->text) ||
        is_null(s->node))
        return gm_slot_wrong(r, s, "");
    memcpy(s->target, s->node->text, strlen(s->node->text) + 1);
    return GM_OK;
}

static gm_status read_text(const gm_field_reader *r, const gm_slot *s)
{
    if (s->node->kind != GM_YAML_SCALAR || is_null(s->node))
        return gm_slot_wrong(r, s, "");
    char *copy = gm_strdup(s->node->text);
    if (!copy)
        return out_of_memory(r);
    memcpy(s->target, &copy, sizeof copy);
    return GM_OK;
}

static gm_status read_choice(const gm_field_reader *r, const gm_slot *s)
{
    const char *words[MAX_CANDIDATES];
    char hint[GM_NAME_SIZE + 32];
    int n = 0;
    if (s->node->kind != GM_YAML_SCALAR)
        return gm_slot_wrong(r, s, "");
    for (const gm_choice *c = s->field->choices; c->word; c++) {
        if (strcmp(c->word, s->node->text) == 0) {
            memcpy(s->target, &c->value, sizeof c->value);
            return GM_OK;
        }
        words[n++] = c->word;
    }
    return gm_slot_wrong(r, s, suggest(s->node->text, n, words, hint, sizeof hint));
}

/* The named parts that a reference can mean. */
typedef struct collection {
    const char *first; /* label of the first */
    size_t size;
    int n;
} collection;

static collection find_collection(const gm_field_reader *r, const gm_section *section)
{
    size_t offset = 0;
    const gm_field *field = gm_schema_find(r->root, section->collection, &offset);
    const char *d = r->base;
    const char *items;
    collection c = {.size = section->size};
    memcpy(&items, d + offset, sizeof items);
    memcpy(&c.n, d + field->count_offset, sizeof c.n);
    c.first = items ? items + section->label : NULL; /* none: n is 0 */
    return c;
}

static const char *name_of(const collection *c, int i)
{
    return c->first + (size_t)i * c->size + offsetof(gm_label, name);
}

static int find_name(const collection *c, const char *name)
{
    for (int i = 0; i < c->n; i++)
        if (strcmp(name_of(c, i), name) == 0)
            return i;
    return -1;
}

static gm_status unknown_reference(const gm_field_reader *r, const gm_slot *s,
                                   const collection *c)
{
    const char *names[MAX_CANDIDATES];
    char hint[GM_NAME_SIZE + 32];
    int n = 0;
    if (s->node->kind != GM_YAML_SCALAR)
        return gm_slot_wrong(r, s, "");
    for (; n < c->n && n < MAX_CANDIDATES; n++)
        names[n] = name_of(c, n);
    return gm_slot_wrong(r, s, suggest(s->node->text, n, names, hint, sizeof hint));
}

static gm_status read_reference(const gm_field_reader *r, const gm_slot *s)
{
    const int housing = GM_HOUSING;
    collection c = find_collection(r, s->field->section);
    int found = s->node->kind == GM_YAML_SCALAR ? find_name(&c, s->node->text) : -1;
    if (found >= 0) {
        memcpy(s->target, &found, sizeof found);
        return GM_OK;
    }
    if (s->field->need == GM_NEED_NOTHING && s->node->kind == GM_YAML_SCALAR &&
        strcmp(s->node->text, "housing") == 0) {
        memcpy(s->target, &housing, sizeof housing);
        return GM_OK;
    }
    return unknown_reference(r, s, &c);
}

/* References in a list: each is read like a single one. */
static gm_status read_references(const gm_field_reader *r, const gm_slot *s)
{
    const gm_field *f = s->field;
    gm_field one = *f;
    int *list = NULL;
    if (s->node->kind != GM_YAML_LIST || s->node->n == 0 ||
        (f->fixed_count && s->node->n != f->fixed_count))
        return gm_slot_wrong(r, s, "");
    if (!f->fixed_count) {
        list = gm_calloc((size_t)s->node->n, sizeof *list);
        if (!list)
            return out_of_memory(r);
        memcpy(s->target, &list, sizeof list);
        memcpy(gm_slot_count(s), &s->node->n, sizeof s->node->n);
    }
    one.type = GM_FIELD_REFERENCE;
    gm_status status = GM_OK;
    for (int i = 0; i < s->node->n && status == GM_OK; i++) {
        gm_slot item = {s->in, &one, s->node->item[i],
                        s->target + (size_t)i * sizeof(int)};
        if (list)
            item.target = (char *)&list[i];
        status = read_reference(r, &item);
    }
    return status;
}

/* Neither of the two collections has it: look for a near name in both. */
static gm_status unknown_lock(const gm_field_reader *r, const gm_slot *s,
                              const collection both[2])
{
    const char *names[2 * MAX_CANDIDATES];
    char hint[GM_NAME_SIZE + 32];
    int n = 0;
    if (s->node->kind != GM_YAML_SCALAR)
        return gm_slot_wrong(r, s, "");
    for (int c = 0; c < 2; c++)
        for (int i = 0; i < both[c].n && i < MAX_CANDIDATES; i++)
            names[n++] = name_of(&both[c], i);
    return gm_slot_wrong(r, s, suggest(s->node->text, n, names, hint, sizeof hint));
}

static gm_status read_lock(const gm_field_reader *r, const gm_slot *s)
{
    const collection both[2] = {find_collection(r, s->field->section),
                                find_collection(r, s->field->other)};
    for (int c = 0; c < 2 && s->node->kind == GM_YAML_SCALAR; c++) {
        const gm_lock lock = {c, find_name(&both[c], s->node->text)};
        if (lock.index >= 0) {
            memcpy(s->target, &lock, sizeof lock);
            return GM_OK;
        }
    }
    return unknown_lock(r, s, both);
}

/* One name, or a list of them. */
static gm_status read_locks(const gm_field_reader *r, const gm_slot *s)
{
    int is_list = s->node->kind == GM_YAML_LIST, n = is_list ? s->node->n : 1;
    gm_lock *locks = NULL;
    gm_status status = GM_OK;
    if (n > 0) {
        locks = gm_calloc((size_t)n, sizeof *locks);
        if (!locks)
            return out_of_memory(r);
    }
    memcpy(s->target, &locks, sizeof locks);
    memcpy(gm_slot_count(s), &n, sizeof n);
    for (int i = 0; i < n && status == GM_OK; i++) {
        gm_slot item = {s->in, s->field, is_list ? s->node->item[i] : s->node,
                        (char *)&locks[i]};
        status = read_lock(r, &item);
    }
    return status;
}

gm_status gm_slot_read(const gm_field_reader *r, const gm_slot *s)
{
    switch (s->field->type) {
    case GM_FIELD_NUMBER:
        return read_number(r, s);
    case GM_FIELD_INTEGER:
        return read_integer(r, s);
    case GM_FIELD_BOOLEAN:
        return read_boolean(r, s);
    case GM_FIELD_WORDS:
        return read_words(r, s);
    case GM_FIELD_TEXT:
        return read_text(r, s);
    case GM_FIELD_CHOICE:
        return read_choice(r, s);
    case GM_FIELD_REFERENCE:
        return read_reference(r, s);
    case GM_FIELD_REFERENCES:
        return read_references(r, s);
    case GM_FIELD_LOCKS:
        return read_locks(r, s);
    case GM_FIELD_GROUP:
    case GM_FIELD_ITEMS:
    case GM_FIELD_INLINE:
        break;
    }
    return gm_slot_wrong(r, s, "");
}
