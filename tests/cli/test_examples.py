# SPDX-License-Identifier: BSD-2-Clause
"""Every file in examples/ is a whole gearset: it is checked, reduced, compared with its
detailed model, and its component simulates. Nothing here knows a name of a gearset."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import ROOT, result_of
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

sys.path.insert(0, str(ROOT / "tests"))
from plain_yaml import block, logical_lines  # noqa: E402

FILES = [f for f in sorted((ROOT / "examples").glob("*.yaml"))
         if not f.name.startswith("vehicle_")]


def test_there_are_examples():
    assert {"dct7.yaml", "dct6_wet.yaml", "mt5.yaml", "ev1.yaml", "at3_simpson.yaml",
            "at4_ravigneaux.yaml"} <= {file.name for file in FILES}


@pytest.fixture(scope="module", params=FILES, ids=lambda file: file.stem)
def example(request, tmp_path_factory):
    fmu = tmp_path_factory.mktemp("fmu") / f"{request.param.stem}.fmu"
    reduced = result_of("reduce", request.param, "-o", fmu, "--points", "200")
    checked = result_of("check", request.param)
    gears = [(path, gear) for path in checked["paths"] for gear in path["gears"]]
    return SimpleNamespace(file=request.param, fmu=str(fmu), checked=checked,
                           verified=reduced["verify"], gears=gears)


def test_gears_have_the_given_ratios(example):
    for _, gear in example.gears:
        # four decimals of ratios above 1 are given
        assert gear["ratio"] == pytest.approx(gear["ratio_given"], rel=1e-4)
    forward = {np.sign(g["ratio"]) for _, g in example.gears if g["number"] > 0}
    assert len(forward) == 1
    assert {np.sign(g["ratio"]) for _, g in example.gears if g["number"] < 0} <= \
        {-sign for sign in forward}


def test_forward_gears_are_steps(example):
    """A higher number is a smaller ratio, with sensible steps between them."""
    ratios = {g["number"]: abs(g["ratio"]) for _, g in example.gears if g["number"] > 0}
    assert sorted(ratios) == list(range(1, len(ratios) + 1))
    for number in range(2, len(ratios) + 1):
        assert 1.1 < ratios[number - 1] / ratios[number] < 2


def test_power_flows_from_the_flange_to_the_output(example):
    written = block(logical_lines(example.file.read_text()), 0)
    for path, gear in example.gears:
        flow = gear["power_flow"]
        assert flow[0] == written["paths"][path["name"]]["shaft"]
        assert flow[-1] == written["output"]
        locked = written["paths"][path["name"]]["gears"][str(gear["number"])]["lock"]
        for lock in locked if isinstance(locked, list) else [locked]:
            if lock in written["gears"]:
                assert lock in flow


def test_a_flange_in_gear_turns_more_than_in_neutral(example):
    assert example.checked["inertia_output_kgm2"] > 0
    for path, gear in example.gears:
        assert gear["inertia_at_input_kgm2"] > path["inertia_kgm2"] > 0


def test_a_gear_at_work_loses_little(example):
    """At 2000 rpm and 100 N.m 95 to 99 % of the power arrive (ZF's figure for manual
    gearsets of cars, with splash: 92 to 97 %; a pair of gears alone 99.0 to 99.8 %; here two
    or three pairs, their bearings and little splash). A planetary set passes part of the
    power without rolling: up to 99.3 %; direct drive has only drag."""
    for _, gear in example.gears:
        point = result_of("check", example.file, "--gear", gear["number"], "--speed", "2000",
                          "--torque", "100")["point"]
        assert 0.95 < point["efficiency"] < (0.998 if gear["ratio"] == 1 else 0.993)
        assert point["output_speed_rpm"] == pytest.approx(2000 / gear["ratio"])


def test_the_component_is_near_its_detailed_model(example):
    seen = {(c["path"], c["gear"]) for c in example.verified["cases"]}
    assert seen == {(p["name"], g["number"]) for p, g in example.gears}
    # the default axes are made for half a percent of each gear's largest loss; twice that,
    # because a small sample may by chance hit a worst point
    assert 0 < example.verified["max_relative"] <= 0.01
    assert 0 < example.verified["rms_relative"] <= 0.002


def test_the_component_is_valid(example):
    assert validate_fmu(example.fmu) == []


def test_the_component_simulates_a_second(example):
    """From rest in the highest gear, with a torque that without losses would lead to 500
    rad/s in one second. The losses of so small a torque take less than half of it."""
    path, gear = max(example.gears, key=lambda pair: pair[1]["number"])
    torque = 500 * gear["inertia_at_input_kgm2"]
    flange = path["name"]
    names = {v.name for v in read_model_description(example.fmu).modelVariables}
    assert {f"{flange}.tau", f"{flange}.gear", f"{flange}.w", "output.tau", "output.w"} <= names
    out = simulate_fmu(example.fmu, stop_time=1.0, output_interval=0.01,
                       start_values={f"{flange}.tau": torque, f"{flange}.gear": gear["number"]},
                       output=[f"{flange}.w", "output.w"])
    assert out["time"][-1] == pytest.approx(1.0)
    for name in (f"{flange}.w", "output.w"):
        assert np.all(np.isfinite(out[name]))
    # 1e-6: what is left after a second of the vibration of fidelity lash, the default
    assert out[f"{flange}.w"][-1] == pytest.approx(gear["ratio"] * out["output.w"][-1], rel=1e-6)
    assert 250 < out[f"{flange}.w"][-1] < 500
