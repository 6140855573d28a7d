# SPDX-License-Identifier: BSD-2-Clause
"""The accuracy passport: what was measured on an FMU, inside that FMU."""

import hashlib
import json
import re
import sqlite3
import zipfile
from html.parser import HTMLParser
from pathlib import Path

import pytest
from conftest import COARSE, EXAMPLE, ROOT, fails, gearmap, result_of, succeeds

TWO_SPEED = Path(__file__).with_name("two_speed.yaml")
PASSPORT, PAGE = "extra/gearmap/passport.json", "documentation/index.html"
TIMES = {"cpu_s", "real_time_factor", "gearset_s", "cpu_saved"}
HILL = ("time_s,speed_km_h,gear\n0,0,1\n2,0,1\n6,15,2\n10,15,2\n13,0,1\n14,0,1\n")


def member(fmu, name):
    return zipfile.ZipFile(fmu).read(name)


def passport_of(fmu):
    return json.loads(member(fmu, PASSPORT))


def sha256(data):
    return hashlib.sha256(data).hexdigest()


@pytest.fixture(scope="module")
def hill(tmp_path_factory):
    """A cycle of a few seconds with a shift."""
    path = tmp_path_factory.mktemp("cycle") / "hill.csv"
    path.write_text(HILL)
    return path


@pytest.fixture(scope="module")
def reduced(tmp_path_factory, hill):
    """One reduction with everything: FMU, map and JSON."""
    folder = tmp_path_factory.mktemp("reduced")
    fmu, map_file = folder / "dct7.fmu", folder / "dct7.map"
    result = result_of("reduce", EXAMPLE, "-o", fmu, "--map", map_file, "--points", "200",
                       "--cycle", hill, *COARSE)
    return fmu, map_file, result


@pytest.fixture(scope="module")
def results(tmp_path_factory, example_fmu, hill):
    """What verify prints about the example's component, as files."""
    folder = tmp_path_factory.mktemp("results")
    steady, cycle = folder / "steady.json", folder / "cycle.json"
    steady.write_text(succeeds("verify", EXAMPLE, example_fmu, "--steady", "--points", "200",
                               "--json").stdout)
    cycle.write_text(succeeds("verify", EXAMPLE, example_fmu, "--cycle", hill, "--fidelity",
                              "rigid", "--tolerance", "1e-4", "--json").stdout)
    return steady, cycle


def test_a_passport_names_what_it_is_for(reduced):
    fmu, map_file, result = reduced
    p = passport_of(fmu)
    guid = re.search(r'guid="([^"]*)"', member(fmu, "modelDescription.xml").decode()).group(1)
    assert p["passport"] == 1
    assert p["model"] == {"name": "dct7", "title": p["model"]["title"],
                          "description_sha256": sha256(EXAMPLE.read_bytes())}
    assert p["map"]["content_hash"] == result["sweep"]["content_hash"]
    assert p["map"]["oil_temperature_degC"] == pytest.approx(80)
    assert p["map"]["speed_max_rpm"] == pytest.approx(6500)
    binary = member(fmu, "binaries/linux64/dct7.so")
    assert p["fmu"] == {"guid": guid, "interpolation": "linear", "platform": "linux64",
                        "binary_sha256": sha256(binary)}
    for part in (p["steady"], *p["cycles"]):
        assert part["measured"] == {
            "tool_version": p["map"]["tool_version"],
            "description_sha256": p["model"]["description_sha256"],
            "map_hash": p["map"]["content_hash"], "fmu_guid": guid,
            "fmu_binary_sha256": p["fmu"]["binary_sha256"]}


def test_reduce_puts_in_what_it_measured(reduced):
    fmu, _, result = reduced
    p = passport_of(fmu)
    for key in ("points", "seed", "max_relative", "rms_relative", "cases", "groups"):
        assert p["steady"][key] == result["verify"][key]
    assert "elapsed_s" not in p["steady"]
    cycle, = p["cycles"]
    assert cycle["cycle"] == "hill" and cycle["vehicle_sha256"] is None
    for key in ("duration_s", "distance_m", "tolerance", "detailed", "reduced"):
        assert cycle[key] == result["cycle"][key]
    assert [run["fidelity"] for run in cycle["reduced"]] == ["rigid", "lash"]


