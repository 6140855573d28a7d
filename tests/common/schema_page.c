/* SPDX-License-Identifier: BSD-2-Clause */
#include "common/schema_page.h"

#include "common/test_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#define BEGIN "<!-- from the schema: begin -->\n"
#define FINISH "<!-- from the schema: end -->\n"

typedef struct buffer {
    char text[1 << 16];
    size_t n;
} buffer;

static void collect(void *context, const char *text)
{
    buffer *b = context;
    size_t n = strlen(text);
    assert_true(b->n + n < sizeof b->text);
    memcpy(b->text + b->n, text, n + 1);
    b->n += n;
}

static void write_fields(const buffer *fields, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", GM_BINARY_DIR, name);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(fields->text, 1, fields->n, out), fields->n);
    assert_int_equal(fclose(out), 0);
}

void schema_page_check(schema_page_help *help, const char *page, const char *name)
{
    static buffer fields;
    static char text[1 << 17];
    fields.n = 0;
    help(collect, &fields);
    write_fields(&fields, name);
    test_file_load(page, text, sizeof text);
    char *begin = strstr(text, BEGIN), *end = strstr(text, FINISH);
    assert_non_null(begin);
    assert_non_null(end);
    *end = '\0';
    assert_string_equal(begin + strlen(BEGIN), fields.text);
}
