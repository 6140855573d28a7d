/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The section of the FMU's page that tells how accurate it is, as its passport has it.
 */
#ifndef ACCURACY_H
#define ACCURACY_H

#include "bake/passport.h"

/** Append the section. Memory failures are in buffer->failed. */
void gm_accuracy_write(const gm_passport *passport, gm_buffer *page);

#endif
