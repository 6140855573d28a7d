/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/rig_words.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { WORD = 32 };

static const char *const torque_words[] = {"tau",    "torque", "trq", "tq", "m",
                                           "moment", "mom",    "t",   NULL};
static const char *const speed_words[] = {"w",   "omega", "speed",    "n",   "rpm",
                                          "vel", "om",    "velocity", "spd", NULL};
static const char *const angle_words[] = {"phi", "angle", "theta", "ang", NULL};
static const char *const temperature_words[] = {"temperature", "temp", NULL};
static const char *const gear_words[] = {"gear",  "gang",     "lever",   "shift",
                                         "gears", "selector", "gearbox", NULL};
static const char *const oil_words[] = {"oil", "sump", "lubricant", NULL};
static const char *const plain_words[] = {
    "flange", "shaft", "cmd", "command", "act", "set", "ref", "number", "no", "nr", NULL};
static const char *const output_words[] = {
    "output", "out",  "wheel",      "wheels",       "load",    "secondary",
    "axle",   "diff", "driveshaft", "differential", "abtrieb", NULL};
static const char *const input_words[] = {"input", "in",      "engine", "eng", "motor",
                                          "mot",   "primary", "clutch", "odd", "even",
                                          "crank", "antrieb", NULL};
static const char *const outward_words[] = {
    "out of the",    "leaving the",        "delivered by",       "exerted by",
    "from the gear", "on the environment", "acting on the load", NULL};

static int is_one_of(const char *word, const char *const *list)
{
    for (; *list; list++)
        if (strcmp(word, *list) == 0)
            return 1;
    return 0;
}

/* The next word in small letters, empty at the end; returns what follows it. A word ends
   where a capital follows a small letter, or digits begin or end. */
static const char *next_word(const char *name, char word[WORD])
{
    size_t n = 0;
    while (*name && !isalnum((unsigned char)*name))
        name++;
    for (; isalnum((unsigned char)*name); name++) {
        int before = n > 0 ? (unsigned char)name[-1] : 0, here = (unsigned char)*name;
        if (n > 0 &&
            ((islower(before) && isupper(here)) || !isdigit(before) != !isdigit(here)))
            break;
        if (n + 1 < WORD)
            word[n++] = (char)tolower(here);
    }
    word[n] = '\0';
    return name;
}

static int has_one_of(const char *name, const char *const *list)
{
    char word[WORD];
    for (name = next_word(name, word); word[0]; name = next_word(name, word))
        if (is_one_of(word, list))
            return 1;
    return 0;
}

static rig_quantity by_name(const char *name)
{
    static const struct {
        const char *const *words;
        rig_quantity is;
    } all[] = {{temperature_words, RIG_TEMPERATURE},
               {oil_words, RIG_TEMPERATURE},
               {angle_words, RIG_ANGLE},
               {speed_words, RIG_SPEED},
               {torque_words, RIG_TORQUE}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (has_one_of(name, all[i].words))
            return all[i].is;
    return RIG_NONE;
}

rig_quantity gm_rig_words_quantity(const fmu_description *d, const fmu_variable *v)
{
    if (v->kind != FMU_REAL && v->kind != FMU_FLOAT32)
        return RIG_NONE;
    return v->unit && v->unit[0] ? gm_foreign_quantity(d, v->unit) : by_name(v->name);
}

int gm_rig_words_gear(const char *name)
{
    return has_one_of(name, gear_words);
}

int gm_rig_words_oil(const char *name)
{
    return has_one_of(name, oil_words);
}

static int says_where(const char *word)
{
    static const char *const *const others[] = {torque_words,      speed_words,
                                                angle_words,       gear_words,
                                                temperature_words, plain_words};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (is_one_of(word, others[i]))
            return 0;
    return 1;
}

void gm_rig_words_stem(const char *name, char stem[RIG_STEM])
{
    char word[WORD];
    size_t n = 0;
    stem[0] = '\0';
    for (name = next_word(name, word); word[0]; name = next_word(name, word))
        if (says_where(word) && n + strlen(word) + 2 < RIG_STEM)
            n += (size_t)snprintf(stem + n, RIG_STEM - n, "%s.", word);
}

int gm_rig_words_has(const char *stem, const char *wanted)
{
    char word[WORD];
    for (stem = next_word(stem, word); word[0]; stem = next_word(stem, word))
        if (strcmp(word, wanted) == 0)
            return 1;
    return 0;
}

int gm_rig_words_side(const char *stem)
{
    int output = has_one_of(stem, output_words), input = has_one_of(stem, input_words);
    return output - input;
}

int gm_rig_words_outward(const char *description)
{
    for (const char *const *words = outward_words; *words; words++)
        if (description && strstr(description, *words))
            return 1;
    return 0;
}
