/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A low-pass without delay: Butterworth of second order (bilinear transform, pre-warped),
 * run forward and backward, so that at the cut-off half of the amplitude is left.
 */
#ifndef LOW_PASS_H
#define LOW_PASS_H

/** Filter x[n], sampled every `step` s, in place. cut_off [Hz] below half the sampling
 *  rate. Edges: as if the signal went on with its end values. */
void gm_low_pass(double cut_off, double step, int n, double *x);

#endif
