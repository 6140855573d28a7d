# SPDX-License-Identifier: BSD-2-Clause
"""The detailed gearset as an FMU in motion: against `gearmap simulate`, and exchanged for
the reduced one."""

import csv

import fmpy
import numpy as np
import pytest
from conftest import EXAMPLES, succeeds

RPM = np.pi / 30


def drive(fmu, path, gears, duration, times, tau, load, **options):
    """One drive, whichever FMU it is: torques constant in pieces, a gear per piece."""
    signals = np.array(
        [(t, a, b, g) for t, a, b, g in zip(times, tau, load, gears)],
        dtype=[("time", float), (f"{path}.tau", float), ("output.tau", float),
               (f"{path}.gear", int)])
    said = []
    # many outputs: the solver of fmpy gives up after 500 steps between two of them
    result = fmpy.simulate_fmu(
        fmu.file, fmi_type="ModelExchange", solver="CVode", stop_time=duration,
        output_interval=5e-4, input=signals, start_values={f"{path}.gear": gears[0],
                                                           **options.pop("start", {})},
        output=["output.w", f"{path}.w", f"{path}.state", "work", "loss_energy",
                "kinetic_energy", "elastic_energy"],
        logger=lambda *message: said.append(message[-1]), **options)
    assert said == []
    return result


def at(result, name, t):
    return result[name][np.searchsorted(result["time"], t + 1e-9) - 1]


def steps(path, ratio):
    """Torque of one sign, then of the other, against most of it at the output."""
    times, tau = [0.0, 0.03, 0.03, 0.06], [4.0, 4.0, -3.0, -3.0]
    return times, tau, [-0.7 * ratio * t for t in tau]


@pytest.mark.parametrize("name", EXAMPLES)
def test_same_as_simulate(bake, name, tmp_path):
    """Two solvers, one model. They follow vibrations after impacts within their tolerance:
    1e-5 of usual values is 4e-4 rad/s at every step, which friction around standstill
    spreads; 1 % of the largest speed is the limit."""
    fmu = bake(name)
    path = next(iter(fmu.gears))
    gear = min(g for g in fmu.gears[path] if g > 0)
    ratio = fmu.gears[path][gear]
    times, tau, load = steps(path, ratio)
    schedule, table = tmp_path / "s.csv", tmp_path / "o.csv"
    with open(schedule, "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["time_s", f"{path}.tau_Nm", "output.tau_Nm", f"{path}.gear",
                       "output.w_start_rpm"])
        rows.writerows([t, a, b, gear, 100.0] for t, a, b in zip(times, tau, load))
    succeeds("simulate", fmu.source, "-s", schedule, "-o", table, "--tolerance", "1e-5",
             "--output-step", "10ms")
    with open(table, newline="") as file:
        reference = list(csv.DictReader(file))
    result = drive(fmu, path, [gear] * 4, times[-1], times, tau, load,
                   relative_tolerance=1e-5, start={"output.w_start": 100.0 * RPM})
    for flange in ("output", path):
        speeds = np.array([float(r[f"{flange}.speed_rpm"]) * RPM for r in reference])
        mine = [at(result, f"{flange}.w", float(r["time_s"])) for r in reference]
        assert np.abs(speeds - mine).max() <= 0.01 * np.abs(speeds).max()
    stored = result["kinetic_energy"] + result["elastic_energy"]
    balance = result["work"] - result["loss_energy"] - (stored - stored[0])
    assert np.abs(balance).max() < 0.01 * np.abs(result["work"]).max()


