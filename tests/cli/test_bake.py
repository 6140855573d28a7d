# SPDX-License-Identifier: BSD-2-Clause
"""gearmap bake: same bytes, no compiler, maps that are none."""

import os
import random
import shutil
import signal
import sqlite3
import subprocess
import time

import pytest
from conftest import COARSE, EXAMPLE, PROGRAM, fails, gearmap, result_of, succeeds


def test_bakes_the_same_bytes_twice(example_map, tmp_path):
    (tmp_path / "other").mkdir()
    succeeds("bake", example_map, "-o", tmp_path / "a.fmu")
    succeeds("bake", example_map, "-o", tmp_path / "other" / "a.fmu",
             env={"TZ": "Asia/Tokyo", "LC_ALL": "C", "TMPDIR": str(tmp_path / "other")})
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "other" / "a.fmu").read_bytes()


def test_speeds_in(example_map, tmp_path):
    """Another component of the same map; a flange that is not there leaves nothing."""
    guids = [result_of("bake", example_map, "-o", tmp_path / f"{n}.fmu", *more)["guid"]
             for n, more in enumerate([(), ("--speed-in", "output"),
                                       ("--speed-in", "output,odd")])]
    assert len(set(guids)) == 3
    sentence = fails("bake", example_map, "-o", tmp_path / "x.fmu", "--speed-in", "output,front")
    assert sentence == ('there is no flange "front" whose speed could be an input '
                        "(only odd, even, output)")
    assert len(list(tmp_path.iterdir())) == 3
    for how in (["--steady", "--points", "10"], ["--cycle", "ece15"]):
        assert "speeds out at every flange" in fails("verify", EXAMPLE, tmp_path / "1.fmu", *how)


def test_json_of_a_bake(example_map, tmp_path):
    r = result_of("bake", example_map, "-o", tmp_path / "a.fmu")
    assert r["size_bytes"] == (tmp_path / "a.fmu").stat().st_size
    assert 0 < r["library_size_bytes"]
    assert r["guid"] and r["compiler"]
    assert [p.name for p in tmp_path.iterdir()] == ["a.fmu"]


def refused(map_file, tmp_path, *words, **options):
    output = tmp_path / "out"
    output.mkdir(exist_ok=True)
    sentence = fails("bake", map_file, "-o", output / "a.fmu", **options)
    assert list(output.iterdir()) == []
    for word in words:
        assert word in sentence
    return sentence


def test_no_compiler(example_map, tmp_path):
    empty = tmp_path / "bin"
    empty.mkdir()
    environment = {k: v for k, v in os.environ.items() if k != "CC"}
    assert "compiler" in refused(example_map, tmp_path,
                                 env={**environment, "PATH": str(empty), "CC": ""})


def test_a_compiler_that_does_not_exist(example_map, tmp_path):
    refused(example_map, tmp_path, env={"CC": "/nowhere/cc"})
    output = tmp_path / "b.fmu"
    assert "/nowhere/cc" in fails("bake", example_map, "-o", output, "--compiler",
                                  "/nowhere/cc")
    assert not output.exists()


def test_a_compiler_that_fails(example_map, tmp_path):
    refused(example_map, tmp_path, env={"CC": "false"})


@pytest.mark.parametrize("command", ["bake", "reduce"])
def test_an_interrupted_bake_leaves_nothing(command, example_map, tmp_path):
    """Ctrl-C on a terminal reaches the compiler too; a compiler that hangs is caught."""
    compiler, marker = tmp_path / "slow-cc", tmp_path / "marker"
    compiler.write_text("#!/bin/sh\n"
                        'case "$*" in *-version*|*-dumpmachine*) exec cc "$@";; esac\n'
                        f'touch {marker}\nexec sleep 60\n')
    compiler.chmod(0o755)
    for name in ("out", "temporary"):
        (tmp_path / name).mkdir()
    given = example_map if command == "bake" else EXAMPLE
    more = [] if command == "bake" else COARSE
    process = subprocess.Popen(
        [PROGRAM, command, given, "-o", tmp_path / "out" / "a.fmu", "--compiler", compiler,
         *more],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        env={**os.environ, "TMPDIR": str(tmp_path / "temporary")})
    deadline = time.monotonic() + 60
    while not marker.exists():
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out) == (1, "")
    assert err == "gearmap: interrupted; no component was written\n"
    assert list((tmp_path / "out").iterdir()) == []
    assert list((tmp_path / "temporary").iterdir()) == []


