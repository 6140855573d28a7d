/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The schema in words: what a field must be (for messages), and the reference of the
 * whole format (for the help and docs/description.md).
 */
#include "model/gm_description.h"
#include "model/schema.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Appends to text[size], cutting silently: callers give enough room. */
GM_PRINTF(3, 4)
static void add(char *text, size_t size, const char *format, ...)
{
    size_t n = strlen(text);
    va_list args;
    va_start(args, format);
    (void)vsnprintf(text + n, size - n, format, args);
    va_end(args);
}

static void add_range(const gm_field *field, char *text, size_t size)
{
    if (field->low == field->high) {
        add(text, size, " %.15g", field->low);
        return;
    }
    add(text, size, field->open & GM_OPEN_LOW ? " greater than %.15g" : " from %.15g",
        field->low);
    add(text, size, "%s%.15g",
        field->open & GM_OPEN_HIGH  ? " and less than "
        : field->open & GM_OPEN_LOW ? " and up to "
                                    : " to ",
        field->high);
}

static void add_choices(const gm_field *field, char *text, size_t size)
{
    for (const gm_choice *c = field->choices; c->word; c++)
        add(text, size, "%s%s",
            c == field->choices ? ""
            : c[1].word         ? ", "
                                : " or ",
            c->word);
}

static void add_number(const gm_field *field, char *text, size_t size)
{
    const gm_unit *unit = gm_schema_unit(field->key);
    add(text, size, "a number%s%s", unit->name[0] ? " in " : "", unit->name);
    add_range(field, text, size);
}

static void add_references(const gm_field *field, char *text, size_t size)
{
    if (field->fixed_count)
        add(text, size, "a list of %d names of %s", field->fixed_count,
            field->section->title);
    else
        add(text, size, "a list of names of %s", field->section->title);
}

void gm_schema_expectation(const gm_field *field, char *text, size_t size)
{
    text[0] = '\0';
    switch (field->type) {
    case GM_FIELD_NUMBER:
        add_number(field, text, size);
        break;
    case GM_FIELD_INTEGER:
        add(text, size, field->low == field->high ? "the number" : "a whole number");
        add_range(field, text, size);
        break;
    case GM_FIELD_BOOLEAN:
        add(text, size, "true or false");
        break;
    case GM_FIELD_WORDS:
        add(text, size, "one line of 1 to %d bytes", GM_NAME_SIZE - 1);
        break;
    case GM_FIELD_TEXT:
        add(text, size, "text");
        break;
    case GM_FIELD_CHOICE:
        add_choices(field, text, size);
        break;
    case GM_FIELD_REFERENCE:
        add(text, size, "the name of a %s%s", field->section->word,
            field->need == GM_NEED_NOTHING ? " or housing" : "");
        break;
    case GM_FIELD_REFERENCES:
        add_references(field, text, size);
        break;
    case GM_FIELD_LOCKS:
        add(text, size, "the name of a %s or a %s, or a list of such names",
            field->section->word, field->other->word);
        break;
    case GM_FIELD_GROUP:
    case GM_FIELD_INLINE:
        add(text, size, "a group of fields");
        break;
    case GM_FIELD_ITEMS:
        add(text, size, "%s",
            field->section->key == GM_KEY_NONE ? "a list of groups of fields"
            : field->section->key == GM_KEY_NAME
                ? "groups of fields, each under its name"
                : "groups of fields, each under its number");
        break;
    }
}

typedef struct writer {
    const gm_section *root;
    void (*write)(void *context, const char *text);
    void *context;
} writer;

/* - `key`: what it is (what it must be, default ...) */
static void write_field(const writer *w, const gm_field *field)
{
    char text[256];
    gm_schema_expectation(field, text, sizeof text);
    if (field->need == GM_NEED_DEFAULT && field->fallback && field->fallback[0])
        add(text, sizeof text, ", default %s", field->fallback);
    else if (field->need != GM_NEED_VALUE)
        add(text, sizeof text, ", optional");
    if (field->only_key)
        add(text, sizeof text, ", only with %s %s", field->only_key, field->only_word);
    const char *const pieces[] = {"- `", field->key, "`: ", field->help,
                                  " (",  text,       ")\n"};
    for (size_t i = 0; i < sizeof pieces / sizeof pieces[0]; i++)
        w->write(w->context, pieces[i]);
}

static void write_fields(const writer *w, const gm_section *section)
{
    for (const gm_field *f = section->fields; f->key; f++) {
        if (f->type == GM_FIELD_INLINE)
            write_fields(w, f->section);
        else
            write_field(w, f);
    }
}

static void write_section(const writer *w, const char *path, const gm_section *section);

/* Sections inside, those of inline sections too. */
static void write_inner(const writer *w, const char *path, const gm_section *section)
{
    for (const gm_field *f = section->fields; f->key; f++) {
        char inner[128];
        (void)snprintf(inner, sizeof inner, "%s%s%s", section == w->root ? "" : path,
                       section == w->root ? "" : " / ", f->key);
        if (f->type == GM_FIELD_INLINE)
            write_inner(w, path, f->section);
        else if (f->type == GM_FIELD_GROUP || f->type == GM_FIELD_ITEMS)
            write_section(w, inner, f->section);
    }
}

static void write_section(const writer *w, const char *path, const gm_section *section)
{
    w->write(w->context, "### ");
    w->write(w->context, path);
    w->write(w->context, "\n\n");
    w->write(w->context, section->help);
    w->write(w->context, "\n\n");
    write_fields(w, section);
    w->write(w->context, "\n");
    write_inner(w, path, section);
}

void gm_schema_help(const gm_section *root,
                    void (*write)(void *context, const char *text), void *context)
{
    const writer w = {root, write, context};
    write_section(&w, "The file", root);
}

void gm_description_help(void (*write)(void *context, const char *text), void *context)
{
    gm_schema_help(gm_schema_root(), write, context);
}
