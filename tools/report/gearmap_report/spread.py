# SPDX-License-Identifier: BSD-2-Clause
"""Labels that would lie on each other, moved apart."""


def spread(heights, least):
    """The given heights, moved so that neighbours are at least so far apart, each as near
    to its place as the others let it: groups that touch stand around their own mean."""
    order = sorted(range(len(heights)), key=lambda i: heights[i])
    groups = []  # [sum of wanted height of the first label, count]
    for i in order:
        groups.append([heights[i], 1])
        while len(groups) > 1 and overlap(groups[-2], groups[-1], least):
            total, count = groups.pop()
            first = groups[-1]
            # a later label asks the first one to be as much lower as it stands behind it
            first[0] += total - count * first[1] * least
            first[1] += count
    moved = [total / count + k * least for total, count in groups for k in range(count)]
    out = [0.0] * len(heights)
    for place, i in enumerate(order):
        out[i] = moved[place]
    return out


def overlap(lower, upper, least):
    return lower[0] / lower[1] + lower[1] * least > upper[0] / upper[1]
