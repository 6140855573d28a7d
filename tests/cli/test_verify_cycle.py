# SPDX-License-Identifier: BSD-2-Clause
"""gearmap verify --cycle: one vehicle, one cycle, both gearsets."""

import csv
import json
import math
import re

import pytest
from conftest import EXAMPLE, ROOT, fails, gearmap, result_of, succeeds

FIGURES = {"engine_speed_rms_rad_s", "vehicle_speed_rms_km_h",
           "output_torque_5Hz_rms_relative", "input_torque_5Hz_rms_relative",
           "loss_energy_relative"}


@pytest.fixture(scope="module")
def trace(tmp_path_factory):
    return tmp_path_factory.mktemp("cycle") / "trace.csv"


@pytest.fixture(scope="module")
def driven(example_fmu, trace):
    """A looser tolerance: the figures are looked at elsewhere, here it is the form. At 1e-4
    steps are too long for a clutch that closes: errors of the solver beside the gearset's."""
    return result_of("verify", EXAMPLE, example_fmu, "--cycle", "ece15", "--tolerance",
                     "1e-5", "--trace", trace)


def test_schema_of_the_result(driven):
    assert driven["cycle"] == "ece15" and driven["duration_s"] == 195
    assert driven["same_description"] is True
    for run in [driven["detailed"], *driven["reduced"]]:
        assert run["cpu_s"] > 0 and run["steps"] > 1000
        assert run["real_time_factor"] == pytest.approx(195 / run["cpu_s"])
    assert [run["fidelity"] for run in driven["reduced"]] == ["rigid", "lash"]
    for run in driven["reduced"]:
        assert set(run["errors"]) == FIGURES
        assert run["cpu_saved"] == pytest.approx(1 - run["cpu_s"] / driven["detailed"]["cpu_s"])
        assert sum(row["time_s"] for row in run["loss_by_gear"]) == pytest.approx(195)
        assert [(s["from"], s["to"]) for s in run["shifts"]] == [
            (1, 2), (2, 1), (1, 2), (2, 3), (3, 2), (2, 1)]
        assert len(run["worst"]) == 5


def test_all_energy_is_accounted_for(driven):
    """The account is open by the error of the solution, ten times its tolerance."""
    for run in [driven["detailed"], *driven["reduced"]]:
        assert run["energy_balance_relative"] < 1e-4


def test_reduced_drives_like_detailed(driven):
    """Twice the figures of a map with the default axes: this one is coarse."""
    rigid = driven["reduced"][0]["errors"]
    assert rigid["engine_speed_rms_rad_s"] < 0.8
    assert rigid["vehicle_speed_rms_km_h"] < 0.02
    assert rigid["output_torque_5Hz_rms_relative"] < 0.1
    assert driven["reduced"][0]["cpu_saved"] > 0.5


def test_trace_has_all_drives(driven, trace):
    with trace.open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 39001
    last = rows[-1]
    assert float(last["time_s"]) == 195
    for run in ("detailed", "rigid", "lash"):
        assert float(last[f"{run}.loss_energy_J"]) > 1e4
        assert float(last[f"{run}.cpu_s"]) > 0
        assert abs(float(last[f"{run}.vehicle_speed_km_h"])) < 0.1
    assert max(float(row["rigid.vehicle_speed_km_h"]) for row in rows[::100]) > 49
    assert all(math.isfinite(float(v)) for row in rows[::500] for v in row.values())


def test_a_cycle_of_ones_own(example_fmu, tmp_path):
    """Up a hill and to a stop, in the gears of the file."""
    cycle = tmp_path / "hill.csv"
    cycle.write_text("time_s,speed_km_h,gear,grade_percent\n"
                     "0,0,1,5\n2,0,1,5\n8,20,2,5\n12,20,,5\n17,0,1,0\n20,0,1,0\n")
    got = result_of("verify", EXAMPLE, example_fmu, "--cycle", cycle, "--fidelity", "rigid",
                    "--tolerance", "1e-4")
    assert got["cycle"] == "hill" and got["duration_s"] == 20
    # with one fidelity the figures stand at the top
    assert got["reduced"]["fidelity"] == "rigid"
    assert got["reduced"]["real_time_factor"] == pytest.approx(20 / got["reduced"]["cpu_s"])
    assert got["cpu_saved"] == pytest.approx(
        1 - got["reduced"]["cpu_s"] / got["detailed"]["cpu_s"])
    assert set(got["errors"]) == FIGURES and got["loss_by_gear"] and got["worst"]
    assert got["energy_balance_relative"] == max(
        got[run]["energy_balance_relative"] for run in ("detailed", "reduced"))
    cycle.write_text("time_s,speed_km_h\n0,0\n5,20 km/h\n")
    assert fails("verify", EXAMPLE, example_fmu, "--cycle", cycle) == (
        f"{cycle}:3: column speed_km_h: found '20 km/h', expected a number")


def test_another_vehicle(example_fmu, tmp_path):
    """A heavier car with tyres that slip and soft mounts takes more energy."""
    cycle = tmp_path / "short.csv"
    cycle.write_text("time_s,speed_km_h,gear\n0,0,1\n2,0,1\n8,20,1\n12,0,1\n14,0,1\n")
    text = (ROOT / "examples" / "vehicle_c_segment.yaml").read_text()
    vehicle = tmp_path / "heavy.yaml"
    vehicle.write_text(text.replace("mass_kg: 1416", "mass_kg: 2000")
                       .replace("# tyres:", "tyres:").replace("# mounts:", "mounts:"))
    options = ["--cycle", cycle, "--fidelity", "rigid", "--tolerance", "1e-4"]
    usual = result_of("verify", EXAMPLE, example_fmu, *options)
    heavy = result_of("verify", EXAMPLE, example_fmu, *options, "--vehicle", vehicle)
    loss = [sum(row["detailed_J"] for row in got["loss_by_gear"]) for got in (usual, heavy)]
    assert loss[1] > 1.1 * loss[0]
    assert heavy["detailed"]["energy_balance_relative"] < 1e-3
    vehicle.write_text(text.replace("mass_kg: 1416", "mass_kg: 1.4 t"))
    assert f"{vehicle}:16: body: mass_kg must be" in fails(
        "verify", EXAMPLE, example_fmu, *options, "--vehicle", vehicle)


