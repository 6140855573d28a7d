/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The text of the description beside the map that was made from it, so that a map alone
 * can tell what it is of. The SHA-256 of the text is input_sha256 of the map; it does not
 * go into baked components, which need not tell how the gearset is built.
 */
#include "map/gm_map_file.h"
#include "map/map_amend.h"

#include <limits.h>

static const char create[] = "CREATE TABLE IF NOT EXISTS description (\n"
                             "  text TEXT NOT NULL\n"
                             ");\n"
                             "DELETE FROM description";

typedef struct description {
    const char *text;
    size_t size;
} description;

static gm_status put_description(const gm_db *db, const void *what, gm_error *error)
{
    const description *d = what;
    sqlite3_stmt *put = NULL;
    gm_status status = gm_db_run(db, create, error);
    if (status == GM_OK)
        status = gm_db_prepare(db, "INSERT INTO description VALUES (?)", &put, error);
    if (status == GM_OK) {
        (void)sqlite3_bind_text(put, 1, d->text, (int)d->size, SQLITE_STATIC);
        status = gm_db_step(db, put, error);
    }
    (void)sqlite3_finalize(put);
    return status;
}

gm_status gm_map_put_description(const char *path, const char *text, size_t size,
                                 gm_error *error)
{
    const description d = {text, size};
    if (size > INT_MAX)
        return gm_fail(error, GM_ERR_ARGUMENT, "a description of %zu bytes is too long",
                       size);
    return gm_amend(path, put_description, &d, error);
}
