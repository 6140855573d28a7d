# SPDX-License-Identifier: BSD-2-Clause
"""Co-Simulation with fmpy as the master."""

import threading

import fmpy
import numpy as np
import pytest

OUTPUTS = ["output.w", "output.phi", "odd.phi", "even.phi", "odd.w", "even.w", "work",
           "loss_energy", "kinetic_energy", "elastic_energy", "odd.state", "even.state", "out_of_map"]
STOP = 18.0


def command(t, w):
    """Drive-away in first, hand-over to second and to third, overlapping; then clutches
    open, a brake in proportion to speed, and at last a slope that friction can hold."""
    second = min(max((t - 3.0) / 0.5, 0.0), 1.0)
    third = min(max((t - 6.0) / 0.5, 0.0), 1.0)
    torque = 60.0 if t < 9.0 else 0.0
    odd = 1.0 - second if t < 5.0 else third
    load = -600.0 if t < 3.0 else -350.0 if t < 6.0 else -200.0
    return {"odd.gear": 1 if t < 4.5 else 3 if t < 10.0 else 0,
            "even.gear": 0 if t < 1.0 else 2 if t < 7.5 else 0,
            "odd.tau": torque * odd, "even.tau": torque * (1.0 - odd),
            "output.tau": load if t < 9.0 else max(-300.0, -100.0 * w) - 1.5}


def drive(two, host, fidelity, h=0.001):
    n = round(STOP / h)
    names = [*OUTPUTS, "odd.tau", "even.tau", "output.tau"]
    record = {name: np.zeros(n + 1) for name in names}
    with host(two) as instance:
        instance.start({**command(0.0, 0.0), "fidelity": fidelity})
        for i in range(n + 1):
            for name in OUTPUTS:
                record[name][i] = instance.get(name)
            values = command(i * h, record["output.w"][i])
            instance.set(values)
            for name in names[len(OUTPUTS):]:
                record[name][i] = values[name]
            if i < n:
                instance.fmu.doStep(i * h, h)
    record["time"] = np.arange(n + 1) * h
    return record


@pytest.fixture(scope="module", params=[1, 2], ids=["rigid", "lash"])
def fidelity(request):
    return request.param


@pytest.fixture(scope="module")
def run(two, host, fidelity):
    return drive(two, host, fidelity)


@pytest.fixture
def same(fidelity):
    """How near engaged paths are to their ratio: in lash, what a slip of the twist is."""
    return 1e-12 if fidelity == 1 else 1e-5


def test_drives_shifts_and_stops(run, same):
    def at(seconds, name):
        return run[name][round(seconds / 0.001)]

    assert at(2.9, "output.w") > 20
    assert at(2.9, "odd.w") == pytest.approx(15 * at(2.9, "output.w"), rel=same)
    assert at(2.9, "even.state") == 2 and at(2.9, "odd.state") == 2  # preselected
    assert at(5.9, "even.w") == pytest.approx((9 + 1 / 3) * at(5.9, "output.w"),
                                               rel=same)
    assert at(5.9, "odd.state") == 2
    assert at(8.9, "odd.w") == pytest.approx(6 * at(8.9, "output.w"), rel=same)
    assert at(8.9, "even.state") == 0 and at(8.9, "output.w") > 50
    assert set(run["even.state"]) == {0, 1, 2}  # the cone took its time
    assert not run["out_of_map"].any()


def test_stands_without_creep(run):
    still = run["time"] > STOP - 2.0
    assert np.all(run["output.w"][still] == 0.0)
    assert np.ptp(run["output.phi"][still]) == 0.0


def test_energy_account_closes(run):
    stored = run["kinetic_energy"] + run["elastic_energy"]
    assert np.ptp(run["work"] - run["loss_energy"] - stored) < 1e-9 * np.abs(run["work"]).max()
    assert np.all(np.diff(run["loss_energy"]) >= 0)


def test_work_is_what_the_flanges_do(run):
    """Sum of torque times angle, computed outside. The torques hold over a step, so both
    say the same to rounding: 54,000 terms of 1e-16 of the sum of magnitudes. Only impulses
    of locking do work on a path without an angle; they are internal and cancel."""
    terms = [run[f"{f}.tau"][:-1] * np.diff(run[f"{f}.phi"]) for f in ("odd", "even", "output")]
    outside = sum(t.sum() for t in terms)
    through = sum(np.abs(t).sum() for t in terms)
    assert abs(outside - run["work"][-1]) < 1e-10 * through


