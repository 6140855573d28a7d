# SPDX-License-Identifier: BSD-2-Clause
"""gearmap sweep: outputs, interruption, resumption, reproducibility."""

import os
import pty
import re
import select
import shutil
import signal
import subprocess
import time

import pytest
from conftest import COARSE, EXAMPLE, PROGRAM, fails, result_of, succeeds

# Long enough to be interrupted half-way, in steps that stay cheap enough for a test.
FINE = ["--speed-step", "100rpm", "--torque-step", "12.5Nm"]


def test_text_names_what_was_made(tmp_path):
    text = succeeds("sweep", EXAMPLE, "-o", tmp_path / "m.map", *COARSE).stdout
    assert re.match(r"sweep +\d+\.\d\d s +\d+ steady points in \d+ tables\n", text)
    assert str(tmp_path / "m.map") in text
    assert [p.name for p in tmp_path.iterdir()] == ["m.map"]


def test_json_says_the_same_for_any_number_of_threads(tmp_path):
    results = [result_of("sweep", EXAMPLE, "-o", tmp_path / f"{n}.map", "--threads", n, *COARSE)
               for n in (1, 2, 3)]
    assert len({r["content_hash"] for r in results}) == 1
    assert len({r["points"] for r in results}) == 1
    assert all(r["resumed"] == 0 and r["points"] > 0 for r in results)
    assert re.fullmatch("[0-9a-f]{64}", results[0]["content_hash"])
    assert results[0]["size_bytes"] == (tmp_path / "1.map").stat().st_size
    assert results[0]["largest_ratio_deviation"] < 1e-3  # the sweep's own limit


def test_options_and_oil_change_the_content(tmp_path):
    def content(*options):
        return result_of("sweep", EXAMPLE, "-o", tmp_path / "m.map", *options)["content_hash"]
    first = content(*COARSE)
    assert first == content(*COARSE)
    assert first != content(*COARSE, "--oil-temperature", "40degC")
    assert first != content(*COARSE, "--torque-max", "200Nm")


def started(path, *options):
    """A sweep in the background, once its journal's log holds some points."""
    process = subprocess.Popen([PROGRAM, "sweep", EXAMPLE, "-o", path, *FINE, *options],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    log = path.with_name(path.name + ".part-wal")
    deadline = time.monotonic() + 60
    while not (log.exists() and log.stat().st_size > 300_000):
        assert process.poll() is None, "the sweep ended before it could be interrupted"
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return process


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "m.map"
    return result_of("sweep", EXAMPLE, "-o", path, *FINE)


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_sweep_resumes_to_the_same_map(number, tmp_path, uninterrupted):
    path = tmp_path / "m.map"
    process = started(path)
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert out == "" and not path.exists()
    if number == signal.SIGKILL:
        assert process.returncode == -signal.SIGKILL
    else:
        assert process.returncode == 1
        assert err == (f"gearmap: interrupted; {path}.part keeps the finished points, "
                       "the same command resumes\n")
    resumed = result_of("sweep", EXAMPLE, "-o", path, *FINE)
    assert resumed["resumed"] > 0
    assert resumed["resumed"] + resumed["points"] == uninterrupted["points"]
    assert resumed["content_hash"] == uninterrupted["content_hash"]
    assert [p.name for p in tmp_path.iterdir()] == ["m.map"]


def test_the_journal_of_another_sweep_is_not_resumed(tmp_path):
    path = tmp_path / "m.map"
    process = started(path)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    cold = result_of("sweep", EXAMPLE, "-o", path, *FINE, "--oil-temperature", "30degC",
                     "--threads", "2")
    assert cold["resumed"] == 0


def test_a_progress_bar_is_drawn_on_a_terminal_only(tmp_path):
    """Through a pseudo terminal the bar appears and is wiped at the end."""
    try:
        main, side = pty.openpty()
    except OSError:
        pytest.skip("no pseudo terminals here")
    process = subprocess.Popen([PROGRAM, "sweep", EXAMPLE, "-o", tmp_path / "m.map", *FINE],
                               stdout=subprocess.DEVNULL, stderr=side)
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
    assert process.wait(timeout=60) == 0
    assert re.search(rb"\rsweep dct7 \[#*\.*\] +\d+ %  \d+ of \d+ points, \d+/s", seen)
    assert seen.endswith(b"\r")
    quiet = succeeds("sweep", EXAMPLE, "-o", tmp_path / "n.map", *COARSE)
    assert quiet.stderr == ""


def test_an_older_map_is_replaced_only_by_a_whole_one(tmp_path):
    path = tmp_path / "m.map"
    succeeds("sweep", EXAMPLE, "-o", path, *COARSE)
    before = path.read_bytes()
    process = started(path)
    process.kill()
    process.communicate(timeout=60)
    assert path.read_bytes() == before


OUTPUTS = {
    "no_such_folder/m.map": "No such file or directory",
    "folder": "it is a folder",
    "/dev/null": "it is not a regular file",
    "/proc/m.map": "",
    "x" * 300: "File name too long",
}


@pytest.mark.parametrize("output", OUTPUTS, ids=["missing", "folder", "device", "proc", "long"])
@pytest.mark.parametrize("command", ["sweep", "reduce"])
def test_an_output_that_cannot_be_written(command, output, tmp_path):
    (tmp_path / "folder").mkdir()
    started_at = time.monotonic()
    sentence = fails(command, EXAMPLE, "-o", output, cwd=tmp_path)
    # refused before the work: the sweep alone would take longer on the default axes
    assert time.monotonic() - started_at < 0.5
    assert sentence.startswith(output) and "cannot be written" in sentence
    assert OUTPUTS[output] in sentence
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_the_input_is_never_overwritten(tmp_path):
    path = tmp_path / "gearset.yaml"
    shutil.copy(EXAMPLE, path)
    for name in (path, tmp_path / "." / "gearset.yaml"):
        assert fails("sweep", path, "-o", name) == \
            f"{name}: is the input; the output needs another name"
    assert path.read_bytes() == EXAMPLE.read_bytes()
