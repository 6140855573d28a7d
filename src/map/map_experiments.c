/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How the values of a map were found: entries of the table `meta` that no reader needs.
 */
#include "map/gm_map_file.h"
#include "map/map_amend.h"
#include "map/map_db.h"

#define PUT "INSERT OR REPLACE INTO meta (key, value, unit) VALUES (?, ?, ?)"

typedef struct entry {
    const char *key, *text; /* text NULL: a number */
    double number;
    const char *unit;
} entry;

static gm_status put_entry(const gm_db *db, const entry *e, gm_error *error)
{
    sqlite3_stmt *put;
    gm_status status = gm_db_prepare(db, PUT, &put, error);
    if (status == GM_OK) {
        (void)sqlite3_bind_text(put, 1, e->key, -1, SQLITE_STATIC);
        if (e->text)
            (void)sqlite3_bind_text(put, 2, e->text, -1, SQLITE_STATIC);
        else
            (void)sqlite3_bind_double(put, 2, e->number);
        (void)sqlite3_bind_text(put, 3, e->unit, -1, SQLITE_STATIC);
        status = gm_db_step(db, put, error);
    }
    (void)sqlite3_finalize(put);
    return status;
}

static gm_status put_all(const gm_db *db, const void *what, gm_error *error)
{
    const gm_map_experiments *e = what;
    const entry entries[] = {
        {"losses_by", e->losses, 0.0, NULL},
        {"inertia_by", e->inertia, 0.0, NULL},
        {"loss_uncertainty", NULL, e->loss_uncertainty, "N.m"},
        {"inertia_uncertainty", NULL, e->inertia_uncertainty, "1"},
        {"skipped_points", NULL, e->n_skipped, NULL},
    };
    gm_status status = GM_OK;
    for (size_t i = 0; i < sizeof entries / sizeof *entries && status == GM_OK; i++)
        status = put_entry(db, &entries[i], error);
    return status;
}

gm_status gm_map_put_experiments(const char *path, const gm_map_experiments *experiments,
                                 gm_error *error)
{
    return gm_amend(path, put_all, experiments, error);
}
