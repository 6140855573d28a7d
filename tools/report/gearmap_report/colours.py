# SPDX-License-Identifier: BSD-2-Clause
"""Colours that people with any colour vision tell apart, on light and on dark ground (each
has a contrast of 3:1 and more to both). After the set of Okabe and Ito (Color Universal
Design, 2008), darkened where it is too pale for lines on white. Lines and bars also
differ by dash, width, pattern or a label."""

RUNS = {"detailed": "#8a8f98", "rigid": "#c77700", "lash": "#2b83c6"}
NODE = "#8a8f98"
HELD_OUT = "#cf4a36"
COMPARED = "#1b2733"  # on the scales below
COMPONENTS = {  # colour and pattern
    "meshes": ("#2b83c6", ""),
    "bearings": ("#c77700", "/"),
    "idling gears": ("#12947d", ""),
    "seals": ("#b3579b", "x"),
    "open synchronisers": ("#8d8b1d", ""),
    "open clutches": ("#cf4a36", "."),
    "concentric shafts": ("#7a6fd0", "\\"),
    "churning": ("#4f9143", ""),
    "windage": ("#8a8f98", "-"),
    "oil jets": ("#a5795a", "+"),
}
# Light enough for black words on them, one hue each, darker where there is more.
MUCH_LOST = ("#fff9ea", "#fbe6b4", "#f5c974", "#e9a13d", "#d27c1f")
MUCH_KEPT = ("#f1f7fc", "#d3e5f4", "#aacde9", "#7bafdc", "#4c8fcb")
TWO_SIDED = "RdBu"
RISING = ("#7a6fd0", "#2b83c6", "#12947d", "#8d8b1d", "#c77700", "#cf4a36")


def mix(a, b, share):
    parts = [(int(a[i:i + 2], 16), int(b[i:i + 2], 16)) for i in (1, 3, 5)]
    return "#%02x%02x%02x" % tuple(round(x + share * (y - x)) for x, y in parts)


def of_levels(count):
    """From violet to red, as many as asked for."""
    found = []
    for i in range(count):
        at = i / max(1, count - 1) * (len(RISING) - 1)
        low = min(int(at), len(RISING) - 2)
        found.append(mix(RISING[low], RISING[low + 1], at - low))
    return found


def of_gears(numbers):
    """Forward gears rising, reverse grey."""
    forward = sorted(n for n in numbers if n > 0)
    return {**{n: "#8a8f98" for n in numbers}, **dict(zip(forward, of_levels(len(forward))))}
