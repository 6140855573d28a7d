/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Pages in docs/ that have a list of fields between two marks, made from the schema that
 * the reader of those files works with.
 */
#ifndef SCHEMA_PAGE_H
#define SCHEMA_PAGE_H

/** How a room tells its fields: emit is called with one piece of text after the other. */
typedef void schema_page_help(void (*emit)(void *context, const char *text),
                              void *context);

/** The page has what help tells, to the letter. What it should have is written to
 *  name in the build folder: copy that between the marks to renew the page. */
void schema_page_check(schema_page_help *help, const char *page, const char *name);

#endif
