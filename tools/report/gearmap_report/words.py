# SPDX-License-Identifier: BSD-2-Clause
"""Numbers and names as people read them."""
from html import escape
from math import floor, isfinite, log10

NARROW = "\u202f"  # no-break space between groups of digits, and before units


def number(value, digits=3):
    """Significant digits, no exponent: 0.0123, 4.56, 12 300."""
    if value is None or not isfinite(value):
        return "–"
    if value == 0:
        return "0"
    places = max(0, digits - 1 - floor(log10(abs(value))))
    rounded = round(value, digits - 1 - floor(log10(abs(value))))
    text = "%.*f" % (places, rounded)
    if rounded == int(rounded):
        text = "%d" % rounded
    whole, dot, rest = text.partition(".")
    sign, whole = ("−", whole[1:]) if whole.startswith("-") else ("", whole)
    if len(whole) > 4:
        whole = "{:,}".format(int(whole)).replace(",", NARROW)
    return sign + whole + dot + rest


def unit(value, name, digits=3):
    return number(value, digits) + NARROW + name


def percent(share, digits=2):
    return number(100.0 * share, digits) + NARROW + "%"


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