def test_what_verify_measures_again_is_the_same(reduced, hill):
    """Steady errors come out the same to the last digit, and so does all of a drive but
    the time it takes."""
    fmu, _, _ = reduced
    p = passport_of(fmu)
    again = result_of("verify", EXAMPLE, fmu, "--steady", "--points", "200", "--cycle", hill)
    assert again["measured"] == p["steady"]["measured"]
    assert again["cases"] == p["steady"]["cases"]
    assert without_times(again["reduced"]) == without_times(p["cycles"][0]["reduced"])


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if k not in TIMES}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def test_a_passport_changes_nothing_else(example_map, example_fmu, results, tmp_path):
    fmu = tmp_path / "a.fmu"
    baked = result_of("bake", example_map, "-o", fmu, "--passport", ",".join(map(str, results)))
    plain, signed = zipfile.ZipFile(example_fmu), zipfile.ZipFile(fmu)
    assert plain.namelist() == signed.namelist()
    changed = {name for name in plain.namelist() if plain.read(name) != signed.read(name)}
    assert changed == {PASSPORT, PAGE}
    assert passport_of(example_fmu)["fmu"] == passport_of(fmu)["fmu"]
    assert baked["guid"] == passport_of(fmu)["fmu"]["guid"]
    assert (passport_of(example_fmu)["steady"], passport_of(example_fmu)["cycles"]) == (None, [])


def test_results_are_put_together(example_map, results, tmp_path):
    """From two files as from one run of both; one drive alone is an array too."""
    fmu = tmp_path / "a.fmu"
    steady, cycle = (json.loads(path.read_text()) for path in results)
    succeeds("bake", example_map, "-o", fmu, "--passport", f"{results[1]},{results[0]}")
    p = passport_of(fmu)
    assert p["steady"]["cases"] == steady["cases"]
    run, = p["cycles"][0]["reduced"]
    assert {k: run[k] for k in cycle["reduced"]} == cycle["reduced"]
    for key in ("cpu_saved", "errors", "differences", "loss_by_gear", "shifts", "worst"):
        assert run[key] == cycle[key]
    both = tmp_path / "both.json"
    both.write_text(json.dumps({**cycle, **steady}))
    succeeds("bake", example_map, "-o", tmp_path / "b.fmu", "--passport", both)
    assert passport_of(tmp_path / "b.fmu") == p


def test_baking_the_kept_map_gives_the_same_bytes(reduced, tmp_path):
    fmu, map_file, _ = reduced
    succeeds("bake", map_file, "-o", tmp_path / "again.fmu")
    assert (tmp_path / "again.fmu").read_bytes() == fmu.read_bytes()


def test_given_results_take_the_place_of_kept_ones(reduced, results, tmp_path):
    """The reduction used the same options as the example's map."""
    _, map_file, _ = reduced
    succeeds("bake", map_file, "-o", tmp_path / "a.fmu", "--passport", results[0])
    assert passport_of(tmp_path / "a.fmu")["cycles"] == []


def test_two_reductions_give_the_same_bytes(tmp_path):
    """A passport has no time and no date, without a drive."""
    for name in ("a", "b"):
        succeeds("reduce", TWO_SPEED, "-o", tmp_path / f"{name}.fmu", "--points", "50", *COARSE)
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "b.fmu").read_bytes()
    assert passport_of(tmp_path / "a.fmu")["steady"]["points"] == 50


def test_kept_results_of_another_interpolation_are_left_out(reduced, tmp_path):
    _, map_file, _ = reduced
    done = succeeds("bake", map_file, "-o", tmp_path / "a.fmu", "--interpolation", "monotone")
    assert re.fullmatch(r"gearmap: note: a result is left out of the passport, .*: was measured "
                        r"on another component of this map \(GUID .*\)\n", done.stderr)
    p = passport_of(tmp_path / "a.fmu")
    assert (p["steady"], p["cycles"], p["fmu"]["interpolation"]) == (None, [], "monotone")


# ---- what is refused ----


def refused(map_file, given, tmp_path, *options):
    output = tmp_path / "out"
    output.mkdir()
    sentence = fails("bake", map_file, "-o", output / "a.fmu", "--passport", given, *options)
    assert list(output.iterdir()) == []
    return sentence


def test_results_of_another_map_are_refused(results, tmp_path):
    other = tmp_path / "other.map"
    succeeds("sweep", EXAMPLE, "-o", other, "--speed-step", "3000rpm", "--torque-step", "100Nm")
    assert re.fullmatch(
        re.escape(str(results[0])) + r": was measured with another map \(content hash "
        r"[0-9a-f]{16}, not [0-9a-f]{16}\)", refused(other, results[0], tmp_path))


