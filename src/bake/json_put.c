/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/json_put.h"

#include "base/text.h"

#include <string.h>

/* Bytes that are no UTF-8 become U+FFFD: the document must be one whatever a map says. */
static void put_string(gm_buffer *buffer, const char *text)
{
    gm_buffer_bytes(buffer, "\"", 1);
    while (*text) {
        size_t n = gm_text_utf8_length(text, 4); /* stops at the end */
        if (*text == '"' || *text == '\\')
            gm_buffer_text(buffer, "\\%c", *text);
        else if ((unsigned char)*text < 0x20)
            gm_buffer_text(buffer, "\\u%04x", (unsigned)*text);
        else if (n == 0)
            gm_buffer_text(buffer, "\\ufffd");
        else
            gm_buffer_bytes(buffer, text, n);
        text += n > 0 ? n : 1;
    }
    gm_buffer_bytes(buffer, "\"", 1);
}

static void begin(gm_json_put *put, const char *key)
{
    if (put->filled)
        gm_buffer_text(put->buffer, ",");
    if (put->level > 0)
        gm_buffer_text(put->buffer, "\n%*s", put->level, "");
    put->filled = true;
    if (!key)
        return;
    put_string(put->buffer, key);
    gm_buffer_text(put->buffer, ": ");
}

void gm_json_put_open(gm_json_put *put, const char *key, char bracket)
{
    begin(put, key);
    gm_buffer_bytes(put->buffer, &bracket, 1);
    put->level++;
    put->filled = false;
}

void gm_json_put_close(gm_json_put *put, char bracket)
{
    put->level--;
    if (put->filled)
        gm_buffer_text(put->buffer, "\n%*s", put->level, "");
    gm_buffer_bytes(put->buffer, &bracket, 1);
    put->filled = true;
}

void gm_json_put_text(gm_json_put *put, const char *key, const char *text)
{
    begin(put, key);
    if (text)
        put_string(put->buffer, text);
    else
        gm_buffer_text(put->buffer, "null");
}

void gm_json_put_number(gm_json_put *put, const char *key, double value)
{
    char text[GM_NUMBER_TEXT];
    begin(put, key);
    gm_buffer_text(put->buffer, "%s", gm_number_text(value, 12, text));
}

static void put_word(gm_json_put *put, const char *key, const char *word)
{
    begin(put, key);
    gm_buffer_bytes(put->buffer, word, strlen(word));
}

static void put_inside(gm_json_put *put, const char *key, const gm_json_node *node)
{
    const bool object = node->kind == GM_JSON_OBJECT;
    gm_json_put_open(put, key, object ? '{' : '[');
    for (const gm_json_node *n = node->first; n; n = n->next)
        gm_json_put_node(put, n->key, n);
    gm_json_put_close(put, object ? '}' : ']');
}

void gm_json_put_node(gm_json_put *put, const char *key, const gm_json_node *node)
{
    switch (node ? node->kind : GM_JSON_NULL) {
    case GM_JSON_NULL:
        put_word(put, key, "null");
        return;
    case GM_JSON_FALSE:
        put_word(put, key, "false");
        return;
    case GM_JSON_TRUE:
        put_word(put, key, "true");
        return;
    case GM_JSON_NUMBER:
        put_word(put, key, node->text);
        return;
    case GM_JSON_TEXT:
        gm_json_put_text(put, key, node->text);
        return;
    case GM_JSON_ARRAY:
    case GM_JSON_OBJECT:
        put_inside(put, key, node);
    }
}
