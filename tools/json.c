/* SPDX-License-Identifier: BSD-2-Clause
 *
 * JSON by RFC 8259; see json.h.
 */
#include "json.h"

#include "base/text.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static void put_string(FILE *out, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', out);
    while (*s != '\0') {
        size_t n = gm_text_utf8_length((const char *)s, 4); /* stops at the end */
        if (*s == '"' || *s == '\\')
            fprintf(out, "\\%c", *s);
        else if (*s < 0x20)
            fprintf(out, "\\u%04x", *s);
        else if (n == 0)
            fputs("\\ufffd", out);
        else
            fwrite(s, 1, n, out);
        s += n > 0 ? n : 1;
    }
    fputc('"', out);
}

static void next_line(gm_json *json)
{
    if (!json->one_line)
        fprintf(json->out, "\n%*s", 2 * json->depth, "");
}

static void begin_member(gm_json *json, const char *key)
{
    bool *filled = &json->filled[json->depth - 1];
    if (*filled)
        fputs(json->one_line ? ", " : ",", json->out);
    *filled = true;
    next_line(json);
    if (key) {
        put_string(json->out, key);
        fputs(": ", json->out);
    }
}

static void open_level(gm_json *json, char open, char close)
{
    assert(json->depth < GM_JSON_DEPTH);
    fputc(open, json->out);
    json->close[json->depth] = close;
    json->filled[json->depth] = false;
    json->depth++;
}

void gm_json_start(gm_json *json, FILE *out)
{
    memset(json, 0, sizeof *json);
    json->out = out;
    open_level(json, '{', '}');
}

void gm_json_start_line(gm_json *json, FILE *out)
{
    gm_json_start(json, out);
    json->one_line = true;
}

void gm_json_end(gm_json *json)
{
    assert(json->depth > 0);
    json->depth--;
    if (json->filled[json->depth])
        next_line(json);
    fputc(json->close[json->depth], json->out);
}

void gm_json_finish(gm_json *json)
{
    assert(json->depth == 1);
    gm_json_end(json);
    fputc('\n', json->out);
}

void gm_json_object(gm_json *json, const char *key)
{
    begin_member(json, key);
    open_level(json, '{', '}');
}

void gm_json_array(gm_json *json, const char *key)
{
    begin_member(json, key);
    open_level(json, '[', ']');
}

void gm_json_text(gm_json *json, const char *key, const char *text)
{
    begin_member(json, key);
    if (text)
        put_string(json->out, text);
    else
        fputs("null", json->out);
}

void gm_json_number(gm_json *json, const char *key, double value)
{
    begin_member(json, key);
    if (isfinite(value))
        fprintf(json->out, "%.17g", value);
    else
        fputs("null", json->out);
}

void gm_json_integer(gm_json *json, const char *key, long long value)
{
    begin_member(json, key);
    fprintf(json->out, "%lld", value);
}

void gm_json_bool(gm_json *json, const char *key, bool value)
{
    begin_member(json, key);
    fputs(value ? "true" : "false", json->out);
}
