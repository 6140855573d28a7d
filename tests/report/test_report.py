# SPDX-License-Identifier: BSD-2-Clause
"""`gearmap report` on every example, with and without results; what it says when
something is wrong. What a browser makes of the page: run.sh beside this file."""
import json
import os
import re
import sqlite3
import subprocess
import sys
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest

pd = pytest.importorskip("pandas", reason="the report needs pandas")
pytest.importorskip("plotly", reason="the report needs plotly")

GEARMAP = os.environ["GEARMAP"]
ROOT = Path(os.environ["GM_SOURCE_DIR"])
EXAMPLES = sorted(p.stem for p in (ROOT / "examples").glob("*.yaml")
                  if not p.stem.startswith("vehicle"))
sys.path.insert(0, str(ROOT / "tools" / "report"))
from gearmap_report import command, page  # noqa: E402
from gearmap_report.errors import ReportError  # noqa: E402
from gearmap_report.map_file import read_map, slices_of  # noqa: E402
from gearmap_report.results import Results, read_results  # noqa: E402
from gearmap_report.words import number, percent  # noqa: E402

COARSE = ["--speed-step", "1500rpm", "--torque-step", "100Nm"]
LARGEST = 8e6  # bytes


def gearmap(*arguments, code=0, **environment):
    done = subprocess.run([GEARMAP, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "GEARMAP_PYTHON": sys.executable,
                               **environment})
    assert done.returncode == code, done.stderr
    return done


def report(made, *results, output):
    """In this process: starting Python with pandas takes longer than the page."""
    command.run(output, made, results)
    return check_page(output)


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("report")


@pytest.fixture(scope="session", params=EXAMPLES)
def swept(request, folder):
    """A map of each example, coarse."""
    path = folder / (request.param + ".map")
    gearmap("sweep", ROOT / "examples" / (request.param + ".yaml"), "-o", path, *COARSE)
    return path


@pytest.fixture(scope="session")
def reduced(folder):
    """Map, component and results of the smallest example over a short drive."""
    cycle = folder / "short.csv"
    cycle.write_text("time_s,speed_km_h\n0,0\n1,0\n4,18\n6,18\n8,0\n9,0\n")
    fmu, made = folder / "ev1.fmu", folder / "ev1_reduced.map"
    description = ROOT / "examples" / "ev1.yaml"
    gearmap("reduce", description, "-o", fmu, "--map", made, *COARSE)
    trace = folder / "trace.csv"
    done = gearmap("verify", description, fmu, "--steady", "--points", 100, "--cycle",
                   cycle, "--trace", trace, "--json")
    results = folder / "verify.json"
    results.write_text(done.stdout)
    return made, results, trace


