/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The number type of the core. One name, so that a controller build can choose another.
 */
#ifndef GM_REAL_H
#define GM_REAL_H

typedef double gm_real;

#endif
