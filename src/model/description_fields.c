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
#include "model/description_values.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { EXPECTED = 256 };

static gm_status read_section(const gm_field_reader *r, const gm_place *p);

static gm_status out_of_memory(const gm_field_reader *r)
{
    return gm_fail(r->error, GM_ERR_MEMORY, "out of memory");
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

static gm_status unknown_key(const gm_field_reader *r, const gm_place *p,
                             const gm_yaml *entry)
{
    const char *keys[GM_MAX_KEYS];
    char shown[GM_YAML_SHOW];
    int n = gm_schema_keys(p->section, keys, GM_MAX_KEYS);
    int near = without_unit(entry->key, keys, n);
    if (near < 0)
        near = gm_text_nearest(entry->key, keys, n);
    return gm_description_fail(
        r->file, entry->line, p->element, GM_ERR_FORMAT, r->error, "unknown key %s%s%s%s",
        gm_yaml_show_text(entry->key, '\'', shown), near >= 0 ? "; did you mean '" : "",
        near >= 0 ? keys[near] : "", near >= 0 ? "'?" : "");
}

static void enter(gm_place *inner, const gm_place *outer, const gm_section *section)
{
    *inner = (gm_place){.section = section, .line = outer->line};
    memcpy(inner->element, outer->element, sizeof inner->element);
}

static void add_element(gm_place *p, const char *format, const char *word,
                        const char *name)
{
    size_t n = strlen(p->element);
    if (n > 0)
        n += (size_t)snprintf(p->element + n, sizeof p->element - n, ", ");
    if (n < sizeof p->element)
        (void)snprintf(p->element + n, sizeof p->element - n, format, word, name);
}

static gm_status read_group(const gm_field_reader *r, const gm_slot *s)
{
    gm_place inner;
    enter(&inner, s->in, s->field->section);
    add_element(&inner, "%s%s", s->field->key, "");
    inner.node = s->node;
    inner.line = s->node ? s->node->line : s->in->line;
    inner.base = s->target;
    return read_section(r, &inner);
}

static char *items_of(const gm_slot *s)
{
    char *items = s->target;
    if (!s->field->fixed_count)
        memcpy(&items, s->target, sizeof items);
    return items;
}

static gm_status read_items(const gm_field_reader *r, const gm_slot *s)
{
    const gm_section *section = s->field->section;
    char *items = items_of(s);
    gm_status status = GM_OK;
    for (int i = 0; i < s->node->n && status == GM_OK; i++) {
        const gm_yaml *node = s->node->item[i];
        char number[16];
        gm_place inner;
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

static gm_status read_value(const gm_field_reader *r, const gm_slot *s)
{
    if (s->field->type == GM_FIELD_GROUP)
        return read_group(r, s);
    if (s->field->type == GM_FIELD_ITEMS)
        return read_items(r, s);
    return gm_slot_read(r, s);
}

static void set_nothing(const gm_slot *s)
{
    const double nan = (double)NAN;
    const int housing = GM_HOUSING;
    if (s->field->type == GM_FIELD_NUMBER)
        memcpy(s->target, &nan, sizeof nan);
    if (s->field->type == GM_FIELD_REFERENCE)
        memcpy(s->target, &housing, sizeof housing);
}

static gm_status read_absent(const gm_field_reader *r, gm_slot *s)
{
    if (s->field->need == GM_NEED_VALUE) {
        char expected[EXPECTED];
        gm_schema_expectation(s->field, expected, sizeof expected);
        return gm_description_fail(r->file, s->in->line, s->in->element, GM_ERR_FORMAT,
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
    gm_yaml fallback = {.kind = GM_YAML_SCALAR,
                        .line = s->in->line,
                        .text = text,
                        .quoted = s->field->type == GM_FIELD_TEXT};
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

static gm_status label_name(const gm_field_reader *r, const gm_place *p,
                            const gm_section *section, const gm_yaml *node, char *item)
{
    char found[GM_YAML_SHOW];
    gm_label label = {.line = node->line};
    if (!valid_name(node->key))
        return gm_description_fail(
            r->file, node->line, p->element, GM_ERR_FORMAT, r->error,
            "the name of a %s must be a letter followed by letters, "
            "digits and _, at most %d, and not housing; found %s",
            section->word, GM_NAME_SIZE - 1, gm_yaml_show_text(node->key, '\'', found));
    memcpy(label.name, node->key, strlen(node->key) + 1);
    memcpy(item + section->label, &label, sizeof label);
    return GM_OK;
}

static gm_status label_number(const gm_field_reader *r, const gm_place *p,
                              const gm_section *section, const gm_yaml *node, char *item)
{
    char found[GM_YAML_SHOW];
    int number;
    if (!gm_text_to_int(node->key, &number) || number < section->low ||
        number > section->high)
        return gm_description_fail(
            r->file, node->line, p->element, GM_ERR_FORMAT, r->error,
            "the number of a %s must be a whole number from %.0f to %.0f, found %s",
            section->word, section->low, section->high,
            gm_yaml_show_text(node->key, '\'', found));
    memcpy(item + section->label, &number, sizeof number);
    memcpy(item + section->line, &node->line, sizeof node->line);
    return GM_OK;
}

static gm_status label_item(const gm_field_reader *r, const gm_place *p,
                            const gm_section *section, const gm_yaml *node, char *item)
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
static gm_status declare_items(const gm_field_reader *r, const gm_slot *s)
{
    const gm_field *f = s->field;
    gm_yaml_kind kind = f->section->key == GM_KEY_NONE ? GM_YAML_LIST : GM_YAML_MAPPING;
    if (s->node->kind != kind || s->node->n == 0)
        return gm_slot_wrong(r, s, "");
    if (f->fixed_count && s->node->n > f->fixed_count)
        return gm_description_fail(r->file, s->node->line, s->in->element, GM_ERR_FORMAT,
                                   r->error, "%s has at most %d entries, found %d",
                                   f->key, f->fixed_count, s->node->n);
    if (!f->fixed_count) {
        char *items = gm_calloc((size_t)s->node->n, f->section->size);
        if (!items)
            return out_of_memory(r);
        memcpy(s->target, &items, sizeof items);
    }
    memcpy(gm_slot_count(s), &s->node->n, sizeof s->node->n);
    gm_status status = GM_OK;
    for (int i = 0; i < s->node->n && status == GM_OK; i++)
        status = label_item(r, s->in, f->section, s->node->item[i],
                            items_of(s) + (size_t)i * f->section->size);
    return status;
}

static gm_slot slot_of(const gm_place *p, const gm_field *field, size_t offset)
{
    const gm_yaml *node = p->node ? gm_yaml_get(p->node, field->key) : NULL;
    return (gm_slot){p, field, node, p->base + offset};
}

static gm_status check_keys(const gm_field_reader *r, const gm_place *p)
{
    size_t offset;
    for (int i = 0; i < p->node->n; i++)
        if (!gm_schema_find(p->section, p->node->item[i]->key, &offset))
            return unknown_key(r, p, p->node->item[i]);
    return GM_OK;
}

/* A pass over all fields, inline ones included. */
static gm_status for_fields(const gm_field_reader *r, const gm_place *p,
                            const gm_section *section, size_t base,
                            gm_status (*visit)(const gm_field_reader *r, gm_slot *s))
{
    gm_status status = GM_OK;
    for (const gm_field *f = section->fields; f->key && status == GM_OK; f++) {
        gm_slot s = slot_of(p, f, base + f->offset);
        status = f->type == GM_FIELD_INLINE
                     ? for_fields(r, p, f->section, base + f->offset, visit)
                     : visit(r, &s);
    }
    return status;
}

static gm_status visit_declare(const gm_field_reader *r, gm_slot *s)
{
    return s->field->type == GM_FIELD_ITEMS && s->node ? declare_items(r, s) : GM_OK;
}

/* The word of a choice: as the file has it, or its fallback. */
static const char *chosen(const gm_place *p, const char *key)
{
    size_t offset;
    const gm_yaml *node = p->node ? gm_yaml_get(p->node, key) : NULL;
    return node ? node->text : gm_schema_find(p->section, key, &offset)->fallback;
}

/* A value that nothing reads is a mistake. The choice itself was read before. */
static gm_status check_effect(const gm_field_reader *r, const gm_slot *s)
{
    const gm_field *f = s->field;
    if (!f->only_key || !s->node)
        return GM_OK;
    const char *word = chosen(s->in, f->only_key);
    if (gm_schema_has_effect(f, word))
        return GM_OK;
    return gm_description_fail(r->file, s->node->line, s->in->element, GM_ERR_FORMAT,
                               r->error, "%s has an effect only with %s %s, found %s %s",
                               f->key, f->only_key, f->only_word, f->only_key, word);
}

static gm_status visit_read(const gm_field_reader *r, gm_slot *s)
{
    gm_status status = check_effect(r, s);
    if (status != GM_OK)
        return status;
    return s->node ? read_value(r, s) : read_absent(r, s);
}

static gm_status read_section(const gm_field_reader *r, const gm_place *p)
{
    char found[GM_YAML_SHOW];
    gm_status status = GM_OK;
    if (p->node && p->node->kind != GM_YAML_MAPPING)
        return gm_description_fail(r->file, p->line, p->element, GM_ERR_FORMAT, r->error,
                                   "expected a group of fields, found %s",
                                   gm_yaml_show(p->node, found));
    if (p->node)
        status = check_keys(r, p);
    if (status == GM_OK)
        status = for_fields(r, p, p->section, 0, visit_declare);
    if (status == GM_OK)
        status = for_fields(r, p, p->section, 0, visit_read);
    return status;
}

gm_status gm_fields_read(const char *file, const gm_section *root, const gm_yaml *tree,
                         void *base, gm_error *error)
{
    const gm_field_reader r = {file, root, base, error};
    const gm_place place = {
        .section = root, .node = tree, .base = base, .line = tree->line};
    return read_section(&r, &place);
}
