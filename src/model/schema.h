/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Schema of a file (the description, a vehicle): one table per section, from which
 * reading, unknown keys, types, units, ranges, defaults and the reference text are
 * derived.
 *
 * The unit of a number is the end of its key (width_mm, viscosity_40_mm2_s), so that key,
 * unit and factor cannot disagree.
 */
#ifndef SCHEMA_H
#define SCHEMA_H

#include <stdbool.h>
#include <stddef.h>

typedef enum gm_field_type {
    GM_FIELD_NUMBER,     /* double, in SI */
    GM_FIELD_INTEGER,    /* int */
    GM_FIELD_BOOLEAN,    /* int 0 or 1 */
    GM_FIELD_WORDS,      /* char[GM_NAME_SIZE], one line of text */
    GM_FIELD_TEXT,       /* char *, owned */
    GM_FIELD_CHOICE,     /* int-sized enum */
    GM_FIELD_REFERENCE,  /* int: index of a named part */
    GM_FIELD_REFERENCES, /* list of references: int[fixed_count], or int * with a count */
    GM_FIELD_LOCKS,      /* one name or a list of names, which may be empty, of parts of
                            `section` or of `other`: gm_lock * with a count */
    GM_FIELD_GROUP,      /* a section, in place */
    GM_FIELD_ITEMS,      /* several items of a section, in memory of their own */
    GM_FIELD_INLINE      /* the section's fields stand among those of the outer one */
} gm_field_type;

typedef struct gm_choice {
    const char *word;
    int value;
} gm_choice;

/** What happens when the key is absent. */
typedef enum gm_need {
    GM_NEED_VALUE,   /* an error */
    GM_NEED_DEFAULT, /* the fallback is read in its place */
    GM_NEED_NOTHING  /* number: NAN; reference: GM_HOUSING; text: empty; items: none */
} gm_need;

/** What an open limit of a range excludes. */
typedef enum gm_open { GM_CLOSED = 0, GM_OPEN_LOW = 1, GM_OPEN_HIGH = 2 } gm_open;

typedef struct gm_section gm_section;

typedef struct gm_field {
    const char *key;
    gm_field_type type;
    gm_need need;
    const char *fallback; /* as it would stand in the file */
    double low, high;     /* number and integer: range in the file's unit */
    gm_open open;
    const gm_choice *choices;  /* ended by a NULL word */
    const gm_section *section; /* group, items, inline; references: what they name */
    const gm_section *other;   /* locks: what they can name besides */
    size_t offset;             /* of the value in the outer section's structure */
    size_t count_offset;       /* items, references: of the int count; 0: none */
    int fixed_count;           /* references: exactly so many; items: at most, in place */
    const char *only_key;  /* has an effect only where this choice of the section ... */
    const char *only_word; /* ... is this word, or one of "a, b or c"; NULL: always */
    const char *help;
} gm_field;

/** How an item of a section is called in the file. */
typedef enum gm_item_key {
    GM_KEY_NONE,   /* a list: counted from 1 */
    GM_KEY_NAME,   /* a mapping by name; gm_label at offset `label` */
    GM_KEY_INTEGER /* a mapping by number; int at offset `label` */
} gm_item_key;

struct gm_section {
    const char *title; /* "gears" */
    const char *word;  /* one of them: "gear" */
    const char *help;
    const gm_field *fields; /* ended by a NULL key */
    size_t size;
    gm_item_key key;
    size_t label;
    size_t line;            /* offset of the int line of unnamed items */
    double low, high;       /* GM_KEY_INTEGER: range; low may not be high */
    const char *collection; /* key in the file of what a reference can name */
};

/** A unit of the file: SI value = (value + offset) * factor / divisor. */
typedef struct gm_unit {
    const char *suffix; /* of the key */
    const char *name;   /* for people */
    double offset, factor, divisor;
} gm_unit;

/** The description file. */
const gm_section *gm_schema_root(void);

/** Unit of a number's key; the one without suffix for pure numbers. Never NULL. */
const gm_unit *gm_schema_unit(const char *key);

/** SI value of a number in a unit. */
double gm_unit_to_si(const gm_unit *unit, double value);

/** The field of that key, looking into inline sections; NULL when there is none.
 *  *offset receives the offset in the outer structure. */
const gm_field *gm_schema_find(const gm_section *section, const char *key,
                               size_t *offset);

/** Keys of a section, inline ones included, into keys[max]; returns their number. */
int gm_schema_keys(const gm_section *section, const char **keys, int max);

/** Whether a field with only_key has an effect beside that choice. */
bool gm_schema_has_effect(const gm_field *field, const char *choice);

/** Reference of a file format: calls write with successive pieces of Markdown text. */
void gm_schema_help(const gm_section *root,
                    void (*write)(void *context, const char *text), void *context);

/** What the field must be, such as "a number in mm greater than 0". */
void gm_schema_expectation(const gm_field *field, char *text, size_t size);

enum { GM_MAX_KEYS = 48 }; /* of one section */

#endif
