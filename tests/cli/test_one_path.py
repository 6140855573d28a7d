# SPDX-License-Identifier: BSD-2-Clause
"""The whole chain on a gearset with one path: nothing is made for the example alone."""

from pathlib import Path

import pytest
from conftest import EXAMPLE, fails, result_of, succeeds
from fmpy import read_model_description, simulate_fmu

FILE = Path(__file__).with_name("two_speed.yaml")


@pytest.fixture(scope="module")
def reduced(tmp_path_factory):
    path = tmp_path_factory.mktemp("fmu") / "two_speed.fmu"
    return path, result_of("reduce", FILE, "-o", path, "--points", "300")


def test_check_identifies_both_gears():
    (path,) = result_of("check", FILE)["paths"]
    assert path["name"] == "input"
    assert [g["ratio"] for g in path["gears"]] == pytest.approx([-40 / 20, -36 / 24], rel=1e-12)
    assert [g["ratio_given"] for g in path["gears"]] == [-2, None]
    assert path["gears"][0]["power_flow"] == ["drive", "drive_1", "driven_1", "driven"]


def test_a_point_has_no_other_path():
    text = succeeds("check", FILE, "--gear", "2", "--speed", "3000", "--torque", "40").stdout
    assert text.startswith("gear 2 (input) at 3000 rpm and 40.0 N·m, oil 60.0 °C\noutput -2000.0 rpm")


def test_nothing_can_be_preselected():
    assert "cannot be preselected" in fails("check", FILE, "--gear", "2", "--speed", "3000",
                                            "--torque", "40", "--preselect", "1")


def test_verifies_what_one_path_has(reduced):
    _, result = reduced
    assert set(result["verify"]["groups"]) == {"drag", "reaction"}
    seen = {(c["path"], c["gear"], c["direction"]) for c in result["verify"]["cases"]}
    assert seen == {("input", g, d) for g in (1, 2) for d in ("forward", "backward")}
    # default axes are made for half a percent of each gear's largest loss; a wrong table,
    # sign or direction would be tens of percent
    assert result["verify"]["max_relative"] <= 0.005


def test_the_component_names_its_flange_input(reduced):
    path, _ = reduced
    names = {v.name for v in read_model_description(str(path)).modelVariables}
    assert {"input.tau", "input.gear", "input.w", "output.tau", "output.w"} <= names
    assert not any(n.startswith(("odd.", "even.")) for n in names)


def test_the_component_simulates(reduced):
    """From rest in gear 1 with 10 N.m for 50 ms: the output turns backwards, at less
    than the loss-free speed and more than nine tenths of it."""
    path, _ = reduced
    gearset = result_of("check", FILE)
    inertia = gearset["inertia_output_kgm2"] + 4 * gearset["paths"][0]["inertia_kgm2"]
    out = simulate_fmu(str(path), stop_time=0.05, output_interval=1e-3,
                       start_values={"input.tau": 10.0, "input.gear": 1}, output=["output.w"])
    ideal = -2 * 10.0 * 0.05 / inertia
    assert ideal < out["output.w"][-1] < 0.9 * ideal


def test_a_component_of_another_gearset_is_refused(reduced):
    path, _ = reduced
    assert fails("verify", EXAMPLE, path, "--steady") == \
        f"{path}: has 1 input flange where the gearset dct7 has 2"
