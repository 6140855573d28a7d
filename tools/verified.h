/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The result of a verification as a whole: on what it was measured, and what. Its JSON is
 * what `gearmap verify --json` prints and what a passport is made of.
 */
#ifndef VERIFIED_H
#define VERIFIED_H

#include "cycle_stage.h"
#include "stages.h"

/** What was compared with what; texts are empty where the component does not say. */
typedef struct gm_measured {
    char description_sha256[65]; /* of the detailed model */
    char made_from_sha256[65];   /* description that the component was made from */
    char map_hash[65], guid[64], library_sha256[65]; /* of the component */
} gm_measured;

/** GM_ERR_IO when the component's library cannot be read. */
GM_NODISCARD gm_status gm_measured_read(const gm_fmu *fmu, const gm_gearset_file *file,
                                        gm_measured *measured, gm_error *error);

/** Was the component made from the description that it was compared with? It may have
 *  changed in a comment only. */
bool gm_measured_same(const gm_measured *measured);

typedef struct gm_verified {
    gm_measured measured;
    const gm_verify_stage *steady; /* NULL: not done */
    const gm_cycle_stage *cycle;   /* NULL: not done */
} gm_verified;

/** Members of the JSON object. */
void gm_verified_json(const gm_verified *verified, gm_json *json);

/** The whole document; *text is the caller's, to be freed with gm_free. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_verified_text(const gm_verified *verified, char **text,
                                        gm_error *error);

#endif
