/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Pieces of a page of HTML.
 */
#ifndef PAGE_H
#define PAGE_H

#include "bake/buffer.h"

/** Everything before the body's content: title and style (dark where the reader's system
 *  is, plain in print). Everything after it. */
void gm_page_begin(gm_buffer *page, const char *title);
void gm_page_end(gm_buffer *page);

/** Text that may hold what HTML reads as markup. */
void gm_page_escaped(gm_buffer *page, const char *text);

/** A number with so many digits between two pieces of markup. */
void gm_page_number(gm_buffer *page, const char *before, double value, int digits,
                    const char *after);

/** A heading of the second level; an open table with these column heads ("|" between
 *  them, ">" before those of columns of numbers); its end. */
void gm_page_heading(gm_buffer *page, const char *text);
void gm_page_table(gm_buffer *page, const char *heads);
void gm_page_table_end(gm_buffer *page);

#endif
