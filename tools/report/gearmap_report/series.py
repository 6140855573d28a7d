# SPDX-License-Identifier: BSD-2-Clause
"""Drives over time as a small block of bytes for the page's script.

Every series has 16 bits a sample over its own range, which is finer than any screen, kept
as differences, so that what compresses well is smooth. Drives longer than LONGEST samples
are thinned: of every few samples their smallest and largest stay, so peaks do.
"""
import base64
import gzip
from math import ceil

import numpy as np

LONGEST = 40000
LEVELS = 65535


def thin(values, every):
    """Smallest and largest of every so many samples, in the order of their times."""
    count = len(values) // every
    blocks = values[:count * every].reshape(count, every)
    low, high = blocks.argmin(axis=1), blocks.argmax(axis=1)
    rows = np.arange(count)
    first, second = np.minimum(low, high), np.maximum(low, high)
    return np.stack([blocks[rows, first], blocks[rows, second]], axis=1).ravel()


def quantised(values):
    low, high = float(values.min()), float(values.max())
    span = high - low or 1.0
    levels = np.rint((values - low) / span * LEVELS).astype(np.int64)
    steps = np.diff(levels, prepend=0) % (LEVELS + 1)
    return low, span / LEVELS, steps.astype("<u2").tobytes()


def pack(series, step):
    """series: {name: samples}, all as long; step [s]. Text for the script: facts as a
    dict, bytes as base64 of gzip."""
    length = len(next(iter(series.values())))
    every = 2 * ceil(length / LONGEST) if length > LONGEST else 1
    facts, blocks = {}, []
    for name, values in series.items():
        values = np.asarray(values, float)
        if every > 1:
            values = thin(values, every)
        low, scale, block = quantised(values)
        facts[name] = [len(blocks), low, scale]
        blocks.append(block)
    kept = len(blocks[0]) // 2
    about = {"n": kept, "step": step * length / kept if every > 1 else step,
             "thinned": every > 1, "series": facts}
    return about, compressed(b"".join(blocks))


def compressed(data):
    """mtime 0: the same bytes give the same text."""
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode("ascii")
