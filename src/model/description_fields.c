/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reads any section by its table: first the items are counted and named, so that a
 * reference may stand before what it names, then every value is read. Values are written
 * through memcpy at the offset that the table gives.
 */
#include "model/description_fields.h"

#include "base/alloc.h"
#include "base/text.h"
#include "model/check.h"
#include "model/schema.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ELEMENT = 192, EXPECTED = 256, MAX_CANDIDATES = 128 };

typedef struct reader {
    gm_description *d;
    gm_error *error;
} reader;

/* A section of the file and where it goes. */
typedef struct place {
    const gm_section *section;
    const gm_yaml *node; /* NULL: absent, defaults only */
    char *base;
    int line;
    char element[ELEMENT];
} place;

/* One value of it. */
typedef struct slot {
    const place *in;
    const gm_field *field;
    const gm_yaml *node;
    char *target;
} slot;

static gm_status read_section(const reader *r, const place *p);

static gm_status out_of_memory(const reader *r)
{
    return gm_fail(r->error, GM_ERR_MEMORY, "out of memory");
}

static gm_status wrong_value(const reader *r, const slot *s, const char *hint)
{
    char expected[EXPECTED], found[GM_YAML_SHOW];
    gm_schema_expectation(s->field, expected, sizeof expected);
    return gm_description_fail(r->d->file, s->node->line, s->in->element, GM_ERR_FORMAT,
                               r->error, "%s must be %s, found %s%s", s->field->key,
                               expected, gm_yaml_show(s->node, found), hint);
}

/* The key that is the word and a unit, or -1: temperature is far from temperature_degC.
 */
static int without_unit(const char *word, const char *const *keys, int n)
{
    size_t length = strlen(word);
    for (int i = 0; i < n; i++)
        if (strncmp(keys[i], word, length) == 0 &&
            strcmp(keys[i] + length, gm_schema_unit(keys[i])->suffix) == 0)
            return i;
    return -1;
}

