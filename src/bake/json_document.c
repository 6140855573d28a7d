/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/json_document.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

gm_status gm_document_read(const char *name, const char *text, json_t **document,
                           gm_error *error)
{
    json_error_t found;
    json_t *made = json_loads(text, JSON_REJECT_DUPLICATES, &found);
    if (made) {
        *document = made;
        return GM_OK;
    }
    if (json_error_code(&found) == json_error_out_of_memory)
        return gm_fail(error, GM_ERR_MEMORY, "%s: no memory to read it", name);
    return gm_fail(error, GM_ERR_FORMAT, "%s:%d: is not JSON: %s", name, found.line,
                   found.text);
}

double gm_member_number(const json_t *object, const char *key)
{
    const json_t *member = json_object_get(object, key);
    return json_is_number(member) ? json_number_value(member) : (double)NAN;
}

const char *gm_member_text(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

json_t *gm_document_text(const char *text)
{
    gm_buffer valid = {0};
    json_t *made = NULL;
    if (!text)
        return json_null();
    gm_buffer_bytes(&valid, "", 0);
    while (*text) {
        size_t n = gm_text_utf8_length(text, 4); /* stops at the end */
        if (n > 0)
            gm_buffer_bytes(&valid, text, n);
        else
            gm_buffer_bytes(&valid, "\xef\xbf\xbd", 3);
        text += n > 0 ? n : 1;
    }
    if (!valid.failed)
        made = json_string(valid.data);
    gm_buffer_clear(&valid);
    return made;
}

static int append(const char *bytes, size_t n, void *buffer)
{
    gm_buffer *to = buffer;
    gm_buffer_bytes(to, bytes, n);
    return to->failed ? -1 : 0;
}

void gm_document_write(const json_t *document, gm_buffer *buffer)
{
    if (!document || json_dump_callback(document, append, buffer,
                                        JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0)
        buffer->failed = true;
    gm_buffer_text(buffer, "\n");
}
