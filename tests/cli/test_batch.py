# SPDX-License-Identifier: BSD-2-Clause
"""gearmap batch: variants beside each other, failures, names, what is not done again."""

import csv
import json
import os
import pty
import re
import select
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from conftest import PROGRAM, ROOT, fails, gearmap, result_of, succeeds

SMALL = Path(__file__).parent / "two_speed.yaml"
COARSE = ["--speed-step", "1500rpm", "--torque-step", "100Nm", "--points", "20"]


def variant(folder, name, old="", new=""):
    """The small gearset under another name, with one text replaced."""
    folder.mkdir(parents=True, exist_ok=True)
    text = SMALL.read_text()
    assert old in text
    path = folder / f"{name}.yaml"
    path.write_text(text.replace(old, new, 1))
    return path


def batch(source, out, *options):
    done = gearmap("batch", source, "-o", out, *COARSE, "--json", *options)
    return done.returncode, json.loads(done.stdout), done.stderr


def table(out):
    with open(out / "batch.csv", newline="") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A folder with two gearsets, a broken one and a file that is none, and its batch."""
    folder = tmp_path_factory.mktemp("variants")
    variant(folder, "first")
    variant(folder, "second", "name: ", "name: other_")
    variant(folder, "broken", "shafts:", "shafts: 3\nshafts:")
    shutil.copy(ROOT / "examples/vehicle_c_segment.yaml", folder)
    out = folder / "out"
    return folder, out, batch(folder, out)


def test_a_failure_does_not_stop_the_others(finished):
    folder, out, (code, result, said) = finished
    assert code == 1 and said == "gearmap: 1 of 3 variants failed\n"
    states = {v["name"]: v["state"] for v in result["variants"]}
    assert states == {"broken": "failed", "first": "done", "second": "done"}
    assert [v["name"] for v in result["variants"]] == ["broken", "first", "second"]
    assert (result["done"], result["kept"], result["failed"]) == (2, 0, 1)
    assert [Path(p).name for p in result["passed_over"]] == ["vehicle_c_segment.yaml"]
    failure = result["variants"][0]["message"]
    assert "broken.yaml" in failure and "\n" not in failure
    assert not (out / "broken.fmu").exists()
    assert {r["state"] for r in table(out).values()} == {"done", "failed"}


def test_results_are_those_of_single_reductions(finished, tmp_path):
    folder, out, (_, result, _) = finished
    first = result["variants"][1]
    single = result_of("reduce", folder / "first.yaml", "-o", tmp_path / "x.fmu", "--map",
                       tmp_path / "x.map", *COARSE)
    assert first["points"] == single["sweep"]["points"]
    assert first["max_relative"] == single["verify"]["max_relative"]
    assert first["rms_relative"] == single["verify"]["rms_relative"]
    assert Path(first["fmu"]).read_bytes() == (tmp_path / "x.fmu").read_bytes()
    assert Path(first["map"]).exists()


def test_only_what_changed_is_done_again(finished, tmp_path):
    """The file, an option, the component; failures are tried again."""
    old, old_out, _ = finished
    folder, out = tmp_path / "in", tmp_path / "out"
    shutil.copytree(old, folder, ignore=shutil.ignore_patterns("out"))
    shutil.copytree(old_out, out)
    (folder / "broken.yaml").unlink()
    before = (out / "first.fmu").stat().st_mtime_ns
    code, result, said = batch(folder, out)
    assert (code, said, result["kept"], result["done"]) == (0, "", 2, 0)
    assert result["variants"][0]["points"] > 0  # from the table
    variant(folder, "second", "name: ", "name: third_")
    code, result, _ = batch(folder, out)
    assert [v["state"] for v in result["variants"]] == ["kept", "done"]
    (out / "second.fmu").write_bytes(b"not what was made")
    code, result, _ = batch(folder, out)
    assert [v["state"] for v in result["variants"]] == ["kept", "done"]
    assert (out / "first.fmu").stat().st_mtime_ns == before
    code, result, _ = batch(folder, out, "--threads", "1")
    assert result["kept"] == 2  # the number of threads changes nothing
    code, result, _ = batch(folder, out, "--seed", "2")
    assert result["done"] == 2


def test_a_list_and_equal_names(tmp_path):
    """Paths from where the list is, each file once; folders tell equal names apart."""
    variant(tmp_path / "a", "g")
    variant(tmp_path / "b", "g", "name: ", "name: other_")
    lines = ["# two of the same name", "a/g.yaml   # first", "", f"{tmp_path}/b/g.yaml",
             "b/../a/g.yaml", "nowhere.yaml"]
    (tmp_path / "list.txt").write_text("\n".join(lines))
    code, result, _ = batch(tmp_path / "list.txt", tmp_path / "out")
    assert [(v["name"], v["state"]) for v in result["variants"]] == [
        ("a_g", "done"), ("b_g", "done"), ("nowhere", "failed")]
    assert "nowhere.yaml" in result["variants"][2]["message"]
    assert {p.name for p in (tmp_path / "out").iterdir()} == {
        "a_g.fmu", "a_g.map", "b_g.fmu", "b_g.map", "batch.csv"}
    (tmp_path / "turned.txt").write_text("\n".join(reversed(lines)))
    code, result, _ = batch(tmp_path / "turned.txt", tmp_path / "out")
    assert {v["name"]: v["state"] for v in result["variants"]} == {
        "a_g": "kept", "b_g": "kept", "nowhere": "failed"}


def test_table_for_people(finished):
    folder, out, _ = finished
    done = gearmap("batch", folder, "-o", out, *COARSE)
    lines = done.stdout.splitlines()
    assert lines[0].split() == ["variant", "state", "points", "time", "max", "RMS",
                                "component"]
    assert re.match(r"broken +failed +.*broken\.yaml", lines[1])
    assert re.match(r"first +kept +\d+ +\d+\.\d+ s +\d+\.\d+ % +\d+\.\d+ % +.*first\.fmu$",
                    lines[2])
    assert re.match(r"0 done, 2 kept, 1 failed in ", lines[-1])


def test_what_cannot_be(tmp_path):
    empty = tmp_path / "empty"
    empty.mkdir()
    assert "empty" in fails("batch", empty, "-o", tmp_path / "out")
    assert "none.txt" in fails("batch", tmp_path / "none.txt", "-o", tmp_path / "out")
    folder = variant(tmp_path / "in", "g").parent
    assert "no/out" in fails("batch", folder, "-o", tmp_path / "no/out")
    (tmp_path / "file").write_text("")
    assert "file" in fails("batch", folder, "-o", tmp_path / "file")
    out = tmp_path / "out"
    out.mkdir()
    (out / "batch.csv").write_text("nonsense\n")
    assert "batch.csv:1" in fails("batch", folder, "-o", out)
    assert "no progress 'loud'" in fails(
        "batch", folder, "-o", tmp_path / "out", "--progress", "loud", code=2)


# ---- interruptions ----

SLOW = ["--speed-step", "15rpm", "--torque-step", "1Nm", "--points", "20"]


def children(pid):
    out = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True,
                         text=True).stdout
    return [int(p) for p in out.split()]


def started(folder, out):
    """A batch whose sweeps have begun to keep points."""
    process = subprocess.Popen(
        [PROGRAM, "batch", folder, "-o", out, "--threads", "2", *SLOW],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + 60
    while time.monotonic() < end and len(list(out.glob("*.part"))) < 2:
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.05)
    time.sleep(0.5)
    return process


def test_an_interrupted_batch_leaves_no_process_and_resumes(tmp_path):
    folder, out = variant(tmp_path / "in", "a").parent, tmp_path / "out"
    variant(folder, "b", "name: ", "name: other_")
    process = started(folder, out)
    running = children(process.pid)
    assert len(running) == 2
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 1
    assert said == (f"gearmap: interrupted; finished variants and points are kept in {out}, "
                    "the same command resumes\n")
    for pid in running:
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)
    parts = {p.name for p in out.glob("*.part")}
    assert parts == {"a.map.part", "b.map.part"}
    again = started(folder, out)  # takes up where it was
    for pid in children(again.pid):
        os.kill(pid, signal.SIGKILL)
    stdout, said = again.communicate(timeout=60)
    assert again.returncode == 1 and said == "gearmap: 2 of 2 variants failed\n"
    assert stdout.count("its process was ended by signal 9") == 2


# ---- progress ----

def seen_on_a_terminal(*command):
    try:
        main, side = pty.openpty()
    except OSError:
        pytest.skip("no pseudo terminals here")
    process = subprocess.Popen([PROGRAM, *map(str, command)], stdout=subprocess.DEVNULL,
                               stderr=side)
    os.close(side)
    seen = b""
    while True:
        ready, _, _ = select.select([main], [], [], 120)
        assert ready, "nothing within two minutes"
        try:
            block = os.read(main, 65536)
        except OSError:  # the other end is closed
            break
        if not block:
            break
        seen += block
    os.close(main)
    process.wait(timeout=60)
    return seen


def test_progress_on_a_terminal(tmp_path):
    variant(tmp_path / "in", "g")
    seen = seen_on_a_terminal("batch", tmp_path / "in", "-o", tmp_path / "out", *COARSE)
    assert re.search(rb"\rbatch \[#*\.*\] +\d+ %  0 of 1 variants.*g: (sweep|bake|verify)", seen)
    assert seen.endswith(b"\r")
    assert all(len(part) < 80 for part in seen.split(b"\r"))  # a line of the terminal


def lines_of(said):
    return [json.loads(line) for line in said.splitlines()]


def test_lines_for_machines(tmp_path):
    variant(tmp_path / "in", "g")
    done = succeeds("batch", tmp_path / "in", "-o", tmp_path / "out", *COARSE, "--progress",
                    "json")
    events = lines_of(done.stderr)
    assert events[0]["event"] == "begin" and events[-1]["event"] == "end"
    assert {e["stage"] for e in events} == {"batch"}
    parts = [e["part"] for e in events if e["event"] == "progress"]
    assert parts == sorted(parts) and all(0.0 <= p <= 1.0 for p in parts)
    ended = [e for e in events if e["event"] == "variant"]
    assert [(e["variant"], e["state"]) for e in ended] == [("g", "done")]


def test_lines_of_a_reduction(tmp_path):
    done = succeeds("reduce", SMALL, "-o", tmp_path / "x.fmu", *COARSE, "--progress", "json")
    events = lines_of(done.stderr)
    assert [(e["stage"], e["event"]) for e in events if e["event"] != "progress"] == [
        (s, e) for s in ("sweep", "bake", "verify") for e in ("begin", "end")]
    last = [e for e in events if e["event"] == "progress"][-1]
    assert last["points_done"] == last["points_total"] > 0 and last["left_s"] == 0
    assert last["points_per_s"] > 0 and last["worst_relative"] is None


def test_worst_error_of_axes_by_error(tmp_path):
    done = succeeds("sweep", SMALL, "-o", tmp_path / "x.map", "--tolerance", "5%",
                    "--progress", "json")
    worst = [e["worst_relative"] for e in lines_of(done.stderr)
             if e["event"] == "progress" and e["worst_relative"] is not None]
    assert worst and all(0.0 < w < 10.0 for w in worst)