def test_one_gear_at_high_speed(tmp_path):
    """Coasting from 70 km/h at 5000 rpm the solver gets stuck on the way and has to begin
    anew."""
    ev1 = EXAMPLE.parent / "ev1.yaml"
    succeeds("reduce", ev1, "-o", tmp_path / "ev1.fmu", "--points", 10)
    result = result_of("verify", ev1, tmp_path / "ev1.fmu", "--cycle", "eudc")
    for run in result["reduced"]:
        assert abs(run["errors"]["loss_energy_relative"]) < 3e-3


def test_wrong_wishes_are_refused(example_fmu, tmp_path):
    assert "wltc3b" in fails("verify", EXAMPLE, example_fmu, "--cycle", "ftp75")
    assert gearmap("verify", EXAMPLE, example_fmu).returncode == 2
    assert gearmap("verify", EXAMPLE, example_fmu, "--steady", "--trace", "x").returncode == 2
    assert gearmap("verify", EXAMPLE, example_fmu, "--cycle", "ece15", "--fidelity",
                   "soft").returncode == 2
    missing = tmp_path / "no" / "trace.csv"
    fails("verify", EXAMPLE, example_fmu, "--cycle", "ece15", "--trace", missing)


# ---- Co-Simulation ----


@pytest.fixture(scope="module")
def hill(tmp_path_factory):
    """Seconds of driving with a launch, a shift and a stop."""
    path = tmp_path_factory.mktemp("hill") / "hill.csv"
    path.write_text("time_s,speed_km_h,gear\n0,0,1\n2,0,1\n8,25,2\n12,25,2\n17,0,1\n19,0,1\n")
    return path


def in_steps(example_fmu, hill, step, *options):
    done = gearmap("verify", EXAMPLE, example_fmu, "--cycle", hill, "--communication-step",
                   step, "--json", *options)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["reduced"], done.stderr


def test_co_simulation_stands_beside_model_exchange(example_fmu, hill, tmp_path):
    trace = tmp_path / "trace.csv"
    runs, words = in_steps(example_fmu, hill, "1ms", "--trace", trace)
    assert [(r["fidelity"], r["communication_step_s"]) for r in runs] == [
        ("rigid", None), ("lash", None), ("rigid", 0.001), ("lash", 0.001)]
    assert [r["recommended_step_s"] for r in runs[:2]] == [None, None]
    assert runs[2]["recommended_step_s"] > 0.001 > runs[3]["recommended_step_s"] > 0
    assert all(set(r["errors"]) == FIGURES and r["worst"] for r in runs)
    assert re.fullmatch(r"gearmap: note: .* recommends steps of 0\.\d+ ms at most in fidelity "
                        r"lash, not 1 ms\n", words)
    head = trace.read_text().splitlines()[0].split(",")
    assert {"rigid.vehicle_speed_km_h", "lash_cs.vehicle_speed_km_h"} <= set(head)
    assert len(head) == len(set(head))


def test_co_simulation_is_as_near_with_fitting_steps(example_fmu, hill):
    """In steps that the component recommends the coupling adds little to what the tables
    leave: half as much again is several times what was found (14 %)."""
    runs, words = in_steps(example_fmu, hill, "0.2ms")
    assert words == ""
    for exchange, steps in zip(runs[:2], runs[2:]):
        for figure in ("engine_speed_rms_rad_s", "vehicle_speed_rms_km_h",
                       "output_torque_5Hz_rms_relative"):
            assert steps["errors"][figure] < 1.5 * exchange["errors"][figure]
        assert steps["energy_balance_relative"] < 1e-4


def test_co_simulation_is_stable_in_long_steps(example_fmu, hill):
    """A clutch of 600 N.m.s/rad beside an input of 0.002 kg.m2: held speeds would want
    steps below 0.007 ms. Unstable clutches would swing by their whole capacity."""
    runs, _ = in_steps(example_fmu, hill, "2ms", "--fidelity", "rigid")
    assert runs[1]["communication_step_s"] == 0.002
    assert runs[1]["errors"]["vehicle_speed_rms_km_h"] < 0.05
    assert runs[1]["errors"]["input_torque_5Hz_rms_relative"] < 0.3


def test_co_simulation_has_its_column(example_fmu, hill):
    text = succeeds("verify", EXAMPLE, example_fmu, "--cycle", hill, "--fidelity", "rigid",
                    "--communication-step", "1ms", "--tolerance", "1e-4", "--summary").stdout
    assert re.search(r"^ +detailed +rigid +rigid \(CS, 1 ms\)$", text, re.M)
    widths = {len(line) for line in text.splitlines()[2:]}
    assert len(widths) == 1


def test_wrong_steps_are_refused(example_fmu):
    usage = gearmap("verify", EXAMPLE, example_fmu, "--steady", "--communication-step", "1ms")
    assert usage.returncode == 2 and "needs --cycle" in usage.stderr
    for step in ("0", "1", "fast"):
        assert gearmap("verify", EXAMPLE, example_fmu, "--cycle", "ece15",
                       "--communication-step", step).returncode == 2
