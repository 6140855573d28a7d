/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The map's file: SQLite, schema in docs/map.md. While a sweep runs, "<map>.part" beside
 * it is its journal: it holds every solved point, whatever ends the program. A map never
 * exists half-written under its name.
 */
#ifndef GM_MAP_FILE_H
#define GM_MAP_FILE_H

#include "map/gm_map.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Read a finished map; on success *map is the caller's. One sentence and GM_ERR_IO when
 *  the file cannot be opened; GM_ERR_FORMAT when it is not a map, of another format
 *  version, an unfinished sweep, truncated or damaged (its content does not give its
 *  content hash); GM_ERR_MEMORY. What is allocated is bounded by the size of the file. */
GM_NODISCARD gm_status gm_map_read(const char *path, gm_map **map, gm_error *error);

/** A finished map as the bytes of its file, without measured errors. The same map gives
 *  the same bytes (of the same SQLite). *bytes is the caller's, to be freed with gm_free.
 *  GM_ERR_FORMAT when the map is not complete, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_to_bytes(const gm_map *map, unsigned char **bytes,
                                       size_t *size, gm_error *error);

/** One point at which the component was compared, loss torques as in its case. */
typedef struct gm_map_error_point {
    double speed, torque;     /* of the path [rad/s, N.m] */
    double detailed, reduced; /* N.m */
} gm_map_error_point;

/** Error of the component that was made from a map, measured at points not on its grid.
 */
typedef struct gm_map_error {
    const char *kind;       /* of points, such as "single" or "both_loaded" */
    const char *path;       /* the loaded or free path */
    int gear[GM_MAX_PATHS]; /* numbers, 0 neutral; gear[1] GM_MAP_ANY with one path */
    int direction;          /* +1, -1: rotation of the output */
    int points;
    double largest, max, rms;         /* largest loss of the case, errors [N.m] */
    double worst_speed, worst_torque; /* where the largest error is [rad/s, N.m] */
    int n_points; /* that are kept one by one; 0: none, and none when read back */
    const gm_map_error_point *point; /* [n_points] */
} gm_map_error;

/** What was measured on the component that was made from a map. */
typedef struct gm_map_verification {
    long long seed; /* of the points */
    int n_errors;
    const gm_map_error *errors; /* [n_errors] */
    int n_results;
    const char *const *results; /* [n_results] as `gearmap verify --json` prints them */
} gm_map_verification;

/** Write what was measured into a finished map's file (tables `verification`,
 *  `verification_point`, `result`), in place of what is there, all of it or nothing. Map
 *  and content hash stay as they are. GM_ERR_IO, GM_ERR_FORMAT. */
GM_NODISCARD gm_status gm_map_put_verification(const char *path,
                                               const gm_map_verification *verification,
                                               gm_error *error);

/** The measured errors in a map's file: *errors[*n], NULL and 0 when there are none. Free
 *  with gm_map_errors_free. GM_ERR_IO, GM_ERR_FORMAT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_get_errors(const char *path, int *n, gm_map_error **errors,
                                         gm_error *error);
void gm_map_errors_free(int n, gm_map_error *errors);

/** The results in a map's file: *results[*n], NULL and 0 when there are none. Free with
 *  gm_map_results_free. GM_ERR_IO, GM_ERR_FORMAT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_get_results(const char *path, int *n, char ***results,
                                          gm_error *error);
void gm_map_results_free(int n, char **results);

/** How the values of a map were found, and how far they may be off. */
typedef struct gm_map_experiments {
    const char *losses, *inertia; /* such as "settle", "ramps" */
    double loss_uncertainty;      /* N.m, largest of any value; 0: solved */
    double inertia_uncertainty;   /* relative, largest; 0: of the mass matrix */
    int n_skipped;                /* points that come from their neighbours */
} gm_map_experiments;

/** Write that into a finished map's file (entries of `meta`), in place of what is there.
 *  Map and content hash stay as they are. GM_ERR_IO, GM_ERR_FORMAT. */
GM_NODISCARD gm_status gm_map_put_experiments(const char *path,
                                              const gm_map_experiments *experiments,
                                              gm_error *error);

/** Keep the text of the description that a map was made from in the map's file (table
 *  `description`), in place of one that is there. Map and content hash stay as they are.
 *  GM_ERR_IO, GM_ERR_FORMAT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_put_description(const char *path, const char *text,
                                              size_t size, gm_error *error);

/** A sweep's journal beside the map to be: records of one size, of which the sweep knows
 *  the meaning (the points that it has solved). */
typedef struct gm_journal gm_journal;

/** Open or create "<path>.part" for a map whose names, gear numbers and options are set.
 *  record: bytes of each record, 1 to 4096. Records that an earlier run of the same sweep
 *  (same tool version, input hash, options, gears and record size) put are there again,
 *  see gm_journal_records. The journal of another sweep, and a damaged one, are begun
 *  anew. GM_ERR_IO when the place cannot be written, another sweep is writing this
 *  journal, or a file that is no journal is in the way; GM_ERR_FORMAT when the map's
 *  frame is wrong; GM_ERR_MEMORY. On failure nothing new is left behind. */
GM_NODISCARD gm_status gm_journal_open(const char *path, const gm_map *map, size_t record,
                                       gm_journal **journal, gm_error *error);

/** The *count records found when the journal was opened, in the order of their putting;
 *  the journal's. */
const void *gm_journal_records(const gm_journal *journal, long *count);

/** Keep n more records, all or none. Safe against a killed program from the moment it
 *  returns. Not thread-safe. GM_ERR_IO, such as no space left. */
GM_NODISCARD gm_status gm_journal_put(gm_journal *journal, const void *records, int n,
                                      gm_error *error);

/** The map is complete: put the content hash into *map, write its file whole and give it
 *  its final name; the journal goes. The same map gives the same bytes. Negative zeros
 *  become zeros, which is what SQLite keeps. GM_ERR_FORMAT when the map is not complete,
 *  GM_ERR_IO, GM_ERR_MEMORY: then the journal stays, to be resumed. *journal is closed
 *  and gone in any case. */
GM_NODISCARD gm_status gm_journal_finish(gm_journal *journal, gm_map *map,
                                         gm_error *error);

/** Close. keep: the file stays, to be resumed; else it is removed. NULL is fine. */
void gm_journal_close(gm_journal *journal, bool keep);

#ifdef __cplusplus
}
#endif
#endif