class Structure(HTMLParser):
    """What a page has, and whether its elements close in their order."""

    VOID = {"meta", "link", "br", "input", "img", "hr"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.headings, self.plots = [], [], [], []
        self.figures, self.targets = 0, []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag not in self.VOID:
            self.open.append(tag)
        if "id" in given:
            self.ids.append(given["id"])
        if "plot" in (given.get("class") or "").split():
            self.plots.append(given)
        if tag == "a" and given.get("href", "").startswith("#"):
            self.targets.append(given["href"][1:])
        self.figures += tag == "figure"

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.handle_endtag(tag)


def not_json(word):
    raise AssertionError("%s is no JSON" % word)


def check_page(path):
    text = Path(path).read_text(encoding="utf-8")
    assert len(text.encode()) <= LARGEST
    assert not re.search(r'(src|href)="(https?:)?//', text), "asks for something outside"
    page = Structure(text)
    assert page.open == []
    assert len(page.ids) == len(set(page.ids)), "an id stands twice"
    assert set(page.targets) <= set(page.ids), "a link leads nowhere"
    assert page.plots
    for plot in page.plots:
        assert len(plot["aria-label"]) > 30, plot["id"]
        assert plot["id"] + "-data" in page.ids
    for block in re.findall(r'type="application/json" id="[^"]+">(.*?)</script>', text):
        json.loads(block, parse_constant=not_json)
    return text, page


def assert_every_gear_has_a_flow(path, text):
    with sqlite3.connect(path) as map_file:
        gears = sorted(str(g) for g, in map_file.execute("SELECT gear FROM gear"))
    for pattern in (r'<polyline [^>]*class="flow" data-gear="(-?\d+)"',
                    r'<p class="flow-words" data-gear="(-?\d+)"'):
        assert sorted(re.findall(pattern, text)) == gears


def test_every_example_without_results(swept, folder, capsys):
    text, structure = report(swept, output=folder / (swept.stem + ".html"))
    assert "report" in capsys.readouterr().out
    ids = [p["id"] for p in structure.plots]
    assert {"loss-map", "no-load", "components"} <= set(ids)
    assert "made without a comparison" in text
    assert text.count('class="section"') == 1 and text.count('class="end-view"') == 1
    assert_every_gear_has_a_flow(swept, text)


def test_results_are_shown(reduced, folder):
    """By the command itself, as users start it."""
    page = folder / "with_results.html"
    done = gearmap("report", *reduced, "-o", page)
    assert done.stdout.startswith("report") and done.stderr == ""
    text, structure = check_page(page)
    ids = {p["id"] for p in structure.plots}
    assert {"cpu", "motion", "torques", "differences", "errors", "range",
            "drive-components"} <= ids
    numbers = json.loads(reduced[1].read_text())
    saved = 100 * numbers["reduced"][0]["cpu_saved"]
    assert "%.3g" % saved in text
    assert "made without a comparison" not in text
    again, _ = report(*reduced, output=folder / "again.html")
    assert again == text


def test_results_without_a_trace(reduced, folder):
    made, results, _ = reduced
    ids = {p["id"] for p in report(made, results, output=folder / "no_trace.html")[1].plots}
    assert "motion" not in ids and "errors" in ids


def test_a_trace_alone(reduced, folder):
    made, _, trace = reduced
    _, structure = report(made, trace, output=folder / "trace_alone.html")
    assert "motion" in {p["id"] for p in structure.plots}


def test_a_map_without_its_description(reduced, folder):
    bare = folder / "bare.map"
    bare.write_bytes(reduced[0].read_bytes())
    with sqlite3.connect(bare) as map_file:
        for table in ("description", "verification", "verification_point", "result"):
            map_file.execute("DROP TABLE " + table)
    map_file.close()
    text, structure = report(bare, *reduced[1:], output=folder / "bare.html")
    assert "does not hold the description" in text
    assert "components" not in {p["id"] for p in structure.plots}


def changed(reduced, tmp_path, change):
    """The results of verify with something else in them."""
    found = json.loads(reduced[1].read_text())
    change(found)
    path = tmp_path / "changed.json"
    path.write_text(json.dumps(found))
    return path


def drop_errors(found):
    del found["reduced"][1]["errors"]["loss_energy_relative"]


@pytest.mark.parametrize("change, words", [
    (lambda found: found["measured"].update(map_hash="0" * 64), "from another map"),
    (lambda found: found.pop("cases"), "not a whole result"),
    (lambda found: found.update(points="many"), "not a whole result"),
    (lambda found: found["groups"].update(drag={}), "not a whole result"),
    (lambda found: found.update(reduced=[1]), "not a whole result"),
    (drop_errors, "not a whole result"),
])
def test_results_of_another_map_or_not_whole_are_refused(reduced, tmp_path, change, words):
    path = changed(reduced, tmp_path, change)
    with pytest.raises(ReportError, match=words):
        read_results([str(path)], read_map(reduced[0]))


@pytest.mark.parametrize("change, words", [
    (lambda t: t.replace(".input.", ".odd."), "not a trace of this gearset"),
    (lambda t: t[:t.rindex(",") - 40], "cut off"),
    (lambda t: t[:t.rindex("\n")][:-3] + "xyz\n", "cut off"),
    (lambda t: t[:t.index("\n") + 1], "cut off"),
])
def test_a_trace_of_another_gearset_or_cut_off_is_refused(reduced, tmp_path, change, words):
    path = tmp_path / "trace.csv"
    path.write_text(change(reduced[2].read_text()))
    with pytest.raises(ReportError, match=words):
        read_results([str(path)], read_map(reduced[0]))


def test_results_of_one_fidelity(reduced, folder):
    """verify --fidelity writes what belongs to it beside it, not in a list."""
    made, results, trace = reduced
    found = json.loads(results.read_text())
    lash = found["reduced"].pop()
    beside = {k: lash.pop(k) for k in ("cpu_saved", "errors", "differences", "loss_by_gear",
                                       "shifts", "worst", "energy_balance_relative")}
    path = folder / "lash.json"
    path.write_text(json.dumps({**found, "reduced": lash, **beside}))
    text, structure = report(made, path, trace, output=folder / "lash.html")
    assert "<h3>lash</h3>" in text and "<h3>rigid</h3>" not in text
    assert "gear-energy-0" in {p["id"] for p in structure.plots}


def figure(text, name):
    return json.loads(re.search(r'id="%s-data">(.*?)</script>' % name, text).group(1))


def names_of(plot):
    return {trace.get("name") for trace in plot["data"]}


def test_where_the_map_was_left(reduced, folder):
    """The drive, shown with a map of a smaller range."""
    small = folder / "small.map"
    gearmap("sweep", ROOT / "examples" / "ev1.yaml", "-o", small, *COARSE[:2],
            "--torque-step", "5Nm", "--torque-max", "5Nm")
    left, _ = report(small, reduced[2], output=folder / "left.html")
    assert "left the map" in left and "input, outside" in names_of(figure(left, "range"))
    inside, _ = report(reduced[0], reduced[2], output=folder / "inside.html")
    assert "never left the map" in inside
    assert "input, outside" not in names_of(figure(inside, "range"))


def test_the_worst_points_stand_in_for_points_that_a_result_does_not_hold(reduced, folder):
    bare = folder / "no_points.map"
    bare.write_bytes(reduced[0].read_bytes())
    with sqlite3.connect(bare) as map_file:
        for table in ("verification", "verification_point", "result"):
            map_file.execute("DROP TABLE " + table)
    map_file.close()
    text, _ = report(bare, reduced[1], output=folder / "worst.html")
    stars = [t for t in figure(text, "loss-map")["data"]
             if t.get("marker", {}).get("symbol") == "star"]
    worst = [c["worst"]["speed_rpm"] for c in json.loads(reduced[1].read_text())["cases"]
             if c["direction"] == "forward"]
    assert [x for t in stars for x in t["x"]] == pytest.approx(worst, rel=1e-4)


def test_the_sources_in_the_description_are_told(swept, folder):
    text, _ = report(swept, output=folder / (swept.stem + "_sources.html"))
    head = (ROOT / "examples" / (swept.stem + ".yaml")).read_text().splitlines()[0]
    assert '<pre class="said" tabindex="0">%s' % head.lstrip("# ")[:40] in text


@pytest.mark.parametrize("value, digits, words", [
    (0.01234, 2, "0.012"), (2000, 4, "2000"), (16310, 6, "16\u202f310"), (1.0, 2, "1"),
    (9.999, 3, "10"), (-4.5, 3, "−4.50"), (0, 3, "0"), (float("nan"), 3, "–"),
])
def test_numbers_as_people_read_them(value, digits, words):
    assert number(value, digits) == words


def test_percentages_keep_their_digits():
    assert percent(0.98, 4) == "98.00\u202f%" and percent(-0.01, 2) == "−1.0\u202f%"
    assert percent(0) == "0\u202f%"


def test_several_oil_temperatures(reduced):
    """A choice of temperature, and a line for each, from a map with several."""
    one = read_map(reduced[0])
    tables = {"load_loss": one.load_loss, "parasitic": one.parasitic, "drag": one.drag}
    warm = {name: rows.drop(columns="oil_degC", errors="ignore")
            for name, rows in tables.items()}
    cold = {name: rows.assign(loss_torque_Nm=2 * rows["loss_torque_Nm"])
            if "loss_torque_Nm" in rows else rows for name, rows in warm.items()}
    both = {name: pd.concat([cold[name].assign(oil_degC=20.0),
                             warm[name].assign(oil_degC=80.0)]) for name in tables}
    slices = slices_of(both)
    assert list(slices) == [20.0, 80.0] and slices_of(warm) == {}
    data = replace(one, **slices[80.0], slices=slices)
    text = page.make(data, None, Results())
    assert "20\u202f°C and 80\u202f°C" in text and "20 to 80\u202f°C" in text
    assert 'name="loss-map-oil" value="80" checked' in text
    lines = [t for t in figure(text, "oil")["data"]
             if t["mode"] == "lines" and t["meta"]["load"] == "none"]
    assert len(lines) == 2
    assert {t["meta"]["oil"] for t in figure(text, "loss-map")["data"]
            if t["type"] == "contour"} == {"20", "80"}


def refused(words, *arguments, **environment):
    done = gearmap("report", *arguments, code=1, **environment)
    assert done.stderr.startswith("gearmap: ") and done.stderr.count("\n") == 1
    assert words in done.stderr, done.stderr


@pytest.mark.parametrize("name, content, words", [
    ("missing.json", None, "there is no such file"),
    ("text.json", "{", "is not JSON"),
    ("list.json", "[1]", "is not a result of gearmap verify"),
    ("other.json", '{"a": 1}', "is not a result of gearmap verify"),
    ("table.csv", "a,b\n1,2\n", "is not a trace"),
    ("empty.csv", "", "is not a table"),
    ("no.fmu", "no archive", "is not an FMU"),
    ("page.html", "<p>", "ends in .json, .csv or .fmu"),
])
def test_a_wrong_result_is_one_sentence(reduced, tmp_path, name, content, words):
    if content is not None:
        (tmp_path / name).write_text(content)
    with pytest.raises(ReportError, match=words) as refusal:
        read_results([str(tmp_path / name)], read_map(reduced[0]))
    assert "\n" not in str(refusal.value) and name in str(refusal.value)


def test_two_traces_are_one_too_many(reduced):
    with pytest.raises(ReportError, match="only one trace"):
        read_results([reduced[2], reduced[2]], read_map(reduced[0]))


def test_what_is_no_map_is_refused(reduced, tmp_path):
    other = tmp_path / "other.map"
    with sqlite3.connect(other) as database:
        database.execute("CREATE TABLE a (b)")
    for path, words in ((tmp_path / "missing.map", "no such file"),
                        (reduced[1], "is not a map"), (other, "is not a")):
        with pytest.raises(ReportError, match=words):
            read_map(path)


def test_a_failed_report_leaves_nothing(reduced, folder):
    page = folder / "none.html"
    refused("is not a map", reduced[1], "-o", page)
    refused("", reduced[0], "-o", folder / "no" / "page.html")
    assert not page.exists() and not list(folder.glob("*.new"))


def test_without_the_packages_it_says_how_to_get_them(reduced, folder, tmp_path):
    python = tmp_path / "python"  # -S: without the packages of the environment
    python.write_text('#!/bin/sh\nexec "%s" -S -I "$@"\n' % sys.executable)
    python.chmod(0o755)
    refused("-m pip install -r", reduced[0], "-o", folder / "none.html",
            GEARMAP_PYTHON=str(python))


def test_without_python_it_says_so(reduced, folder):
    refused("Python 3 with pandas and plotly", reduced[0], "-o", folder / "none.html",
            GEARMAP_PYTHON="/nowhere/python3")


def test_usage(reduced):
    assert "RESULT..." in gearmap("help", "report").stdout
    assert "needs --output" in gearmap("report", reduced[0], code=2).stderr
