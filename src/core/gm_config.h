/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How the core keeps its numbers. Libraries and FMUs compute in double; in the folder of
 * plain C for a controller this is the one file of the core that the generator writes.
 */
#ifndef GM_CONFIG_H
#define GM_CONFIG_H

#define GM_REAL_IS_FLOAT 0   /* 1: float instead of double */
#define GM_NODES_ARE_INT16 0 /* 1: tables hold int16_t and a scale */
#define GM_CURVED 1          /* 0: no table is monotone, all are linear */
#define GM_OIL_AXIS 1        /* 0: tables hold for one oil temperature only */

#endif
