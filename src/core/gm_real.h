/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The number type of the core: double, or float where gm_config.h says so. Fractions in
 * the core are written as GM_NUM(0.1), so that float stays float, and a limit that has to
 * do with digits or range as GM_BY_TYPE(for double, for float).
 */
#ifndef GM_REAL_H
#define GM_REAL_H

#include "gm_config.h"

#if GM_REAL_IS_FLOAT
typedef float gm_real;
#define GM_NUM(x) x##f
#define GM_BY_TYPE(for_double, for_float) for_float##f
#else
typedef double gm_real;
#define GM_NUM(x) x
#define GM_BY_TYPE(for_double, for_float) for_double
#endif

#endif
