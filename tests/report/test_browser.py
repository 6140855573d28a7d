# SPDX-License-Identifier: BSD-2-Clause
"""The pages of every example in a browser: nothing in its console, every figure drawn,
nothing cut off on a narrow screen, all of it usable by keyboard; and in validators."""
import os
import subprocess
import sys
import time
from pathlib import Path

import html5lib
import pytest

from browser import Browser

GEARMAP = os.environ["GEARMAP"]
ROOT = Path(os.environ["GM_SOURCE_DIR"])
PICTURES = Path(os.environ["GM_PICTURES"])
EXAMPLES = sorted(p.stem for p in (ROOT / "examples").glob("*.yaml")
                  if not p.stem.startswith("vehicle"))
FIRST_VIEW = 3.0  # s
NARROW, WIDE = 400, 1400


def gearmap(*arguments):
    done = subprocess.run([GEARMAP, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "GEARMAP_PYTHON": sys.executable})
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("pages")


@pytest.fixture(scope="session", params=EXAMPLES)
def plain(request, folder):
    """The page of an example's map alone."""
    path = folder / (request.param + ".map")
    gearmap("sweep", ROOT / "examples" / (request.param + ".yaml"), "-o", path)
    page = folder / (request.param + ".html")
    gearmap("report", path, "-o", page)
    return page


@pytest.fixture(scope="session", params=EXAMPLES)
def proved(request, folder):
    """The page of an example with a drive."""
    name = request.param
    paths = {kind: folder / (name + kind) for kind in (".fmu", "_proved.map", ".csv")}
    gearmap("reduce", ROOT / "examples" / (name + ".yaml"), "-o", paths[".fmu"], "--map",
            paths["_proved.map"], "--cycle", "ece15", "--trace", paths[".csv"])
    page = folder / (name + "_proved.html")
    gearmap("report", paths["_proved.map"], paths[".csv"], "-o", page)
    return page


@pytest.fixture(scope="session")
def browser():
    with Browser() as opened:
        yield opened


DRAWN = """[...document.querySelectorAll('.plot')].map((div) => ({id: div.id,
  drawn: !!div.querySelector('.main-svg'), traces: div.data.filter((t) => t.visible === true)
  .filter((t) => t.z || (t.x && (t.x.length || t.x.bdata))).length, marks: div.querySelectorAll(
  '.plot path, .plot text, .plot image, .contour path, .hm image').length,
  room: div._fullLayout._size.w / div.clientWidth}))"""
CUT = """(() => { const wide = document.documentElement.clientWidth;
  return [...document.querySelectorAll('h1, h2, h3, p, figure, fieldset, .plot, .tile, select')]
    .filter((e) => { const b = e.getBoundingClientRect(); return b.width && b.right > wide + 1; })
    .map((e) => e.tagName + ' ' + e.id + ' ' + e.textContent.slice(0, 40)); })()"""
LABELS_OUT = """[...document.querySelectorAll('.plot')].flatMap((div) => {
  const b = div.getBoundingClientRect();
  return [...div.querySelectorAll('.xtitle, .ytitle, .xtick text, .ytick text, .legendtext')]
    .filter((t) => { const r = t.getBoundingClientRect();
      return r.width && (r.left < b.left - 2 || r.right > b.right + 2 || r.bottom > b.bottom + 2); })
    .map((t) => div.id + ': ' + t.textContent); })"""


def check_view(browser, page, width, dark=False):
    browser.open(page, width, 900, dark)
    assert browser.errors() == []
    assert browser.requests() == []
    for plot in browser.run(DRAWN):
        assert plot["drawn"] and plot["traces"] and plot["marks"], plot
        assert plot["room"] > 0.45, plot  # for lines and bars beside titles and legend
    assert browser.run(CUT) == []
    assert browser.run(LABELS_OUT) == []
    assert browser.run("document.documentElement.scrollWidth") <= width
    browser.picture(PICTURES / ("%s_%d%s.png" % (page.stem, width, "_dark" * dark)))


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_page_of_a_map(browser, plain, width):
    check_view(browser, plain, width)


@pytest.mark.parametrize("width, dark", [(WIDE, False), (NARROW, False), (WIDE, True)])
def test_page_with_a_drive(browser, proved, width, dark):
    check_view(browser, proved, width, dark)


def test_first_view_is_quick(browser, proved):
    browser.open(proved)
    paint = browser.run("performance.getEntriesByName('first-contentful-paint')[0].startTime")
    assert paint / 1e3 <= FIRST_VIEW
    assert os.path.getsize(proved) <= 8e6


def test_every_choice_shows_something(browser, proved):
    browser.open(proved)
    browser.run("""(async () => { for (const input of document.querySelectorAll(
        'fieldset input')) { input.click(); await new Promise((d) => setTimeout(d, 20)); } })()""")
    for plot in browser.run(DRAWN):
        assert plot["traces"] and plot["marks"], plot
    assert browser.errors() == []


