# SPDX-License-Identifier: BSD-2-Clause
"""Pieces of SVG as text. Colours come from the page's style sheet, by class."""
from html import escape


def number(value):
    return ("%.2f" % value).rstrip("0").rstrip(".")


def attributes(given):
    text = ""
    for name, value in given.items():
        if value is None:
            continue
        name = name.rstrip("_").replace("_", "-")
        shown = number(value) if isinstance(value, float) else str(value)
        text += ' %s="%s"' % (name, escape(shown, quote=True))
    return text


def tag(name, content="", **given):
    return "<%s%s>%s</%s>" % (name, attributes(given), content, name)


def frame(content, box, unit, label, kind):
    """A whole picture. box: x, y, width, height; unit: its lengths in one pixel when it is
    shown as large as it is meant to be, so that words are as large in every picture."""
    return tag("svg", content, viewBox=" ".join(number(v) for v in box), role="img",
               aria_label=label, class_=kind,
               style="--unit:%.4f;--natural:%dpx" % (unit, round(box[2] / unit)))


def text(x, y, words, **given):
    return tag("text", escape(words), x=float(x), y=float(y), **given)


def title(words):
    return tag("title", escape(words))


def rect(x0, x1, y0, y1, content="", **given):
    """Between two x and two y, in any order."""
    return tag("rect", content, x=float(min(x0, x1)), y=float(min(y0, y1)),
               width=float(abs(x1 - x0)), height=float(abs(y1 - y0)), **given)


def line(x0, y0, x1, y1, **given):
    return tag("line", x1=float(x0), y1=float(y0), x2=float(x1), y2=float(y1), **given)


def circle(x, y, r, content="", **given):
    return tag("circle", content, cx=float(x), cy=float(y), r=float(r), **given)


def polyline(points, **given):
    path = " ".join("%s,%s" % (number(float(x)), number(float(y))) for x, y in points)
    return tag("polyline", points=path, **given)
