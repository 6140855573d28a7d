/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Strict reading of comma-separated values with a line of column names. Lines that are
 * empty or begin with # are passed over. Nothing is guessed: an unknown column, a cell
 * too many, a line too long is refused with file, line, what was found and expected.
 */
#ifndef CSV_H
#define CSV_H

#include "base/gm_status.h"

#include <stdbool.h>

enum { GM_CSV_COLUMNS = 64, GM_CSV_LINE = 4096 };

typedef struct gm_csv gm_csv;

/** Open a file. On success *csv is the caller's (gm_csv_close); path must outlive it.
 *  GM_ERR_IO, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_csv_open(const char *path, gm_csv **csv, gm_error *error);
void gm_csv_close(gm_csv *csv);

/** Read the names of the columns. known[n_known] (kept, n_known <= GM_CSV_COLUMNS): all
 *  that there may be; usual: some of them, for the sentence about an unknown one.
 *  GM_ERR_FORMAT: none, unknown or twice; GM_ERR_IO. */
GM_NODISCARD gm_status gm_csv_read_header(gm_csv *csv, const char *const *known,
                                          int n_known, const char *usual,
                                          gm_error *error);

/** Is the known column in the file? */
bool gm_csv_has(const gm_csv *csv, int known);

/** Columns in the file's order, as indices of known. */
int gm_csv_n_columns(const gm_csv *csv);
int gm_csv_column(const gm_csv *csv, int i);

/** Read the next row; *more is false at the end of the file. GM_ERR_FORMAT when it has
 *  not one cell for each column; GM_ERR_IO. */
GM_NODISCARD gm_status gm_csv_read_row(gm_csv *csv, bool *more, gm_error *error);

/** Cell of the i-th column of the file in the present row, without blanks around it;
 *  valid until the next row is read. */
const char *gm_csv_cell(const gm_csv *csv, int i);

/** Number in that cell; where it is none, GM_ERR_FORMAT. */
GM_NODISCARD gm_status gm_csv_number(const gm_csv *csv, int i, double *value,
                                     gm_error *error);

/** "file:line: column c: found 'x', expected …". Returns GM_ERR_FORMAT. */
GM_NODISCARD gm_status gm_csv_wrong(const gm_csv *csv, int i, const char *expected,
                                    gm_error *error);

/** Line of the present row, or of the header before the first. */
int gm_csv_line(const gm_csv *csv);

#endif