@pytest.mark.parametrize("name, path, gear", [("dct7", "odd", 3), ("mt5", "input", 2)])
def test_exchanged_for_the_reduced_one(bake, reduced, name, path, gear):
    """The same script, another file: the mean motion is the same; the rest is vibration and
    what the tables leave, a few per cent of the loss at so small a torque."""
    ratio = bake(name).gears[path][gear]
    times, tau, gears = [0.0, 0.25], [5.0, 5.0], [gear, gear]
    results = [drive(fmu, path, gears, times[-1], times, tau, [-0.5 * ratio * t for t in tau],
                     relative_tolerance=1e-6, start={"output.w_start": 60.0})
               for fmu in (bake(name), reduced(name))]
    for n in ("output.w", f"{path}.w", "work", "loss_energy"):
        a, b = (r[n][-1] for r in results)
        assert a == pytest.approx(b, rel=0.05 if n == "loss_energy" else 0.02), n


def test_a_shift_exchanged_for_the_reduced_one(bake, reduced):
    """The reduced one has one capacity for all gears of a path, the smallest, so it locks
    later, and it has no impacts in its backlashes: 10 % of the energy lost."""
    ratio = bake("dct7").gears["odd"][3]
    times, tau = [0.0, 0.1, 0.1, 0.25], [0.0, 0.0, 5.0, 5.0]
    results = [drive(fmu, "odd", [0, 0, 3, 3], times[-1], times, tau,
                     [-0.5 * ratio * t for t in tau], relative_tolerance=1e-6,
                     start={"output.w_start": 60.0, "odd.w_start": 120.0})
               for fmu in (bake("dct7"), reduced("dct7"))]
    for n in ("output.w", "odd.w", "work", "loss_energy"):
        a, b = (r[n][-1] for r in results)
        assert a == pytest.approx(b, rel=0.1 if n == "loss_energy" else 0.02), n
    for r in results:
        assert list(dict.fromkeys(r["odd.state"])) == [0, 1, 2]


@pytest.mark.parametrize("name, path, gear", [("dct7", "even", 2), ("at3_simpson", "input", 2)])
def test_synchronising_as_in_simulate(bake, name, path, gear, tmp_path):
    """The lock closes at the same time in both."""
    fmu = bake(name)
    schedule, table = tmp_path / "s.csv", tmp_path / "o.csv"
    schedule.write_text(
        f"time_s,{path}.tau_Nm,output.tau_Nm,{path}.gear,output.w_start_rpm\n"
        f"0,0,0,0,300\n0.02,0,0,0,300\n0.02,0,0,{gear},300\n0.3,0,0,{gear},300\n")
    succeeds("simulate", fmu.source, "-s", schedule, "-o", table, "--tolerance", "1e-5",
             "--output-step", "0.5ms")
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    locked = next(float(r["time_s"]) for r in rows if r[f"{path}.state"] == "2")
    result = drive(fmu, path, [0, 0, gear, gear], 0.3, [0.0, 0.02, 0.02, 0.3], [0.0] * 4,
                   [0.0] * 4, relative_tolerance=1e-5, start={"output.w_start": 300 * RPM})
    mine = result["time"][list(result[f"{path}.state"]).index(2)]
    assert abs(mine - locked) <= 0.0011 and locked > 0.02


def test_an_infinite_capacity_locks_at_once(bake, host):
    with host(bake("dct7")) as h:
        h.start({"output.w_start": 20.0, "odd.sync_torque": 1e30})
        h.event({"odd.gear": 3})
        assert h.get("odd.state") == 2


def test_capacity_scales_the_cones(bake, host):
    """Twice the capacity brings the gear twice the acceleration, beyond drag."""
    rates = []
    for factor in (1.0, 2.0, 3.0):
        with host(bake("dct7")) as h:
            start = bake("dct7").variables["odd.sync_torque"].start
            h.start({"output.w_start": 20.0, "odd.sync_torque": factor * float(start)})
            h.event({"odd.gear": 3})
            assert h.get("odd.state") == 1
            rates.append(h.get("der(body.g3_driven.w)"))
    assert rates[2] - rates[1] == pytest.approx(rates[1] - rates[0], rel=1e-9)
    assert abs(rates[1]) > abs(rates[0])