def test_a_gear_is_chosen_by_keyboard(browser, proved):
    browser.open(proved)
    browser.run("document.querySelector('#flow-choice input').focus()")
    gears = browser.run("document.querySelectorAll('#flow-choice input').length")
    for gear in range(gears):
        shown = browser.run("[...document.querySelectorAll('.flow.shown')].map((f) => "
                            "f.dataset.gear)")
        assert shown == [browser.run("document.querySelector('#flow-choice :checked').value")]
        assert browser.run("document.querySelectorAll('svg .on').length") > 2
        for kind in ("keyDown", "keyUp"):
            browser.call("Input.dispatchKeyEvent", type=kind, key="ArrowRight",
                         code="ArrowRight", windowsVirtualKeyCode=39)


def test_times_zoom_together(browser, proved):
    browser.open(proved)
    ranges = ("[...document.querySelectorAll('[data-kind=timeline]')].map((d) => "
              "d.layout.xaxis.range.map((x) => Math.round(1000 * x)))")
    whole = browser.run(ranges)
    browser.run("document.querySelector('[data-move=in]').click()")
    time.sleep(0.2)
    closer = browser.run(ranges)
    assert len({tuple(r) for r in closer}) == 1
    assert closer[0][1] - closer[0][0] == pytest.approx((whole[0][1] - whole[0][0]) / 2, abs=2)
    browser.run("(() => { const s = document.getElementById('look'); s.selectedIndex = 1; "
                "s.dispatchEvent(new Event('change')); })()")
    shift = browser.run(ranges)
    assert shift[0][1] - shift[0][0] <= 4001
    samples = browser.run("document.getElementById('motion').data[0].x.length")
    assert samples > 300  # every sample of 4 s
    assert browser.errors() == []


def test_figures_have_words_and_controls_have_names(browser, proved):
    browser.open(proved)
    assert browser.run("[...document.querySelectorAll('.plot, main svg[role=img]')].every((e) => "
                       "e.ariaLabel && e.ariaLabel.length > 25)")
    assert browser.run("[...document.querySelectorAll('main figure')].every((f) => "
                       "f.querySelector('figcaption'))")
    assert browser.run("[...document.querySelectorAll('input, select, button')].every((e) => "
                       "e.labels?.length || e.ariaLabel || e.textContent.trim() || "
                       "e.dataset.title || e.title)")
    assert browser.run("[...document.querySelectorAll('h1, h2, h3, h4')].map((h) => +h.tagName[1])"
                       ".every((level, i, all) => i === 0 || level <= all[i - 1] + 1)")


def check_html(page):
    parser = html5lib.HTMLParser(strict=False)
    parser.parse(page.read_bytes())
    assert parser.errors == []
    tidy = subprocess.run(["tidy", "-quiet", "-errors", "--drop-empty-elements", "no",
                           str(page)], capture_output=True, text=True)
    assert tidy.returncode == 0, tidy.stderr[:2000]


def test_html_of_a_map_is_valid(plain):
    check_html(plain)


def test_html_with_a_drive_is_valid(proved):
    check_html(proved)


SHEET = 688  # px: A4 without the margins of the page's style
ON_PAPER = """(() => { dispatchEvent(new Event('%s'));
  return [...document.querySelectorAll('.plot, svg.section, svg.end-view')].map((e) => {
    const drawn = e.querySelector('.main-svg') || e;
    const b = drawn.getBoundingClientRect();
    return [e.id || e.classList[0], Math.round(b.right), Math.round(b.height)]; }); })()"""


def test_print_is_light_and_whole(browser, proved):
    """Figures are drawn anew as wide as the paper, and come back as they were."""
    browser.open(proved, dark=True)
    before = browser.run(ON_PAPER % "nothing")
    browser.call("Emulation.setDeviceMetricsOverride", width=SHEET, height=1000,
                 deviceScaleFactor=1, mobile=False)
    browser.call("Emulation.setEmulatedMedia", media="print")
    for name, right, height in browser.run(ON_PAPER % "beforeprint"):
        assert 0 < right <= SHEET and height < 1000, name
    assert browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert browser.run("getComputedStyle(document.querySelector('h2')).color") == "rgb(27, 32, 39)"
    browser.call("Emulation.setEmulatedMedia", media="", features=[
        {"name": "prefers-color-scheme", "value": "dark"}])
    browser.call("Emulation.setDeviceMetricsOverride", width=WIDE, height=900,
                 deviceScaleFactor=1, mobile=False)
    assert browser.run(ON_PAPER % "afterprint") == before
    answer = browser.call("Page.printToPDF", printBackground=True)
    assert len(answer["data"]) > 50000
    assert browser.errors() == []