def test_results_against_another_description_are_refused(example_map, example_fmu, tmp_path):
    changed = tmp_path / "changed.yaml"
    changed.write_text(EXAMPLE.read_text() + "# a comment\n")
    given = tmp_path / "changed.json"
    given.write_text(succeeds("verify", changed, example_fmu, "--steady", "--points", "10",
                              "--json").stdout)
    assert refused(example_map, given, tmp_path) == \
        f"{given}: was measured against another description than the map's"


def test_results_of_another_interpolation_are_refused(example_map, results, tmp_path):
    assert "was measured on another component of this map (GUID {" in refused(
        example_map, results[0], tmp_path, "--interpolation", "monotone")


def test_two_steady_results_are_refused(example_map, results, tmp_path):
    assert refused(example_map, f"{results[0]},{results[0]}", tmp_path) == \
        f"{results[0]}: a passport has one result with steady errors, not 2"


@pytest.mark.parametrize("change, words", [
    (lambda r: r.pop("measured"), "'measured' is missing or wrong"),
    (lambda r: r["measured"].update(map_hash=None), "another map (content hash unknown"),
    (lambda r: r["measured"].update(fmu_guid=7), "another component of this map (GUID unknown"),
    (lambda r: r.update(points="many"), "'points' is missing or wrong"),
    (lambda r: r["cases"][3].pop("rms_Nm"), "'rms_Nm' is missing or wrong"),
    (lambda r: r["groups"]["drag"].pop("cases"), "'cases' is missing or wrong"),
    (lambda r: r["groups"]["drag"]["cases"][0].pop("worst"), "'worst' is missing or wrong"),
    (lambda r: r.pop("cases"), "'cases' is missing or wrong"),
])
def test_what_is_no_result_is_refused(change, words, example_map, results, tmp_path):
    result = json.loads(results[0].read_text())
    change(result)
    given = tmp_path / "bad.json"
    given.write_text(json.dumps(result))
    sentence = refused(example_map, given, tmp_path)
    assert sentence.startswith(f"{given}: ") and words in sentence


@pytest.mark.parametrize("change, words", [
    (lambda r: r.pop("detailed"), "'detailed' is missing or wrong"),
    (lambda r: r["detailed"].pop("cpu_s"), "'cpu_s' is missing or wrong"),
    (lambda r: r.update(reduced=[]), "'reduced' is missing or wrong"),
    (lambda r: r["reduced"].pop("fidelity"), "'fidelity' is missing or wrong"),
    (lambda r: r.update(errors=[]), "'errors' is missing or wrong"),
])
def test_what_is_no_drive_is_refused(change, words, example_map, results, tmp_path):
    test_what_is_no_result_is_refused(change, words, example_map, results[1:], tmp_path)


def test_files_that_are_no_results(example_map, tmp_path):
    broken = tmp_path / "broken.json"
    broken.write_text('{"cases": [1,\n')
    assert refused(example_map, broken, tmp_path) == \
        f"{broken}:2: is not JSON: ']' expected near end of file"
    (tmp_path / "out").rmdir()
    broken.write_text('{"cases": [],\n"cases": []}')
    assert refused(example_map, broken, tmp_path) == \
        f"{broken}:2: is not JSON: duplicate object key near '\"cases\"'"
    (tmp_path / "out").rmdir()
    broken.write_bytes(b'{"cases": 1}\0')
    assert refused(example_map, broken, tmp_path) == f"{broken}: is no text"
    (tmp_path / "out").rmdir()
    missing = tmp_path / "none.json"
    assert refused(example_map, missing, tmp_path) == \
        f"{missing}: cannot be read: No such file or directory"


def test_a_damaged_record_of_the_map(reduced, tmp_path):
    """The record is no part of the content hash; what is no result is refused all the
    same."""
    path = tmp_path / "damaged.map"
    path.write_bytes(reduced[1].read_bytes())
    with sqlite3.connect(path) as db:
        db.execute("update result set json = '{}'")
    db.close()
    assert fails("bake", path, "-o", tmp_path / "a.fmu") == \
        f"{path}: is not what gearmap verify --json prints: 'measured' is missing or wrong"
    assert not (tmp_path / "a.fmu").exists()


def test_a_cycle_that_does_not_exist_is_refused_before_the_sweep(tmp_path):
    words = fails("reduce", EXAMPLE, "-o", tmp_path / "a.fmu", "--map", tmp_path / "a.map",
                  "--cycle", "ftp75")
    assert "ftp75" in words
    assert list(tmp_path.iterdir()) == []
    assert gearmap("reduce", EXAMPLE, "-o", tmp_path / "a.fmu", "--vehicle", "v.yaml"
                   ).returncode == 2


