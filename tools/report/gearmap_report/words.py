# SPDX-License-Identifier: BSD-2-Clause
"""Numbers and names as people read them."""
from html import escape
from math import floor, isfinite, log10

RPM = 9.549296585513721  # of 1 rad/s
NARROW = "\u202f"  # no-break space between groups of digits, and before units


def significant(value, digits):
    """No exponent: 0.0123, 1.00, 12300."""
    if value == 0:
        return "0"
    places = digits - 1 - floor(log10(abs(value)))
    return "%.*f" % (max(0, places), round(value, places))


def number(value, digits=3):
    """Significant digits, no exponent, whole numbers without a point: 0.0123, 12 300."""
    if value is None or not isfinite(value):
        return "–"
    text = significant(value, digits)
    whole, _, rest = text.partition(".")
    return spaced(text if rest.strip("0") else whole)


def spaced(text):
    """Digits in groups of three where they are many, a real minus sign."""
    whole, dot, rest = text.partition(".")
    sign, whole = ("−", whole[1:]) if whole.startswith("-") else ("", whole)
    if len(whole) > 4:
        whole = "{:,}".format(int(whole)).replace(",", NARROW)
    return sign + whole + dot + rest


def unit(value, name, digits=3):
    return number(value, digits) + NARROW + name


def percent(share, digits=2):
    """With all digits, so that columns of it stand alike: 98.00 %."""
    if not isfinite(share):
        return "–"
    return spaced(significant(100.0 * share, digits)) + NARROW + "%"


CYCLES = {"ece15": "ECE-15", "urban": "the urban part of the NEDC (ECE-15, four times)",
          "eudc": "EUDC", "nedc": "NEDC", "wltc3b": "WLTC class 3b"}


def easy(value):
    """Near the value, and easy to remember: 2000 for 2275."""
    return float("%.1g" % value)


def cycle_name(name):
    """As people call it; a file's cycle by the file's name."""
    return CYCLES.get(name) or name.replace("\\", "/").rsplit("/", 1)[-1]


def ordinal(number_of_gear):
    if number_of_gear < 0:
        return "reverse" if number_of_gear == -1 else "reverse %d" % -number_of_gear
    ending = {1: "st", 2: "nd", 3: "rd"}.get(number_of_gear, "th")
    return "%d%s" % (number_of_gear, ending)


def gear_name(number_of_gear):
    name = ordinal(number_of_gear)
    return name if number_of_gear < 0 else name + " gear"


def plural(count, one, many=None):
    return "%s %s" % (number(count, 6), one if count == 1 else many or one + "s")


def paragraph(*sentences, class_=None):
    attribute = ' class="%s"' % class_ if class_ else ""
    return "<p%s>%s</p>" % (attribute, " ".join(s for s in sentences if s))


def table(head, rows, caption, numeric_from=1):
    """Cells are HTML already; columns from numeric_from on are set to the right."""
    def cells(row, tag):
        return "".join("<%s%s>%s</%s>" % (
            tag if i or tag == "th" else 'th scope="row"',
            ' class="n"' if i >= numeric_from else "", cell,
            tag if i or tag == "th" else "th") for i, cell in enumerate(row))

    header = "".join('<th scope="col"%s>%s</th>'
                     % (' class="n"' if i >= numeric_from else "", cell)
                     for i, cell in enumerate(head))
    body = "".join("<tr>%s</tr>" % cells(row, "td") for row in rows)
    return ('<div class="scroll" tabindex="0" role="region" aria-label="%s"><table>'
            "<caption>%s</caption><thead><tr>%s</tr></thead><tbody>%s</tbody></table></div>"
            % (escape(caption, quote=True), caption, header, body))
