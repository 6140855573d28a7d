# SPDX-License-Identifier: BSD-2-Clause
"""The page: chapters, style, script, and Plotly itself, in one HTML text that needs
nothing else. Plotly and the series are compressed; the browser unpacks them after the
first view is there."""
import json
from html import escape
from pathlib import Path

from plotly.offline import get_plotlyjs

from . import accuracy, breakdown, limits, losses, origin, proof, what
from .drive import Drive
from .series import compressed
from .timelines import Timelines
from .words import number, percent

ASSETS = Path(__file__).parent / "assets"
STYLES = ("page.css", "drawing.css", "print.css")
SCRIPTS = ("unpack.js", "theme.js", "print.js", "figures.js", "choices.js", "timelines.js",
           "drawing.js", "start.js")
CHAPTERS = (("gearset", "Gearset"), ("losses", "Losses"), ("proof", "Proof"),
            ("limits", "Limits"), ("origin", "Origin"))


def assets(names):
    return "\n".join((ASSETS / name).read_text(encoding="utf-8") for name in names)


def fact(value, words):
    return "<li><b>%s</b> <span>%s</span></li>" % (value, words)


def facts(data, results):
    """The line of large numbers at the top."""
    found = [fact(len(data.gears), "gears" if len(data.gears) > 1 else "gear"),
             fact(number(data.values, 6), "values in its tables")]
    if results.cycles:
        cycle = results.cycles[0]
        best = min(cycle["reduced"], key=lambda r: r["cpu_s"])
        found.append(fact("%s×" % number(cycle["detailed"]["cpu_s"] / best["cpu_s"], 2),
                          "faster than the detailed model"))
        worst = max(abs(r["errors"]["loss_energy_relative"]) for r in cycle["reduced"])
        found.append(fact(percent(worst, 2), "difference of the energy lost over a drive"))
    single = accuracy.numbers(data, results).get("single")
    if single:
        found.append(fact(percent(single[2], 2), "typical difference of a loss from the "
                          "detailed model"))
    return '<ul class="facts">%s</ul>' % "".join(found)


THEME = ('<label class="theme">Colours <select id="theme"><option value="auto">as the system'
         '</option><option value="light">light</option><option value="dark">dark</option>'
         "</select></label>")


def head(data, results):
    return (
        '<header id="top"><div class="first-line"><p class="kicker">Gearmap report</p>%s'
        '</div><h1>%s</h1>'
        '<p class="lead">A detailed model of this gearset was measured point by point, and '
        "a small, fast component was made from the tables. This page shows what the "
        "gearset is, what power it loses, how good the component is, and where it ends."
        "</p>%s</header>" % (THEME, escape(data.title), facts(data, results)))


def navigation():
    links = "".join('<a href="#%s">%s</a>' % chapter for chapter in CHAPTERS)
    return '<nav aria-label="Chapters">%s</nav>' % links


def block(name, kind, text):
    return '<script type="%s" id="%s">%s</script>' % (kind, name, text)


def make_timelines(results):
    if results.trace is None:
        return None, None
    end = results.trace["time_s"].iloc[-1]
    cycle = next((c for c in results.cycles if abs(c["duration_s"] - end) < 0.5), None)
    drive = Drive(results.trace, cycle)
    return drive, Timelines(drive)


def make(data, gearset, results):
    drive, timelines = make_timelines(results)
    texts = (what.chapter(data, gearset),
             losses.chapter(data, results, breakdown.chapter(data, gearset, drive)),
             proof.chapter(data, results, timelines), limits.chapter(data, drive),
             origin.chapter(data, results))
    chapters = "".join('<div id="%s">%s</div>' % (name, text)
                       for (name, _), text in zip(CHAPTERS, texts))
    return document(data, head(data, results) + navigation() + "<main>%s</main>" % chapters
                    + "<footer><p>Made by <b>Gearmap</b> %s. Drawn with Plotly.js (MIT "
                    "licence).</p></footer>" % escape(data.about["tool_version"]),
                    timelines)


def document(data, body, timelines):
    blocks = block("plotly", "text/plain", compressed(get_plotlyjs().encode("utf-8")))
    if timelines:
        about, series = timelines.data()
        blocks += block("series-facts", "application/json", json.dumps(about))
        blocks += block("series", "text/plain", series)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="generator" content="Gearmap %s">\n<meta name="color-scheme" '
        'content="light dark">\n<title>%s: Gearmap report</title>\n<style>\n%s</style>\n'
        '</head>\n<body>\n<a class="skip" href="#gearset">Skip to the content</a>\n%s\n'
        "<noscript><p class=\"note\">The figures need JavaScript.</p></noscript>\n%s\n"
        "<script>\n%s</script>\n</body>\n</html>\n"
        % (escape(data.about["tool_version"]), escape(data.title), assets(STYLES), body,
           blocks, assets(SCRIPTS)))
