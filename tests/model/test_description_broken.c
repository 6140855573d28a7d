/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The random variations again, each with one thing broken that is drawn by lot: a key, a
 * number, a name, a ratio, the teeth of a gear. Every one is refused with the reason
 * and, but for geometry, with the line.
 */
#include "description_fixture.h"
#include "property.h"

#include "model/gm_gearset.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BROKEN GM_BINARY_DIR "/test_description_broken.yaml"
enum { VARIATIONS = 500, ROOM = 1 << 16, TOKENS = 2000 };

/* `key: value` with a value in one line that is no group and no list. */
typedef struct token {
    size_t key, key_end, value, value_end;
} token;

typedef struct text {
    char *bytes;
    token token[TOKENS];
    int n;
} text;

static int is_key(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static void find_tokens(text *t)
{
    t->n = 0;
    for (size_t at = 1; t->bytes[at] && t->n < TOKENS; at++) {
        if (t->bytes[at] != ':' || t->bytes[at + 1] != ' ' || !is_key(t->bytes[at - 1]))
            continue;
        token k = {at, at, at + 2, at + 2};
        while (k.key > 0 && is_key(t->bytes[k.key - 1]))
            k.key--;
        k.value_end += strcspn(t->bytes + k.value, ",}]\n");
        if (!strchr("{[\n", t->bytes[k.value]))
            t->token[t->n++] = k;
    }
    assert_in_range(t->n, 100, TOKENS - 1);
}

static int has_key(const text *t, const token *k, const char *key)
{
    size_t n = k->key_end - k->key;
    return strlen(key) == n && strncmp(t->bytes + k->key, key, n) == 0;
}

static int is_number(const text *t, const token *k)
{
    char c = t->bytes[k->value];
    return isdigit((unsigned char)c) || c == '-';
}

static int is_name(const text *t, const token *k)
{
    static const char *const keys[] = {"shaft",    "on",    "lock",   "gear",    "type",
                                       "friction", "model", "output", "churning"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (has_key(t, k, keys[i]))
            return 1;
    return 0;
}

static int any(const text *t, const token *k)
{
    (void)t, (void)k;
    return 1;
}

static int is_ratio(const text *t, const token *k)
{
    return has_key(t, k, "ratio");
}

static int is_teeth(const text *t, const token *k)
{
    return has_key(t, k, "teeth");
}

/* A way to break a token that suits it: what stands behind its key or in place of its
 * value, and what the sentence says. */
typedef struct damage {
    int (*suits)(const text *t, const token *k);
    const char *behind_key, *value;
    double factor; /* of the value; 0: value */
    const char *reason;
    int has_line;
} damage;

static const damage damages[] = {
    {any, "q", NULL, 0., "unknown key '", 1},
    {is_number, NULL, "many", 0., "found 'many'", 1},
    {is_number, NULL, "nan", 0., "found 'nan'", 1},
    {is_number, NULL, "-1e15", 0., "found '-1e15'", 1},
    {is_name, NULL, "nobody", 0., "'nobody'", 1},
    {is_ratio, NULL, NULL, 1.01, "ratio", 1},
    {is_teeth, NULL, NULL, 2., "", 0},
};
enum { DAMAGES = sizeof damages / sizeof damages[0] };

static int line_of(const char *bytes, size_t at)
{
    int line = 1;
    for (size_t i = 0; i < at; i++)
        line += bytes[i] == '\n';
    return line;
}

static void write_broken(const text *t, const token *k, const damage *d, char *to)
{
    char value[64];
    size_t n = k->value_end - k->value;
    (void)snprintf(value, sizeof value, "%.*s", (int)n, t->bytes + k->value);
    if (d->value)
        (void)snprintf(value, sizeof value, "%s", d->value);
    if (d->factor > 0.)
        (void)snprintf(value, sizeof value, "%.9g",
                       d->factor * strtod(t->bytes + k->value, NULL));
    (void)snprintf(to, ROOM, "%.*s%s: %s%s", (int)k->key_end, t->bytes,
                   d->behind_key ? d->behind_key : "", value, t->bytes + k->value_end);
}

static void check_refused(const text *t, const token *k, const damage *d)
{
    static char broken[ROOM];
    char place[512];
    gm_description *description = NULL;
    gm_gearset *gearset = NULL;
    gm_error error = {GM_OK, ""};
    write_broken(t, k, d, broken);
    gm_test_spill(BROKEN, broken);
    gm_status status = gm_description_read(BROKEN, &description, &error);
    if (status == GM_OK) /* ratios are known once it is assembled */
        status = gm_gearset_create(description, 353.15, &gearset, &error);
    gm_description_destroy(description);
    assert_null(gearset);
    int line = line_of(t->bytes, k->key);
    if (status != GM_ERR_FORMAT && status != GM_ERR_MODEL)
        fail_msg("line %d, '%s': status %d", line, d->reason, status);
    (void)snprintf(place, sizeof place, "%s:%d: ", BROKEN, line);
    size_t n = d->has_line ? strlen(place) : strlen(BROKEN);
    if (strncmp(error.message, place, n) != 0 || !strstr(error.message, d->reason))
        fail_msg("line %d, '%s': %s", line, d->reason, error.message);
}

static void a_broken_variation_is_refused_with_the_reason(void **state)
{
    (void)state;
    static text t;
    uint64_t seed = 500;
    for (int i = 0; i < VARIATIONS; i++) {
        char path[512];
        const damage *d = &damages[i % DAMAGES];
        (void)snprintf(path, sizeof path, GM_BINARY_DIR "/variations/variation_%04d.yaml",
                       i);
        t.bytes = gm_test_slurp(path);
        find_tokens(&t);
        const token *k;
        do
            k = &t.token[(int)(random_unit(&seed) * t.n)];
        while (!d->suits(&t, k));
        check_refused(&t, k, d);
        free(t.bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_broken_variation_is_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
