/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The accuracy passport of a component (docs/passport.md): results of `gearmap verify`
 * that were measured on it, checked and put together.
 */
#ifndef PASSPORT_H
#define PASSPORT_H

#include "bake/buffer.h"
#include "bake/gm_bake.h"
#include "bake/json_document.h"

/** Results as they were read, in their order. Empty: nothing was measured. */
typedef struct gm_passport {
    int n;
    json_t **result; /* [n] */
} gm_passport;

/** Read and check n results for the component of this map and GUID. GM_ERR_FORMAT when
 *  one is none or two have steady errors, GM_ERR_MODEL when one belongs to another
 *  component, GM_ERR_MEMORY. Free with gm_passport_clear. */
GM_NODISCARD gm_status gm_passport_read(int n, const gm_bake_result *results,
                                        const gm_map *map, const char *guid,
                                        gm_passport *passport, gm_error *error);
void gm_passport_clear(gm_passport *passport);

/** The component that a passport is for. */
typedef struct gm_passport_component {
    const gm_map *map;
    const char *guid, *interpolation, *library_sha256;
} gm_passport_component;

/** Append the document. Memory failures are in buffer->failed. */
void gm_passport_write(const gm_passport *passport,
                       const gm_passport_component *component, gm_buffer *buffer);

/** The result with steady errors; NULL: there is none. */
const json_t *gm_passport_steady(const gm_passport *passport);

/** Result i if it has a cycle, else NULL. */
const json_t *gm_passport_cycle(const gm_passport *passport, int i);

/** Drive i of a cycle with the component, NULL after the last. A result with one drive
 *  has it as an object, one with several as an array. */
const json_t *gm_passport_run(const json_t *cycle, size_t i);

/** The object that has the run's errors. */
const json_t *gm_passport_figures(const json_t *cycle, const json_t *run);

#endif
