/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The table of a batch, batch.csv: for people, and to know what need not be done again.
 */
#include "batch.h"

#include "base/csv.h"
#include "base/sha256.h"
#include "plant/gm_rig_file.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

enum {
    COLUMN_NAME,
    COLUMN_STATE,
    COLUMN_POINTS,
    COLUMN_ELAPSED,
    COLUMN_MAX,
    COLUMN_RMS,
    COLUMN_MISSED,
    COLUMN_SKIPPED,
    COLUMN_FMU,
    COLUMN_KEY,
    N_COLUMNS
};
static const char *const columns[N_COLUMNS] = {
    "name",         "state",         "points",         "elapsed_s",  "max_relative",
    "rms_relative", "missed_tables", "skipped_points", "fmu_sha256", "key"};

static gm_status table_path(const gm_batch *batch, char path[GM_PATH_SIZE],
                            gm_error *error)
{
    if (snprintf(path, GM_PATH_SIZE, "%s/batch.csv", batch->folder) < GM_PATH_SIZE)
        return GM_OK;
    return gm_fail(error, GM_ERR_IO, "%.60s...: the path is too long", batch->folder);
}

/* ---- keys ---- */

/* Everything among the settings that changes a result; not the number of threads. */
static void hash_settings(gm_sha256 *sum, const gm_reduce_settings *s)
{
    const double number[] = {s->sweep.speed_step,      s->sweep.torque_step,
                             s->sweep.speed_max,       s->sweep.torque_max,
                             s->sweep.tolerance.share, s->sweep.tolerance.torque,
                             s->sweep.dwell,           s->sweep.ramp_time};
    const char *const text[] = {s->sweep.losses, s->sweep.inertia, s->bake.interpolation,
                                s->bake.compiler};
    for (size_t i = 0; i < sizeof number / sizeof *number; i++)
        gm_sha256_double(sum, number[i]);
    gm_sha256_int(sum, s->sweep.oil.n);
    for (int i = 0; i < s->sweep.oil.n; i++)
        gm_sha256_double(sum, s->sweep.oil.value[i]);
    gm_sha256_int(sum, s->points);
    gm_sha256_int(sum, s->seed);
    for (size_t i = 0; i < sizeof text / sizeof *text; i++)
        gm_sha256_text(sum, text[i] ? text[i] : "");
}

/* Hash of a description, or of a rig file and its model. */
static gm_status hash_source(const char *path, char text[GM_SHA256_TEXT], gm_error *error)
{
    gm_rig_file *rig = NULL;
    if (!gm_rig_file_is_one(path))
        return gm_sha256_file(path, text, error);
    gm_status status = gm_rig_file_read(path, &rig, error);
    if (status != GM_OK)
        return status;
    memcpy(text, rig->sha256, GM_SHA256_TEXT);
    gm_rig_file_destroy(rig);
    return GM_OK;
}

/* What cannot be read has no key: its reduction says why. */
static gm_status find_key(gm_variant *v, const char *program,
                          const gm_reduce_settings *common, gm_error *error)
{
    char content[GM_SHA256_TEXT];
    gm_error unreadable;
    if (hash_source(v->description, content, &unreadable) != GM_OK)
        return GM_OK;
    gm_sha256 *sum = gm_sha256_create();
    if (!sum)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for a hash");
    gm_sha256_text(sum, program);
    gm_sha256_text(sum, content);
    hash_settings(sum, common);
    gm_sha256_finish(sum, v->key);
    gm_sha256_destroy(sum);
    return GM_OK;
}

/* ---- reading ---- */

typedef struct row {
    const char *text[N_COLUMNS];
    double number[N_COLUMNS];
} row;

static gm_status read_cells(const gm_csv *csv, row *r, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < N_COLUMNS; i++)
        r->text[i] = "";
    for (int i = 0; i < gm_csv_n_columns(csv) && status == GM_OK; i++) {
        int column = gm_csv_column(csv, i);
        r->text[column] = gm_csv_cell(csv, i);
        if (column >= COLUMN_POINTS && column <= COLUMN_SKIPPED)
            status = gm_csv_number(csv, i, &r->number[column], error);
    }
    return status;
}

