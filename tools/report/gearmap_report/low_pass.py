# SPDX-License-Identifier: BSD-2-Clause
"""Second-order Butterworth, run forward and backward, so without delay: the same filter
as that of the comparison (src/vehicle/low_pass.c), for all columns at once."""
from math import pi, sqrt, tan

import numpy as np

CUT_OFF = 5.0  # Hz


def run(samples, b, a):
    out = np.empty_like(samples)
    x1 = x2 = y1 = y2 = samples[0]
    for i, x0 in enumerate(samples):
        y = b[0] * x0 + b[1] * x1 + b[2] * x2 - a[0] * y1 - a[1] * y2
        x1, x2, y1, y2 = x0, x1, y, y1
        out[i] = y
    return out


def low_pass(samples, step, cut_off=CUT_OFF):
    """samples[time][column] at equal steps [s]."""
    k = tan(pi * cut_off * step)
    norm = 1.0 / (1.0 + sqrt(2.0) * k + k * k)
    b = (k * k * norm, 2.0 * k * k * norm, k * k * norm)
    a = (2.0 * (k * k - 1.0) * norm, (1.0 - sqrt(2.0) * k + k * k) * norm)
    return run(run(np.asarray(samples, float), b, a)[::-1], b, a)[::-1]
