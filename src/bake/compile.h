/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Runs the C compiler on the component's sources: found in the path and started directly,
 * without a shell, with its messages caught.
 */
#ifndef COMPILE_H
#define COMPILE_H

#include "base/gm_status.h"

typedef struct gm_compiler {
    char path[512];      /* program that will be started */
    char arguments[512]; /* given after it, separated by spaces */
} gm_compiler;

/** Find the compiler: `wanted` when it is not NULL, else $CC, else cc, gcc, clang. The
 *  two texts are split at spaces: the first word names the program, the others precede
 *  what the component needs (-O3 wins over another level). GM_ERR_TOOL with the names
 *  that were tried. */
GM_NODISCARD gm_status gm_compiler_find(const char *wanted, gm_compiler *compiler,
                                        gm_error *error);

/** Compile sources[n] (file names in folder) into the library `output`, also in folder.
 *  Nothing in the library depends on the folder's name. GM_ERR_TOOL with the first lines
 *  of the compiler's messages, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_compile(const gm_compiler *compiler, const char *folder, int n,
                                  const char *const *sources, const char *output,
                                  gm_error *error);

#endif
