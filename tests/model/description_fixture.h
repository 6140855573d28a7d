/* SPDX-License-Identifier: BSD-2-Clause
 *
 * For the tests of the description reader: the example, and changed copies of it.
 */
#ifndef DESCRIPTION_FIXTURE_H
#define DESCRIPTION_FIXTURE_H

#include "model/gm_description.h"

#define EXAMPLE GM_SOURCE_DIR "/examples/dct7.yaml"

/** The text of a file; the caller frees it. Like all here, fails the test on an error. */
char *gm_test_slurp(const char *path);
void gm_test_spill(const char *path, const char *text);

/** text with the first `find` replaced; the caller frees it. */
char *gm_test_replaced(const char *text, const char *find, const char *replace);

/** Line of the first `find` in text, from 1. */
int gm_test_line_of(const char *text, const char *find);

/** A description that must be valid. */
gm_description *gm_test_read(const char *path);

/** A rule broken in a copy of the example, and its sentence. */
typedef struct gm_test_rule {
    const char *find, *replace;
    const char *at;       /* text in the line that the message names; NULL: any line */
    const char *sentence; /* after file and line */
    gm_status status;
    const char *other; /* text in the line whose number ends the sentence; NULL: none */
} gm_test_rule;

/** Break it in a file; fails unless exactly that sentence comes. */
void gm_test_rule_answers(const char *example, const char *file,
                          const gm_test_rule *rule);

#endif
