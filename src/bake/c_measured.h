/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What tests/embedded/run.sh measures with the example gearset in float (gcc 12 -O2,
 * Cortex-M4F): bytes, and instructions of one step. It fails when a measured number is
 * larger than here.
 */
#ifndef C_MEASURED_H
#define C_MEASURED_H

#define GM_MEASURED_CODE 28000
#define GM_MEASURED_RAM 512
#define GM_MEASURED_STACK 1600
#define GM_MEASURED_RIGID_MEDIAN 2300
#define GM_MEASURED_RIGID_DRIVE 75000
#define GM_MEASURED_RIGID_WORST 115000
#define GM_MEASURED_LASH_MEDIAN 4650
#define GM_MEASURED_LASH_DRIVE 75000
#define GM_MEASURED_LASH_WORST 155000

#endif
