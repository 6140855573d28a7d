/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The commands of gearmap, and the two ways in which one ends badly.
 */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "json.h"
#include "options.h"

enum { GM_EXIT_DONE = 0, GM_EXIT_FAILED = 1, GM_EXIT_USAGE = 2, GM_EXIT_SKIPPED = 3 };

extern const gm_command gm_command_check;
extern const gm_command gm_command_sweep;
extern const gm_command gm_command_bake;
extern const gm_command gm_command_reduce;
extern const gm_command gm_command_verify;
extern const gm_command gm_command_simulate;
extern const gm_command gm_command_report;
extern const gm_command gm_command_batch;
extern const gm_command gm_command_rig;

/** Exit code of a command that came to this status; its sentence goes to stderr. */
int gm_command_end(gm_status status, const gm_error *error);

/** The result of a command as text for people and as members of a JSON object. */
typedef struct gm_result_form {
    void (*print)(const void *result, FILE *out);
    void (*json)(const void *result, gm_json *json);
} gm_result_form;

/** Print a result on the standard output in one of its forms. GM_ERR_IO when it could not
 *  be written. */
GM_NODISCARD gm_status gm_command_print(const gm_result_form *form, int as_json,
                                        const void *result, gm_error *error);

#endif