static bool has_component(const gm_batch *batch, const gm_variant *v, const char *sha256)
{
    char path[GM_PATH_SIZE], found[GM_SHA256_TEXT];
    gm_error error;
    return gm_batch_path(batch, v, ".fmu", path, &error) == GM_OK &&
           gm_sha256_file(path, found, &error) == GM_OK && strcmp(found, sha256) == 0;
}

static void take_row(const gm_batch *batch, const row *r)
{
    const char *state = r->text[COLUMN_STATE];
    if (strcmp(state, "done") != 0 && strcmp(state, "kept") != 0)
        return;
    for (int i = 0; i < batch->n; i++) {
        gm_variant *v = &batch->variants[i];
        if (strcmp(v->name, r->text[COLUMN_NAME]) != 0 || !v->key[0] ||
            strcmp(v->key, r->text[COLUMN_KEY]) != 0 ||
            !has_component(batch, v, r->text[COLUMN_FMU]))
            continue;
        v->state = GM_VARIANT_KEPT;
        v->outcome = (gm_variant_outcome){.points = (long)r->number[COLUMN_POINTS],
                                          .elapsed = r->number[COLUMN_ELAPSED],
                                          .max_error = r->number[COLUMN_MAX],
                                          .rms_error = r->number[COLUMN_RMS],
                                          .missed = (int)r->number[COLUMN_MISSED],
                                          .skipped = (int)r->number[COLUMN_SKIPPED]};
        (void)snprintf(v->outcome.fmu_sha256, sizeof v->outcome.fmu_sha256, "%s",
                       r->text[COLUMN_FMU]);
    }
}

static gm_status read_table(gm_batch *batch, const char *path, gm_error *error)
{
    gm_csv *csv = NULL;
    row r = {{NULL}, {0.0}};
    bool more = true;
    gm_status status = gm_csv_open(path, &csv, error);
    if (status == GM_OK)
        status = gm_csv_read_header(csv, columns, N_COLUMNS, "name", error);
    while (status == GM_OK && more) {
        status = gm_csv_read_row(csv, &more, error);
        if (status == GM_OK && more)
            status = read_cells(csv, &r, error);
        if (status == GM_OK && more)
            take_row(batch, &r);
    }
    gm_csv_close(csv);
    return status;
}

gm_status gm_batch_resume(gm_batch *batch, const gm_reduce_settings *common,
                          gm_error *error)
{
    char path[GM_PATH_SIZE], program[GM_SHA256_TEXT];
    gm_status status = gm_sha256_file("/proc/self/exe", program, error);
    for (int i = 0; i < batch->n && status == GM_OK; i++)
        status = find_key(&batch->variants[i], program, common, error);
    if (status == GM_OK)
        status = table_path(batch, path, error);
    if (status != GM_OK || access(path, F_OK) != 0)
        return status;
    return read_table(batch, path, error);
}

/* ---- writing ---- */

static void write_rows(const gm_batch *batch, FILE *out)
{
    for (int i = 0; i < N_COLUMNS; i++)
        fprintf(out, "%s%s", i > 0 ? "," : "", columns[i]);
    fputc('\n', out);
    for (int i = 0; i < batch->n; i++) {
        const gm_variant *v = &batch->variants[i];
        const gm_variant_outcome *o = &v->outcome;
        if (v->state == GM_VARIANT_WAITING || v->state == GM_VARIANT_RUNNING)
            continue;
        fprintf(out, "%s,%s,%ld,%.3f,%.9g,%.9g,%d,%d,%s,%s\n", v->name,
                gm_variant_state_name(v->state), o->points, o->elapsed, o->max_error,
                o->rms_error, o->missed, o->skipped, o->fmu_sha256, v->key);
    }
}

static gm_status unwritable(const char *path, gm_error *error)
{
    return gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
}

gm_status gm_batch_write_table(const gm_batch *batch, gm_error *error)
{
    char path[GM_PATH_SIZE], own[GM_PATH_SIZE];
    gm_status status = table_path(batch, path, error);
    if (status == GM_OK)
        status = gm_file_own_name(path, own, error);
    if (status != GM_OK)
        return status;
    FILE *out = fopen(own, "w");
    if (!out)
        return unwritable(path, error);
    write_rows(batch, out);
    bool bad = fflush(out) != 0 || ferror(out);
    bad |= fclose(out) != 0;
    if (bad || rename(own, path) != 0) {
        status = unwritable(path, error);
        (void)unlink(own);
    }
    return status;
}
