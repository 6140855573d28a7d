/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the name of a variable tells about it. A name is words, parted by anything that is
 * no letter, by digits and by capitals: "tauIn", "input.tau", "T_oil_1".
 */
#ifndef RIG_WORDS_H
#define RIG_WORDS_H

#include "plant/foreign_units.h"

enum { RIG_STEM = 64 };

/** What a variable is: by its unit where it has one, else by its name. */
rig_quantity gm_rig_words_quantity(const fmu_description *d, const fmu_variable *v);

/** 1 when the name has a word for a gear or for what commands one. */
int gm_rig_words_gear(const char *name);

/** 1 when the name has a word for oil. */
int gm_rig_words_oil(const char *name);

/** The words that say where it is, in small letters, with a point after each: what stays
 *  without the words for quantities, gears and shafts. Cut where it is longer. */
void gm_rig_words_stem(const char *name, char stem[RIG_STEM]);

/** 1: the stem is of an output flange, -1: of an input flange, 0: it does not say. */
int gm_rig_words_side(const char *stem);

/** 1 when the words of the description say that torque counts out of the gearset. */
int gm_rig_words_outward(const char *description);

/** Does a stem have this word? */
int gm_rig_words_has(const char *stem, const char *word);

#endif