# ---- the page ----


class Page(HTMLParser):
    """Tables as lists of rows of texts; refuses tags that do not match."""

    EMPTY = {"meta", "img", "link", "br"}

    def __init__(self, text):
        super().__init__()
        self.open, self.tables, self.headings = [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        if tag not in self.EMPTY:
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.tables[-1].append([])
        if tag in ("td", "th"):
            self.tables[-1][-1].append("")
        if tag in ("h2", "h3"):
            self.headings.append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if {"td", "th"} & set(self.open):
            self.tables[-1][-1][-1] += data
        if self.open and self.open[-1] in ("h2", "h3"):
            self.headings[-1] += data

    def table(self, head):
        found, = (t for t in self.tables if t[0][0] == head[0] and set(head) <= set(t[0]))
        return found


def page_of(fmu):
    text = member(fmu, PAGE).decode()
    assert text.startswith("<!DOCTYPE html>")
    return Page(text)


def number(cell):
    return float(cell.split()[0])


def test_the_page_shows_every_gear(reduced):
    fmu, _, result = reduced
    rows = page_of(fmu).table(["path", "gear", "rotation"])[1:]
    cases = result["verify"]["cases"]
    assert len(rows) == len(cases)
    for row, case in zip(rows, cases):
        assert row[:3] == [case["path"], str(case["gear"]), case["direction"]]
        shown = [number(cell) for cell in row[3:]]
        assert shown == pytest.approx(
            [case["largest_loss_Nm"], 100 * case["max_relative"], 100 * case["rms_relative"],
             case["worst"]["speed_rpm"], case["worst"]["torque_Nm"]], rel=6e-3)


def test_the_page_shows_the_drive(reduced):
    fmu, _, result = reduced
    page, cycle = page_of(fmu), result["cycle"]
    assert "In a car over the cycle hill" in page.headings
    head, *rows = page.table(["what", "detailed"])
    assert head == ["what", "detailed", "rigid", "lash"]
    rows = {row[0]: row[1:] for row in rows}
    assert [number(c) for c in rows["faster than real time"]] == pytest.approx(
        [run["real_time_factor"] for run in (cycle["detailed"], *cycle["reduced"])], rel=1e-3)
    for words, key, scale in (("engine speed, RMS of the difference", "engine_speed_rms_rad_s", 1),
                              ("energy lost in the gearset", "loss_energy_relative", 100)):
        assert [number(c) for c in rows[words][1:]] == pytest.approx(
            [scale * run["errors"][key] for run in cycle["reduced"]], rel=1e-3)
    _, *gears = page.table(["gear", "time", "detailed"])
    assert [number(g[0]) for g in gears] == [g["gear"] for g in cycle["reduced"][0]["loss_by_gear"]]
    _, *worst = page.table(["component", "what happens"])
    assert len(worst) == sum(len(run["worst"]) for run in cycle["reduced"])


def test_a_page_without_measurements(example_fmu):
    text = member(example_fmu, PAGE).decode()
    assert "Not measured when this file was made" in text
    assert not any(t[0][0] == "quantity" for t in page_of(example_fmu).tables)


def test_a_name_of_a_cycle_cannot_break_the_page(example_map, results, tmp_path):
    result = json.loads(results[1].read_text())
    result["cycle"] = "<b>a & b</b>"
    result["reduced"]["fidelity"] = "<i>"
    given = tmp_path / "strange.json"
    given.write_text(json.dumps(result))
    succeeds("bake", example_map, "-o", tmp_path / "a.fmu", "--passport", given)
    assert "In a car over the cycle <b>a & b</b>" in page_of(tmp_path / "a.fmu").headings


def test_the_example_of_the_documentation_has_the_members(reduced):
    """docs/passport.md shows the document with the members that it has."""
    text = (ROOT / "docs" / "passport.md").read_text()
    shown = json.loads(re.search(r"```json\n(.*?)```", text, re.S).group(1))
    real = passport_of(reduced[0])

    def compare(a, b, place):
        if isinstance(a, dict) and a:
            missing = set(a) - set(b)
            assert not missing, f"{place}: {missing}"
            if place not in (".steady.groups", ".cycles.reduced.differences"):
                assert set(a) == set(b), f"{place}: {set(a) ^ set(b)}"
            for key in a:
                compare(a[key], b[key], f"{place}.{key}")
        elif isinstance(a, list) and a and isinstance(a[0], dict):
            compare(a[0], b[0], place)

    compare(shown, real, "")
