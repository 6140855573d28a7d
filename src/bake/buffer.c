/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/buffer.h"

#include "base/alloc.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static bool reserve(gm_buffer *buffer, size_t more)
{
    size_t needed = buffer->size + more + 1;
    if (buffer->failed || needed < more)
        return false;
    if (needed <= buffer->room)
        return true;
    size_t room = needed > 2 * buffer->room ? needed + 256 : 2 * buffer->room;
    char *data = gm_resize(buffer->data, room, 1);
    if (!data) {
        buffer->failed = true;
        return false;
    }
    buffer->data = data;
    buffer->room = room;
    return true;
}

void gm_buffer_bytes(gm_buffer *buffer, const void *bytes, size_t n)
{
    if (!reserve(buffer, n))
        return;
    if (n > 0)
        memcpy(buffer->data + buffer->size, bytes, n);
    buffer->size += n;
    buffer->data[buffer->size] = '\0';
}

void gm_buffer_text(gm_buffer *buffer, const char *format, ...)
{
    char text[1001];
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (n < 0 || n >= (int)sizeof text)
        buffer->failed = true;
    else
        gm_buffer_bytes(buffer, text, (size_t)n);
}

/* Whatever the locale writes between the digits becomes a point. */
const char *gm_number_text(double value, int digits, char text[GM_NUMBER_TEXT])
{
    char raw[GM_NUMBER_TEXT];
    int n = 0;
    snprintf(raw, sizeof raw, "%.*g", digits, value);
    for (const char *c = raw; *c; c++) {
        if (strchr("0123456789+-einfa", *c))
            text[n++] = *c;
        else if (n > 0 && text[n - 1] != '.')
            text[n++] = '.';
    }
    text[n] = '\0';
    return text;
}

void gm_buffer_number(gm_buffer *buffer, double value)
{
    char text[GM_NUMBER_TEXT];
    gm_number_text(value, 17, text);
    gm_buffer_bytes(buffer, text, strlen(text));
}

void gm_buffer_clear(gm_buffer *buffer)
{
    gm_free(buffer->data);
    *buffer = (gm_buffer){0};
}
