/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Instructions executed: exact on the emulated Cortex-M4F, always 0 elsewhere.
 */
#ifndef COUNTER_H
#define COUNTER_H

#include <stdint.h>

uint32_t counter_start(void);

/** Instructions since counter_start, both calls included: subtract counter_since of an
 *  empty stretch. At most about ten million. */
uint32_t counter_since(uint32_t start);

#endif
