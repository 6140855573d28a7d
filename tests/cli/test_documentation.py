# SPDX-License-Identifier: BSD-2-Clause
"""The page inside the FMU tells how accurate the FMU is, once that was measured."""

import re
import zipfile

import pytest
from conftest import COARSE, EXAMPLE, fails, result_of, succeeds


@pytest.fixture(scope="module")
def reduced(tmp_path_factory):
    """FMU and map of one reduction, and its JSON."""
    folder = tmp_path_factory.mktemp("reduced")
    fmu, map_file = folder / "dct7.fmu", folder / "dct7.map"
    result = result_of("reduce", EXAMPLE, "-o", fmu, "--map", map_file, *COARSE)
    return fmu, map_file, result


def page_of(fmu):
    return zipfile.ZipFile(fmu).read("documentation/index.html").decode()


def test_the_page_has_the_errors_that_were_measured(reduced):
    fmu, _, result = reduced
    rows = dict(re.findall(r"<tr><td>([^<]*)</td><td class=\"n\">\d+</td>"
                           r"<td class=\"n\">([\d.e-]+) %</td>", page_of(fmu)))
    worst = 100 * max(c["max_relative"] for c in result["verify"]["cases"])
    assert float(rows["loss, one path engaged"]) == pytest.approx(worst, rel=6e-3)  # 3 digits
    assert set(rows) == {"loss, one path engaged", "loss, with a preselected gear",
                         "loss, both paths loaded", "drag of a shaft in neutral",
                         "its reaction on the output"}


def test_baking_the_map_again_gives_the_same_bytes(reduced, tmp_path):
    """Although reduce measures after it has baked."""
    fmu, map_file, _ = reduced
    succeeds("bake", map_file, "-o", tmp_path / "again.fmu")
    assert (tmp_path / "again.fmu").read_bytes() == fmu.read_bytes()
    assert (tmp_path / "again.fmu").stat().st_mode == fmu.stat().st_mode


def test_a_map_without_measured_errors(example_fmu):
    assert "Not measured" in page_of(example_fmu)


def test_the_interpolation_is_told(example_map, example_fmu, tmp_path):
    fmu = tmp_path / "monotone.fmu"
    succeeds("bake", example_map, "-o", fmu, "--interpolation", "monotone")
    assert "<td>interpolation</td><td><code>monotone</code>" in page_of(fmu)
    assert "monotone cubics" in page_of(fmu)
    assert "<td>interpolation</td><td><code>linear</code>" in page_of(example_fmu)


def test_monotone_tables_are_nearer_to_the_model(tmp_path):
    """Of the losses of one path, on the axes that the sweep chooses; RMS."""
    rms = {}
    for kind in ("linear", "monotone"):
        fmu = tmp_path / f"{kind}.fmu"
        result = result_of("reduce", EXAMPLE, "-o", fmu, "--interpolation", kind)
        rms[kind] = result["verify"]["rms_relative"]
    assert rms["monotone"] < 0.5 * rms["linear"]


def test_an_unknown_interpolation(example_map, tmp_path):
    for command in (("bake", example_map), ("reduce", EXAMPLE)):
        words = fails(*command, "-o", tmp_path / "no.fmu", "--interpolation", "cubic", code=2)
        assert "no interpolation 'cubic'" in words
    assert list(tmp_path.iterdir()) == []
