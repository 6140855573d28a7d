/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The commands of gearmap, and the two ways in which one ends badly.
 */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "options.h"

enum { GM_EXIT_DONE = 0, GM_EXIT_FAILED = 1, GM_EXIT_USAGE = 2 };

extern const gm_command gm_command_check;
extern const gm_command gm_command_sweep;
extern const gm_command gm_command_bake;
extern const gm_command gm_command_reduce;
extern const gm_command gm_command_verify;

/** Exit code of a command that came to this status; its sentence goes to stderr. */
int gm_command_end(gm_status status, const gm_error *error);

#endif
