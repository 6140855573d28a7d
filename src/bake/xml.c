/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/xml.h"

#include "bake/buffer.h"
#include "base/text.h"

#include <libxml/xmlwriter.h>
#include <stdio.h>

void gm_xml_start(xml *x, const char *element)
{
    x->failed |= xmlTextWriterStartElement(x->writer, BAD_CAST element) < 0;
}

void gm_xml_end(xml *x)
{
    x->failed |= xmlTextWriterEndElement(x->writer) < 0;
}

void gm_xml_text(xml *x, const char *name, const char *value)
{
    x->failed |=
        xmlTextWriterWriteAttribute(x->writer, BAD_CAST name, BAD_CAST value) < 0;
}

void gm_xml_foreign_text(xml *x, const char *name, const char *value)
{
    char clean[GM_MAP_TEXT + 32];
    bool utf8 = xmlCheckUTF8(BAD_CAST value) != 0;
    snprintf(clean, sizeof clean, "%s", value);
    for (char *c = clean; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f ||
            (!utf8 && (unsigned char)*c >= 0x80))
            *c = '?';
    gm_xml_text(x, name, clean);
}

void gm_xml_integer(xml *x, const char *name, long value)
{
    char digits[32];
    snprintf(digits, sizeof digits, "%ld", value);
    gm_xml_text(x, name, digits);
}

void gm_xml_number(xml *x, const char *name, double value)
{
    char digits[GM_NUMBER_TEXT];
    double again = 0.0;
    for (int n = 15; n <= 17; n++) {
        gm_number_text(value, n, digits);
        if (gm_text_to_double(digits, &again) && again >= value && again <= value)
            break;
    }
    gm_xml_text(x, name, digits);
}
