/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What was found for a rig file, between its finding and its writing.
 */
#ifndef RIG_GUESS_H
#define RIG_GUESS_H

#include "model/gm_steady.h"
#include "plant/gm_rig_guess.h"
#include "plant/rig_words.h"

enum { RIG_GUESS_FLANGES = 16 };

/** A shaft: torque in and speed out, or the other way round. */
typedef struct rig_flange_guess {
    const fmu_variable *torque, *speed;
    const fmu_variable *angle; /* NULL: none is taken */
    int takes_speed;
    int by_elimination; /* 1: their names do not go together */
    char stem[RIG_STEM];
} rig_flange_guess;

typedef struct rig_guess {
    const fmu_description *of;
    int n_paths;
    rig_flange_guess flange[GM_MAX_FLANGES]; /* output first */
    int sides_guessed; /* 1: the names do not say which flange is which */
    const fmu_variable *gear[GM_MAX_INPUT_PATHS]; /* NULL: none */
    int gear_guessed[GM_MAX_INPUT_PATHS];
    const fmu_variable *oil; /* NULL: none */
    int oil_guessed;
} rig_guess;

/** Name of path p in the rig file. */
const char *gm_rig_guess_path(const rig_guess *g, int p);

/** Write what was found. */
void gm_rig_guess_write(const rig_guess *g, const gm_rig_hints *hints,
                        void (*write)(void *context, const char *text), void *context,
                        gm_rig_guess_summary *summary);

#endif
