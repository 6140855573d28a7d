/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/page.h"

#include <string.h>

/* Two halves: a text that is appended may have 1000 characters. */
static const char style[] =
    ":root{color-scheme:light dark;--ink:#1b1f24;--soft:#59636e;--line:#d1d9e0;"
    "--field:#f6f8fa;--paper:#fff}"
    "@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9198a1;--line:#3d444d;"
    "--field:#151b23;--paper:#0d1117}}"
    "body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);"
    "max-width:60rem;margin:0 auto;padding:1.5rem}"
    "h1{font-size:1.7rem;line-height:1.25;margin:.3em 0}"
    "h2{font-size:1.2rem;margin:2em 0 .5em;border-bottom:1px solid var(--line);"
    "padding-bottom:.2em}"
    "h3{font-size:1rem;margin:1.6em 0 .3em}"
    ".lead,.caption{color:var(--soft)}";
static const char more_style[] =
    ".figure{float:right;width:15.2rem;max-width:45%;margin:0 0 1rem 1.5rem}"
    ".figure img{width:100%}.caption{font-size:.85rem;line-height:1.35}"
    ".wide{overflow-x:auto;clear:both}table{border-collapse:collapse;"
    "font-size:.92rem}"
    "th,td{text-align:left;padding:.3em .7em;border-bottom:1px solid var(--line);"
    "vertical-align:top}th{background:var(--field);font-weight:600}"
    ".n{text-align:right;font-variant-numeric:tabular-nums}"
    "code{font:.92em ui-monospace,monospace;overflow-wrap:anywhere}"
    "@media print{body{max-width:none;padding:0;font-size:10pt}h2{break-after:avoid}"
    "tr{break-inside:avoid}}";

void gm_page_begin(gm_buffer *page, const char *title)
{
    gm_buffer_text(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
                         "<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                         "content=\"width=device-width\">\n<title>");
    gm_page_escaped(page, title);
    gm_buffer_text(page, "</title>\n<style>");
    gm_buffer_bytes(page, style, sizeof style - 1);
    gm_buffer_bytes(page, more_style, sizeof more_style - 1);
    gm_buffer_text(page, "</style>\n</head>\n<body>\n");
}

void gm_page_end(gm_buffer *page)
{
    gm_buffer_text(page, "</body>\n</html>\n");
}

void gm_page_escaped(gm_buffer *page, const char *text)
{
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '<')
            gm_buffer_text(page, "&lt;");
        else if (c == '>')
            gm_buffer_text(page, "&gt;");
        else if (c == '&')
            gm_buffer_text(page, "&amp;");
        else if (c >= 0x20)
            gm_buffer_bytes(page, text, 1);
    }
}

void gm_page_number(gm_buffer *page, const char *before, double value, int digits,
                    const char *after)
{
    char text[GM_NUMBER_TEXT];
    gm_buffer_text(page, "%s%s%s", before, gm_number_text(value, digits, text), after);
}

void gm_page_heading(gm_buffer *page, const char *text)
{
    gm_buffer_text(page, "<h2>%s</h2>\n", text);
}

void gm_page_table(gm_buffer *page, const char *heads)
{
    gm_buffer_text(page, "<div class=\"wide\"><table>\n<thead><tr>");
    while (*heads) {
        int right = *heads == '>';
        int n = (int)strcspn(heads + right, "|");
        gm_buffer_text(page, "<th%s>%.*s</th>", right ? " class=\"n\"" : "", n,
                       heads + right);
        heads += right + n;
        heads += *heads == '|';
    }
    gm_buffer_text(page, "</tr></thead>\n<tbody>\n");
}

void gm_page_table_end(gm_buffer *page)
{
    gm_buffer_text(page, "</tbody>\n</table></div>\n");
}
