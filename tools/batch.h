/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Many reductions at once: variants of a gearset, each in a process of its own, as many
 * as there are cores. What one does, even a crash, does not touch the others; memory is
 * that of so many single reductions.
 *
 *   FOLDER/NAME.fmu, NAME.map   of every variant that is done
 *   FOLDER/batch.csv            a row for each: what it was made from, and its errors
 *
 * A variant with a row in the table whose key is that of its description, the options and
 * this program, and whose component is the one in the row, is not done again.
 */
#ifndef BATCH_H
#define BATCH_H

#include "files.h"
#include "reduction.h"

#define GM_BATCH_NAME 128
#define GM_BATCH_MESSAGE 768

typedef enum gm_variant_state {
    GM_VARIANT_WAITING,
    GM_VARIANT_RUNNING,
    GM_VARIANT_DONE,
    GM_VARIANT_KEPT, /* done by an earlier run */
    GM_VARIANT_FAILED
} gm_variant_state;

/** "waiting", "running", "done", "kept", "failed". */
const char *gm_variant_state_name(gm_variant_state state);

/** What a reduction came to. Errors are those of points with one path engaged, of the
 *  largest loss of each gear. */
typedef struct gm_variant_outcome {
    long points;
    double elapsed; /* s */
    double max_error, rms_error;
    int missed;  /* tables that missed the tolerance */
    int skipped; /* points at which a foreign model failed */
    char fmu_sha256[65];
    char message[GM_BATCH_MESSAGE]; /* of a failure */
} gm_variant_outcome;

typedef struct gm_variant {
    char *description;        /* path; owned */
    char name[GM_BATCH_NAME]; /* of its files, unlike those of all others */
    char key[65];             /* hash of all that it depends on */
    gm_variant_state state;
    gm_variant_outcome outcome;
} gm_variant;

typedef struct gm_batch {
    const char *folder; /* for the output */
    int n;
    gm_variant *variants; /* [n] in the order of the list; a folder's by name */
    int n_passed_over;
    char **passed_over; /* [n_passed_over] files of the folder that are no gearsets */
    int cores;
    double elapsed; /* s */
} gm_batch;

/** The variants of a folder (its files .yaml and .yml that describe gearsets or rigs) or
 *  of a list (a text file, one path in a line, from where the list is; # begins a
 *  comment), each once. GM_ERR_IO, GM_ERR_FORMAT: there are none; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_batch_find(const char *source, gm_batch *batch,
                                     gm_error *error);
void gm_batch_clear(gm_batch *batch);

/** Path of a variant's file with this ending. GM_ERR_IO when it is too long. */
GM_NODISCARD gm_status gm_batch_path(const gm_batch *batch, const gm_variant *variant,
                                     const char *ending, char path[GM_PATH_SIZE],
                                     gm_error *error);

/** Compute the keys; variants that are done already become GM_VARIANT_KEPT. GM_ERR_IO,
 *  GM_ERR_FORMAT: the table is damaged; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_batch_resume(gm_batch *batch, const gm_reduce_settings *common,
                                       gm_error *error);

/** Write the table of all that is done, kept or failed. GM_ERR_IO. */
GM_NODISCARD gm_status gm_batch_write_table(const gm_batch *batch, gm_error *error);

/** Reduce all that waits, with the settings that the variants have in common and at most
 *  batch->cores processes. Failures are in the variants. GM_ERR_INTERRUPTED: a signal
 *  stopped it; GM_ERR_IO: the table cannot be written, GM_ERR_TOOL: no more processes. */
GM_NODISCARD gm_status gm_batch_run(gm_batch *batch, const gm_reduce_settings *common,
                                    gm_error *error);

#endif
