# SPDX-License-Identifier: BSD-2-Clause
"""gearmap bake: same bytes, no compiler, maps that are none."""

import os
import shutil
import sqlite3

import pytest
from conftest import EXAMPLE, fails, result_of, succeeds


def test_bakes_the_same_bytes_twice(example_map, tmp_path):
    (tmp_path / "other").mkdir()
    succeeds("bake", example_map, "-o", tmp_path / "a.fmu")
    succeeds("bake", example_map, "-o", tmp_path / "other" / "a.fmu",
             env={"TZ": "Asia/Tokyo", "LC_ALL": "C", "TMPDIR": str(tmp_path / "other")})
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "other" / "a.fmu").read_bytes()


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


@pytest.mark.parametrize("place", [0.001, 0.2, 0.4, 0.6, 0.8])
def test_a_damaged_map(place, example_map, tmp_path):
    """One page of the file is overwritten."""
    data = bytearray(example_map.read_bytes())
    start = int(place * len(data))
    data[start:start + 512] = os.urandom(512)
    path = tmp_path / "damaged.map"
    path.write_bytes(data)
    refused(path, tmp_path, "damaged.map")


def test_a_foreign_database(tmp_path):
    path = tmp_path / "foreign.map"
    with sqlite3.connect(path) as db:
        db.execute("create table songs (title text)")
    db.close()
    refused(path, tmp_path, "foreign.map")


def test_a_changed_number(example_map, tmp_path):
    """A map whose content does not give its content hash is refused."""
    path = tmp_path / "changed.map"
    shutil.copy(example_map, path)
    db = sqlite3.connect(path)
    tables = [row[0] for row in db.execute(
        "select name from sqlite_master where type = 'table'")]
    changed = 0
    for table in tables:
        columns = [row[1:3] for row in db.execute(f"pragma table_info({table})")]
        for name, kind in columns:
            if kind.upper() == "REAL" and not changed:
                changed = db.execute(
                    f"update {table} set {name} = {name} * 1.0001 + 1e-6 where rowid = "
                    f"(select max(rowid) from {table} where {name} is not null)").rowcount
    db.commit()
    db.close()
    assert changed, "the map has no table with a number"
    refused(path, tmp_path, "changed.map")


def test_an_unfinished_journal_is_no_map(tmp_path, example_map):
    """The journal's own name is refused by its content, not by its name."""
    path = tmp_path / "half.map"
    shutil.copy(example_map, path)
    db = sqlite3.connect(path)
    for (table,) in db.execute("select name from sqlite_master where type = 'table'").fetchall():
        if db.execute(f"select count(*) from {table}").fetchone()[0] > 50:
            db.execute(f"delete from {table} where rowid > "
                       f"(select max(rowid) / 2 from {table})")
    db.commit()
    db.close()
    refused(path, tmp_path, "half.map")


@pytest.mark.parametrize("output", ["no/a.fmu", ".", "/dev/null"])
def test_an_output_that_cannot_be_written(output, example_map, tmp_path):
    assert "cannot be written" in fails("bake", example_map, "-o", output, cwd=tmp_path)
    assert list(tmp_path.iterdir()) == []