def test_halved_steps_agree_better(two, host, run, fidelity):
    """Implicit midpoint with located events; the torques here are held over a step, which
    is of first order: halving the step halves the error."""
    errors = []
    for h in (0.02, 0.01):
        w = drive(two, host, fidelity, h)["output.w"]
        errors.append(np.abs(w - run["output.w"][::round(h / 0.001)]).max())
    assert errors[1] < 0.6 * errors[0]
    assert errors[0] < 0.02 * run["output.w"].max()


def test_fmpy_drives_away_by_itself(two, fidelity, same):
    """The same drive up to 9 s as an input signal of fmpy's own master."""
    t = np.arange(0.0, 9.0, 0.01)
    names = [("odd.tau", float), ("even.tau", float), ("output.tau", float),
             ("odd.gear", int), ("even.gear", int)]
    signal = np.zeros(len(t), dtype=[("time", float), *names])
    signal["time"] = t
    for i, seconds in enumerate(t):
        for name, value in command(seconds, 0.0).items():
            signal[name][i] = value
    r = fmpy.simulate_fmu(str(two.file), stop_time=8.9, step_size=0.01, output_interval=0.01,
                          input=signal, output=OUTPUTS,
                          start_values={"fidelity": fidelity})
    assert r["output.w"][-1] > 50
    assert r["odd.w"][-1] == pytest.approx(6 * r["output.w"][-1], rel=same)
    stored = r["kinetic_energy"] + r["elastic_energy"]
    assert np.ptp(r["work"] - r["loss_energy"] - stored) < 1e-9 * np.abs(r["work"]).max()


def test_one_path_turns_by_its_ratio(one):
    r = fmpy.simulate_fmu(str(one.file), stop_time=1.0, step_size=0.01,
                          start_values={"input.gear": 1, "input.tau": -20.0, "fidelity": 1},
                          output=["input.w", "output.w"])
    assert r["output.w"][-1] > 5
    assert np.allclose(r["input.w"], -9.0 * r["output.w"], rtol=1e-13, atol=0)


def test_an_unknown_gear_is_refused_with_a_message(two, host, capsys):
    with host(two) as h:
        h.start({"odd.gear": 3, "output.w_start": 10.0})
        h.set({"odd.gear": 8})
        h.step(0.001, 3)
        assert h.get("odd.gear_refused") and not h.get("even.gear_refused")
        assert h.get("odd.state") == 2
        h.set({"odd.gear": 1})
        h.step(0.001)
        assert not h.get("odd.gear_refused")


def test_errors_are_raised_and_reset_repairs(two, host):
    with host(two) as h:
        h.start()
        with pytest.raises(Exception):
            h.set({"odd.tau": float("nan")})
        with pytest.raises(Exception):
            h.step(0.001)
        h.fmu.reset()
        h.time = 0.0
        h.start()
        h.step(0.001)


def test_input_derivatives_are_accepted(two, host):
    """A ramp of torque in one large step and in many small ones: the same but for the
    losses, which are read at the middle of each step."""
    def final(steps):
        with host(two) as h:
            h.start({"odd.gear": 3, "output.w_start": 50.0, "odd.tau": 10.0})
            v = two.variables["odd.tau"].valueReference
            h.fmu.setRealInputDerivatives([v], [1], [40.0])
            h.step(0.5 / steps, steps)
            assert h.get("odd.tau") == pytest.approx(30.0)
            return h.get("output.w")
    assert final(1) == pytest.approx(final(500), rel=1e-3)


def test_instances_run_in_parallel_threads(two, host):
    results = {}

    def work(k):
        with host(two) as h:
            h.start({"odd.gear": 3, "output.w_start": 40.0, "odd.tau": 10.0 * (k % 2)})
            h.step(0.001, 2000)
            results[k] = h.get("output.w")

    threads = [threading.Thread(target=work, args=(k,)) for k in range(6)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(results) == 6
    assert results[0] == results[2] == results[4] < results[1] == results[3] == results[5]
