/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random damage to examples: bytes changed, inserted, deleted, lines repeated or
 * removed, the end cut off. Whatever comes out, the reader answers with a description or
 * with one line that begins with the file's name. Run under the sanitizers this is the
 * test that nothing is read or written out of bounds and nothing leaks.
 */
#include "model/gm_gearset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define EXAMPLES GM_SOURCE_DIR "/examples/"
#define CHANGED GM_BINARY_DIR "/test_description_fuzz.yaml"
enum { ROUNDS = 3000, ROOM = 1 << 16 };

static uint64_t seed = 20240229;

/* Knuth's MMIX generator; the high bits are good. */
static uint32_t draw(uint32_t below)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(seed >> 33) % below;
}

typedef struct text {
    char bytes[ROOM];
    size_t n;
} text;

static void cut(text *t, size_t at, size_t n)
{
    n = at + n > t->n ? t->n - at : n;
    memmove(t->bytes + at, t->bytes + at + n, t->n - at - n);
    t->n -= n;
}

static void insert(text *t, size_t at, const char *what, size_t n)
{
    if (t->n + n > ROOM)
        return;
    memmove(t->bytes + at + n, t->bytes + at, t->n - at);
    memmove(t->bytes + at, what, n);
    t->n += n;
}

/* Words and signs that mean something to YAML or to the schema. */
static void insert_token(text *t)
{
    static const char *const tokens[] = {":",        "- ",          "{",
                                         "}",        "[",           "]",
                                         "\n",       "  ",          "#",
                                         "\"",       "'",           "&a ",
                                         "*a",       "!t ",         "|\n",
                                         ">\n",      "%",           "@",
                                         "? ",       "---\n",       "...\n",
                                         "\t",       "\r",          "null",
                                         "true",     "-",           "1e309",
                                         "nan",      "0x1",         "housing",
                                         "odd:",     "bearing: {}", "\xef\xbb\xbf",
                                         "\xc2\x85", "\x01"};
    const char *token = tokens[draw(sizeof tokens / sizeof tokens[0])];
    insert(t, draw((uint32_t)t->n + 1), token, strlen(token));
}

static size_t line_start(const text *t, size_t at)
{
    while (at > 0 && t->bytes[at - 1] != '\n')
        at--;
    return at;
}

static void damage_line(text *t)
{
    char line[512];
    size_t start = line_start(t, draw((uint32_t)t->n)), n = 0;
    while (start + n < t->n && n + 1 < sizeof line && t->bytes[start + n] != '\n')
        n++;
    n += start + n < t->n;
    memcpy(line, t->bytes + start, n);
    if (draw(2))
        cut(t, start, n);
    else
        insert(t, line_start(t, draw((uint32_t)t->n)), line, n);
}

static void damage(text *t)
{
    char byte;
    if (t->n < 2)
        return;
    switch (draw(7)) {
    case 0:
        t->bytes[draw((uint32_t)t->n)] = (char)draw(256);
        break;
    case 1:
        cut(t, draw((uint32_t)t->n), 1 + draw(8));
        break;
    case 2:
        byte = (char)(' ' + (char)draw(95));
        insert(t, draw((uint32_t)t->n), &byte, 1);
        break;
    case 3:
        insert_token(t);
        break;
    case 4:
        if (draw(8) == 0)
            t->n = 1 + draw((uint32_t)t->n - 1);
        break;
    case 5:
        t->bytes[draw((uint32_t)t->n)] = (char)('0' + (char)draw(10));
        break;
    default:
        damage_line(t);
        break;
    }
}

static void save(const text *t)
{
    FILE *f = fopen(CHANGED, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(t->bytes, 1, t->n, f), t->n);
    assert_int_equal(fclose(f), 0);
}

/* What was taken can be assembled or has a reason; no number of it is a NAN. */
static void assemble(const gm_description *d)
{
    gm_gearset *gearset = NULL;
    gm_error error = {GM_OK, ""};
    if (gm_gearset_create(d, d->oil.temperature, &gearset, &error) != GM_OK) {
        assert_int_equal(strncmp(error.message, CHANGED ":", strlen(CHANGED) + 1), 0);
        return;
    }
    for (int g = 0; g < d->paths[0].n_gears; g++) {
        gm_kinematics k;
        int gear[GM_MAX_INPUT_PATHS] = {d->paths[0].gears[g].number, 0};
        if (d->n_paths > 1)
            gear[1] = gm_path_rest_gear(&d->paths[1]);
        assert_int_equal(gm_gearset_kinematics(gearset, gear, &k, NULL), GM_OK);
        assert_true(k.ratio[0] == k.ratio[0] && k.inertia_total > 0.0 &&
                    k.inertia_output > 0.0);
    }
    gm_gearset_destroy(gearset);
}

static void check_answer(int *read, int *refused)
{
    gm_description *d = NULL;
    gm_error error = {GM_OK, ""};
    gm_status status = gm_description_read(CHANGED, &d, &error);
    if (status == GM_OK) {
        (*read)++;
        assert_non_null(d);
        assemble(d);
    } else {
        (*refused)++;
        assert_true(status == GM_ERR_FORMAT || status == GM_ERR_MODEL);
        assert_null(d);
        assert_int_equal(strncmp(error.message, CHANGED ":", strlen(CHANGED) + 1), 0);
        assert_null(strpbrk(error.message, "\n\r\t"));
    }
    gm_description_destroy(d);
}

static void any_damage_gives_a_description_or_one_line(void **state)
{
    (void)state;
    static const char *const files[] = {EXAMPLES "dct7.yaml", EXAMPLES "at3_simpson.yaml",
                                        EXAMPLES "at4_ravigneaux.yaml",
                                        EXAMPLES "ev1.yaml"};
    static text original, t;
    int read = 0, refused = 0;
    for (int i = 0; i < ROUNDS; i++) {
        FILE *f = fopen(files[i % 4], "rb");
        assert_non_null(f);
        original.n = fread(original.bytes, 1, ROOM, f);
        assert_int_equal(fclose(f), 0);
        t = original;
        for (uint32_t k = 1 + draw(4); k > 0; k--)
            damage(&t);
        save(&t);
        check_answer(&read, &refused);
    }
    /* both outcomes are really taken: damage in a comment is harmless */
    assert_true(read > ROUNDS / 50);
    assert_true(refused > ROUNDS / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_damage_gives_a_description_or_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
