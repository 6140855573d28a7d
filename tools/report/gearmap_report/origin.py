# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 5: where all this comes from."""
import re
from html import escape
from itertools import takewhile

from .words import RPM, number, paragraph, table, unit

ZERO_CELSIUS = 273.15
OPTIONS = {  # of a sweep, kept in SI: name -> words, how to say the value
    "speed_step": ("step of speed", lambda v: unit(v * RPM, "rpm", 5)),
    "torque_step": ("step of torque", lambda v: unit(v, "N·m", 5)),
    "speed_max": ("speed up to", lambda v: unit(v * RPM, "rpm", 5)),
    "torque_max": ("torque up to", lambda v: unit(v, "N·m", 5)),
    "oil_temperature": ("oil at", lambda v: unit(v - ZERO_CELSIUS, "°C", 4)),
}


def option_words(options):
    """How it was swept; what is not known here stays as it is."""
    found = []
    for option in options.split():
        name, _, value = option.partition("=")
        if name == "oil_axis":  # its temperatures have a line of their own
            continue
        words, say = OPTIONS.get(name, (name, None))
        try:
            found.append("%s %s" % (words, say(float(value))))
        except (TypeError, ValueError):
            found.append("%s %s" % (words, value.replace("auto", "automatic")))
    return ", ".join(found)


def measured_rows(results):
    """What the results were measured on."""
    measured = next((r["measured"] for r in [results.steady or {}, *results.cycles]
                     if r.get("measured")), None)
    if not measured:
        return []
    return [["Component that was measured", "<code>%s</code>, Gearmap %s" % (
        escape(str(measured.get("fmu_guid"))), escape(str(measured.get("tool_version"))))]]


def map_section(data, results):
    about = data.about
    rows = [["Gearset", escape(data.title)],
            ["Map", "<code>%s</code>: %s values in %s tables" % (
                escape(data.path.rsplit("/", 1)[-1]), number(data.values, 9),
                number(data.tables, 9))],
            ["Name of this content (hash)", "<code>%s</code>" % about["content_hash"]],
            ["Description it was made from (SHA-256)",
             "<code>%s</code>" % about["input_sha256"]],
            ["How it was swept", escape(option_words(about["options"]))],
            *([["Oil temperatures", ", ".join(unit(oil, "°C") for oil in data.slices)]]
              if data.slices else []),
            ["Made by", "Gearmap %s" % escape(about["tool_version"])]]
    rows += measured_rows(results)
    if results.names:
        rows.append(["Results shown", ", ".join("<code>%s</code>" % escape(n)
                                                for n in results.names)])
    return ('<section id="source"><h2>Where does this come from?</h2>'
            + paragraph("Gearmap solves a detailed model of the gearset at many operating "
                        "points and keeps what it finds in tables: the map. The small "
                        "component reads these tables. The same description and options "
                        "always give the same map, and the hash names it.")
            + table(["What", "Value"], rows, "Origin of the numbers on this page.", 9)
            + "</section>")


def first_words(description):
    """The comment at the head of a description, where its author tells the sources. Lines
    that are set in continue the one before."""
    comment = takewhile(lambda line: line.startswith("#"), description.splitlines())
    text = "\n".join(line[1:].removeprefix(" ") for line in comment)
    return re.sub(r"\n +(?=\S)", " ", text).strip()


def description_section(data):
    if not data.description:
        return ""
    words = first_words(data.description)
    said = (paragraph("At the head of the description its author says:")
            + '<pre class="said" tabindex="0">%s</pre>' % escape(words) if words else "")
    return ('<section id="description"><h2>Where do the sizes of the gearset come from?</h2>'
            + said + '<details><summary>The whole description: every part, its size, its '
            'model of friction</summary><pre class="text" tabindex="0">%s</pre></details>'
            "</section>" % escape(data.description))


def chapter(data, results):
    return map_section(data, results) + description_section(data)