static gm_status unknown_key(const reader *r, const place *p, const gm_yaml *entry)
{
    const char *keys[GM_MAX_KEYS];
    char shown[GM_YAML_SHOW];
    int n = gm_schema_keys(p->section, keys, GM_MAX_KEYS);
    int near = without_unit(entry->key, keys, n);
    if (near < 0)
        near = gm_text_nearest(entry->key, keys, n);
    return gm_description_fail(r->d->file, entry->line, p->element, GM_ERR_FORMAT,
                               r->error, "unknown key %s%s%s%s",
                               gm_yaml_show_text(entry->key, '\'', shown),
                               near >= 0 ? "; did you mean '" : "",
                               near >= 0 ? keys[near] : "", near >= 0 ? "'?" : "");
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

static gm_status read_number(const reader *r, const slot *s)
{
    double value;
    if (!plain_scalar(s->node) || !gm_text_to_double(s->node->text, &value) ||
        !in_range(s->field, value))
        return wrong_value(r, s, "");
    value = gm_unit_to_si(gm_schema_unit(s->field->key), value);
    memcpy(s->target, &value, sizeof value);
    return GM_OK;
}

static gm_status read_integer(const reader *r, const slot *s)
{
    int value;
    if (!plain_scalar(s->node) || !gm_text_to_int(s->node->text, &value) ||
        !in_range(s->field, value))
        return wrong_value(r, s, "");
    memcpy(s->target, &value, sizeof value);
    return GM_OK;
}

static gm_status read_boolean(const reader *r, const slot *s)
{
    int value = plain_scalar(s->node) && strcmp(s->node->text, "true") == 0;
    if (!value && !(plain_scalar(s->node) && strcmp(s->node->text, "false") == 0))
        return wrong_value(r, s, "");
    memcpy(s->target, &value, sizeof value);
    return GM_OK;
}

static gm_status read_words(const reader *r, const slot *s)
{
    if (s->node->kind != GM_YAML_SCALAR || strlen(s->node->text) >= GM_NAME_SIZE ||
        strchr(s->node->text, '\n') ||
        (s->node->text[0] == '\0' && s->field->need == GM_NEED_VALUE))
        return wrong_value(r, s, "");
    memcpy(s->target, s->node->text, strlen(s->node->text) + 1);
    return GM_OK;
}

static gm_status read_text(const reader *r, const slot *s)
{
    if (s->node->kind != GM_YAML_SCALAR)
        return wrong_value(r, s, "");
    char *copy = gm_strdup(s->node->text);
    if (!copy)
        return out_of_memory(r);
    memcpy(s->target, &copy, sizeof copy);
    return GM_OK;
}

static gm_status read_choice(const reader *r, const slot *s)
{
    const char *words[MAX_CANDIDATES];
    char hint[GM_NAME_SIZE + 32];
    int n = 0;
    if (s->node->kind != GM_YAML_SCALAR)
        return wrong_value(r, s, "");
    for (const gm_choice *c = s->field->choices; c->word; c++) {
        if (strcmp(c->word, s->node->text) == 0) {
            memcpy(s->target, &c->value, sizeof c->value);
            return GM_OK;
        }
        words[n++] = c->word;
    }
    return wrong_value(r, s, suggest(s->node->text, n, words, hint, sizeof hint));
}

/* The named parts that a reference can mean. */
typedef struct collection {
    const char *first; /* label of the first */
    size_t size;
    int n;
} collection;

static collection find_collection(const reader *r, const gm_section *section)
{
    size_t offset = 0;
    const gm_field *field =
        gm_schema_find(gm_schema_root(), section->collection, &offset);
    const char *d = (const char *)r->d;
    const char *items;
    collection c = {.size = section->size};
    memcpy(&items, d + offset, sizeof items);
    memcpy(&c.n, d + field->count_offset, sizeof c.n);
    c.first = items + section->label;
    return c;
}

static const char *name_of(const collection *c, int i)
{
    return c->first + (size_t)i * c->size + offsetof(gm_label, name);
}

static gm_status unknown_reference(const reader *r, const slot *s, const collection *c)
{
    const char *names[MAX_CANDIDATES];
    char hint[GM_NAME_SIZE + 32];
    int n = 0;
    if (s->node->kind != GM_YAML_SCALAR)
        return wrong_value(r, s, "");
    for (; n < c->n && n < MAX_CANDIDATES; n++)
        names[n] = name_of(c, n);
    return wrong_value(r, s, suggest(s->node->text, n, names, hint, sizeof hint));
}

static gm_status read_reference(const reader *r, const slot *s)
{
    const int housing = GM_HOUSING;
    collection c = find_collection(r, s->field->section);
    for (int i = 0; s->node->kind == GM_YAML_SCALAR && i < c.n; i++)
        if (strcmp(name_of(&c, i), s->node->text) == 0) {
            memcpy(s->target, &i, sizeof i);
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
static gm_status read_references(const reader *r, const slot *s)
{
    const gm_field *f = s->field;
    gm_field one = *f;
    int *list = NULL;
    if (s->node->kind != GM_YAML_LIST || s->node->n == 0 ||
        (f->fixed_count && s->node->n != f->fixed_count))
        return wrong_value(r, s, "");
    if (!f->fixed_count) {
        list = gm_calloc((size_t)s->node->n, sizeof *list);
        if (!list)
            return out_of_memory(r);
        memcpy(s->target, &list, sizeof list);
        memcpy(s->in->base + f->count_offset, &s->node->n, sizeof s->node->n);
    }
    one.type = GM_FIELD_REFERENCE;
    gm_status status = GM_OK;
    for (int i = 0; i < s->node->n && status == GM_OK; i++) {
        slot item = {s->in, &one, s->node->item[i], s->target + (size_t)i * sizeof(int)};
        if (list)
            item.target = (char *)&list[i];
        status = read_reference(r, &item);
    }
    return status;
}

static void enter(place *inner, const place *outer, const gm_section *section)
{
    *inner = (place){.section = section, .line = outer->line};
    memcpy(inner->element, outer->element, sizeof inner->element);
}

static void add_element(place *p, const char *format, const char *word, const char *name)
{
    size_t n = strlen(p->element);
    if (n > 0)
        n += (size_t)snprintf(p->element + n, sizeof p->element - n, ", ");
    if (n < sizeof p->element)
        (void)snprintf(p->element + n, sizeof p->element - n, format, word, name);
}

static gm_status read_group(const reader *r, const slot *s)
{
    place inner;
    enter(&inner, s->in, s->field->section);
    add_element(&inner, "%s%s", s->field->key, "");
    inner.node = s->node;
    inner.line = s->node ? s->node->line : s->in->line;
    inner.base = s->target;
    return read_section(r, &inner);
}

static char *items_of(const slot *s)
{
    char *items = s->target;
    if (!s->field->fixed_count)
        memcpy(&items, s->target, sizeof items);
    return items;
}

static gm_status read_items(const reader *r, const slot *s)
{
    const gm_section *section = s->field->section;
    char *items = items_of(s);
    gm_status status = GM_OK;
    for (int i = 0; i < s->node->n && status == GM_OK; i++) {
        const gm_yaml *node = s->node->item[i];
        char number[16];
        place inner;
        enter(&inner, s->in, section);
        (void)snprintf(number, sizeof number, "%d", i + 1);
        add_element(&inner, section->key == GM_KEY_NAME ? "%s '%s'" : "%s %s",
                    section->word, node->key ? node->key : number);
        inner.node = node;
        inner.line = node->line;
        inner.base = items + (size_t)i * section->size;
        status = read_section(r, &inner);
    }
    return status;
}

static gm_status read_value(const reader *r, const slot *s)
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
    case GM_FIELD_GROUP:
        return read_group(r, s);
    case GM_FIELD_ITEMS:
        return read_items(r, s);
    case GM_FIELD_INLINE:
        break;
    }
    return GM_OK;
}

static void set_nothing(const slot *s)
{
    const double nan = (double)NAN;
    const int housing = GM_HOUSING;
    if (s->field->type == GM_FIELD_NUMBER)
        memcpy(s->target, &nan, sizeof nan);
    if (s->field->type == GM_FIELD_REFERENCE)
        memcpy(s->target, &housing, sizeof housing);
}

static gm_status read_absent(const reader *r, slot *s)
{
    if (s->field->need == GM_NEED_VALUE) {
        char expected[EXPECTED];
        gm_schema_expectation(s->field, expected, sizeof expected);
        return gm_description_fail(r->d->file, s->in->line, s->in->element, GM_ERR_FORMAT,
                                   r->error, "%s is missing; expected %s", s->field->key,
                                   expected);
    }
    if (s->field->need == GM_NEED_NOTHING) {
        set_nothing(s);
        return GM_OK;
    }
    if (s->field->type == GM_FIELD_GROUP)
        return read_group(r, s);
    char text[64];
    gm_yaml fallback = {.kind = GM_YAML_SCALAR, .line = s->in->line, .text = text};
    (void)snprintf(text, sizeof text, "%s", s->field->fallback);
    s->node = &fallback;
    return read_value(r, s);
}

static int valid_name(const char *name)
{
    size_t n = 0;
    if (!isalpha((unsigned char)name[0]))
        return 0;
    while (isalnum((unsigned char)name[n]) || name[n] == '_')
        n++;
    return name[n] == '\0' && n < GM_NAME_SIZE && strcmp(name, "housing") != 0;
}

static gm_status label_name(const reader *r, const place *p, const gm_section *section,
                            const gm_yaml *node, char *item)
{
    char found[GM_YAML_SHOW];
    gm_label label = {.line = node->line};
    if (!valid_name(node->key))
        return gm_description_fail(
            r->d->file, node->line, p->element, GM_ERR_FORMAT, r->error,
            "the name of a %s must be a letter followed by letters, "
            "digits and _, at most %d, and not housing; found %s",
            section->word, GM_NAME_SIZE - 1, gm_yaml_show_text(node->key, '\'', found));
    memcpy(label.name, node->key, strlen(node->key) + 1);
    memcpy(item + section->label, &label, sizeof label);
    return GM_OK;
}

static gm_status label_number(const reader *r, const place *p, const gm_section *section,
                              const gm_yaml *node, char *item)
{
    char found[GM_YAML_SHOW];
    int number;
    if (!gm_text_to_int(node->key, &number) || number < section->low ||
        number > section->high)
        return gm_description_fail(
            r->d->file, node->line, p->element, GM_ERR_FORMAT, r->error,
            "the number of a %s must be a whole number from %.0f to %.0f, found %s",
            section->word, section->low, section->high,
            gm_yaml_show_text(node->key, '\'', found));
    memcpy(item + section->label, &number, sizeof number);
    memcpy(item + section->line, &node->line, sizeof node->line);
    return GM_OK;
}

static gm_status label_item(const reader *r, const place *p, const gm_section *section,
                            const gm_yaml *node, char *item)
{
    switch (section->key) {
    case GM_KEY_NAME:
        return label_name(r, p, section, node, item);
    case GM_KEY_INTEGER:
        return label_number(r, p, section, node, item);
    case GM_KEY_NONE:
        break;
    }
    memcpy(item + section->line, &node->line, sizeof node->line);
    return GM_OK;
}

/* Memory for the items, and their names. */
static gm_status declare_items(const reader *r, const slot *s)
{
    const gm_field *f = s->field;
    gm_yaml_kind kind = f->section->key == GM_KEY_NONE ? GM_YAML_LIST : GM_YAML_MAPPING;
    if (s->node->kind != kind || s->node->n == 0)
        return wrong_value(r, s, "");
    if (f->fixed_count && s->node->n > f->fixed_count)
        return gm_description_fail(
            r->d->file, s->node->line, s->in->element, GM_ERR_FORMAT, r->error,
            "%s has at most %d entries, found %d", f->key, f->fixed_count, s->node->n);
    if (!f->fixed_count) {
        char *items = gm_calloc((size_t)s->node->n, f->section->size);
        if (!items)
            return out_of_memory(r);
        memcpy(s->target, &items, sizeof items);
    }
    memcpy(s->in->base + f->count_offset, &s->node->n, sizeof s->node->n);
    gm_status status = GM_OK;
    for (int i = 0; i < s->node->n && status == GM_OK; i++)
        status = label_item(r, s->in, f->section, s->node->item[i],
                            items_of(s) + (size_t)i * f->section->size);
    return status;
}

static slot slot_of(const place *p, const gm_field *field, size_t offset)
{
    const gm_yaml *node = p->node ? gm_yaml_get(p->node, field->key) : NULL;
    return (slot){p, field, node, p->base + offset};
}

static gm_status check_keys(const reader *r, const place *p)
{
    size_t offset;
    for (int i = 0; i < p->node->n; i++)
        if (!gm_schema_find(p->section, p->node->item[i]->key, &offset))
            return unknown_key(r, p, p->node->item[i]);
    return GM_OK;
}

/* A pass over all fields, inline ones included. */
static gm_status for_fields(const reader *r, const place *p, const gm_section *section,
                            size_t base, gm_status (*visit)(const reader *r, slot *s))
{
    gm_status status = GM_OK;
    for (const gm_field *f = section->fields; f->key && status == GM_OK; f++) {
        slot s = slot_of(p, f, base + f->offset);
        status = f->type == GM_FIELD_INLINE
                     ? for_fields(r, p, f->section, base + f->offset, visit)
                     : visit(r, &s);
    }
    return status;
}

static gm_status visit_declare(const reader *r, slot *s)
{
    return s->field->type == GM_FIELD_ITEMS && s->node ? declare_items(r, s) : GM_OK;
}

static gm_status visit_read(const reader *r, slot *s)
{
    return s->node ? read_value(r, s) : read_absent(r, s);
}

static gm_status read_section(const reader *r, const place *p)
{
    char found[GM_YAML_SHOW];
    gm_status status = GM_OK;
    if (p->node && p->node->kind != GM_YAML_MAPPING)
        return gm_description_fail(r->d->file, p->line, p->element, GM_ERR_FORMAT,
                                   r->error, "expected a group of fields, found %s",
                                   gm_yaml_show(p->node, found));
    if (p->node)
        status = check_keys(r, p);
    if (status == GM_OK)
        status = for_fields(r, p, p->section, 0, visit_declare);
    if (status == GM_OK)
        status = for_fields(r, p, p->section, 0, visit_read);
    return status;
}

gm_status gm_description_fields(gm_description *d, const gm_yaml *tree, gm_error *error)
{
    const reader r = {d, error};
    const place root = {
        .section = gm_schema_root(), .node = tree, .base = (char *)d, .line = tree->line};
    return read_section(&r, &root);
}