def test_no_sources_to_bake(example_map, tmp_path):
    refused(example_map, tmp_path, "GEARMAP_SHARE", env={"GEARMAP_SHARE": str(tmp_path)})


def test_an_existing_component_survives_a_failure(example_map, tmp_path):
    output = tmp_path / "a.fmu"
    succeeds("bake", example_map, "-o", output)
    before = output.read_bytes()
    fails("bake", example_map, "-o", output, env={"CC": "false"})
    assert output.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["a.fmu"]


def test_a_missing_map(tmp_path):
    refused(tmp_path / "none.map", tmp_path, "none.map")
    assert not (tmp_path / "none.map").exists()


def test_a_description_is_no_map(tmp_path):
    refused(EXAMPLE, tmp_path, str(EXAMPLE))


@pytest.mark.parametrize("part", [0.0, 0.01, 0.5, 0.9, 0.999])
def test_a_truncated_map(part, example_map, tmp_path):
    data = example_map.read_bytes()
    path = tmp_path / "short.map"
    path.write_bytes(data[:int(part * len(data))])
    refused(path, tmp_path, "short.map")


@pytest.fixture(scope="module")
def whole(example_map, tmp_path_factory):
    """What an undamaged map gives."""
    path = tmp_path_factory.mktemp("whole") / "a.fmu"
    succeeds("bake", example_map, "-o", path)
    return path.read_bytes()


@pytest.mark.parametrize("place", [0.0005, 0.2, 0.4, 0.6, 0.8])
def test_a_damaged_map(place, example_map, tmp_path, whole):
    """Bytes are overwritten: either the map is refused, or (in unused space of the file)
    what it says is untouched."""
    data = bytearray(example_map.read_bytes())
    start = int(place * len(data))
    data[start:start + 512] = random.Random(1).randbytes(512)
    path = tmp_path / "damaged.map"
    path.write_bytes(data)
    done = gearmap("bake", path, "-o", tmp_path / "b.fmu")
    if done.returncode == 0:
        assert (tmp_path / "b.fmu").read_bytes() == whole
    else:
        refused(path, tmp_path, "damaged.map")
        assert not (tmp_path / "b.fmu").exists()


def test_a_map_damaged_everywhere(example_map, tmp_path):
    """One byte in every 64 is flipped: no table can have survived."""
    data = bytearray(example_map.read_bytes())
    for i in range(100, len(data), 64):
        data[i] ^= 0xFF
    path = tmp_path / "damaged.map"
    path.write_bytes(data)
    refused(path, tmp_path, "damaged.map")


def test_a_foreign_database(tmp_path):
    path = tmp_path / "foreign.map"
    with sqlite3.connect(path) as db:
        db.execute("create table songs (title text)")
    db.close()
    refused(path, tmp_path, "foreign.map")


@pytest.mark.parametrize("change", [
    "update value set value = value * (1 + 1e-12) + 1e-12 where map_table = 1 and i = 1",
    "update gear set ratio = -ratio where gear = 1",
    "update path set inertia = inertia * 2 where path = 0",
    "update axis_value set x = x + 1e-6 where i = 1",
    "update meta set value = 'another' where key = 'options'",
])
def test_a_changed_map(change, example_map, tmp_path):
    """A map whose content does not give its content hash is refused."""
    refused(altered(example_map, tmp_path, change), tmp_path, "altered.map")


@pytest.mark.parametrize("change", [
    "delete from value where map_table = 1 and i = 1",
    "delete from value where map_table = (select max(id) from map_table)",
    "delete from meta where key = 'content_hash'",
    "drop table value",
])
def test_an_incomplete_map(change, example_map, tmp_path):
    refused(altered(example_map, tmp_path, change), tmp_path, "altered.map")


def altered(example_map, tmp_path, change):
    path = tmp_path / "altered.map"
    shutil.copy(example_map, path)
    db = sqlite3.connect(path)
    cursor = db.execute(change)
    assert change.startswith("drop") or cursor.rowcount > 0
    db.commit()
    db.close()
    return path


@pytest.mark.parametrize("output", ["no/a.fmu", ".", "/dev/null"])
def test_an_output_that_cannot_be_written(output, example_map, tmp_path):
    assert "cannot be written" in fails("bake", example_map, "-o", output, cwd=tmp_path)
    assert list(tmp_path.iterdir()) == []
