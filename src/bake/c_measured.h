/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What tests/embedded/run.sh measures with the example gearset in float (gcc 12 -O2,
 * Cortex-M4F): bytes, and instructions of one step. It fails when a measured number is
 * larger than here.
 */
#ifndef C_MEASURED_H
#define C_MEASURED_H

#define GM_MEASURED_CODE 26900
#define GM_MEASURED_RAM 492
#define GM_MEASURED_STACK 1600
#define GM_MEASURED_RIGID_MEDIAN 2250
#define GM_MEASURED_RIGID_DRIVE 113300
#define GM_MEASURED_RIGID_WORST 800000
#define GM_MEASURED_LASH_MEDIAN 4550
#define GM_MEASURED_LASH_DRIVE 245000
#define GM_MEASURED_LASH_WORST 1500000

#endif
