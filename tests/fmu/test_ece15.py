# SPDX-License-Identifier: BSD-2-Clause
"""Model Exchange against Co-Simulation with the torques and gears of an ECE-15 run."""

import ece15
import fmpy
import numpy as np
import pytest

RATIOS = {1: 15.0, 2: 9.0, 3: 6.0}  # of the example map
SAMPLE = 0.02  # s
COLUMNS = ["odd.tau", "even.tau", "output.tau", "odd.gear", "even.gear"]
OUTPUTS = ["output.w", "odd.w", "even.w", "loss_energy", "odd.state", "even.state"]


@pytest.fixture(scope="module")
def rows(two, host):
    with host(two) as h:
        return ece15.record(h, RATIOS)


def signals(rows):
    """Steps: every torque is held, the next one sets in at once."""
    types = [("time", "f8")] + [(c, "f8" if c.endswith("tau") else "i4") for c in COLUMNS]
    table = []
    for i, (t, inputs) in enumerate(rows):
        end = rows[i + 1][0] if i + 1 < len(rows) else ece15.DURATION
        table += [(t, *(inputs[c] for c in COLUMNS)), (end, *(inputs[c] for c in COLUMNS))]
    return np.array(table, dtype=types)


def co_simulation(two, host, rows, fidelity, names=OUTPUTS):
    """Every SAMPLE seconds, at communication steps of 1 ms."""
    table = []
    with host(two) as h:
        h.start({"fidelity": fidelity, "odd.gear": 0})
        for _, inputs in rows:
            h.set(inputs)
            for _ in range(round(ece15.HOLD / SAMPLE)):
                h.step(1e-3, round(SAMPLE / 1e-3))
                table.append((h.time, *(h.get(n) for n in names)))
    return np.array(table, dtype=[(n, "f8") for n in ("time", *names)])


def model_exchange(two, rows, fidelity, **options):
    end = rows[-1][0] + ece15.HOLD
    return fmpy.simulate_fmu(
        str(two.file), fmi_type="ModelExchange", stop_time=end, input=signals(rows),
        output=OUTPUTS, start_values={"fidelity": fidelity}, **options)


def compare(found, truth, names=("output.w", "odd.w", "even.w")):
    """Largest differences of speeds relative to the top speeds; of the loss at the end."""
    here = {round(t * 1e5): i for i, t in enumerate(found["time"])}  # the last: after events
    at = [round(t * 1e5) for t in truth["time"]]
    both = [t in here for t in at]
    assert sum(both) > 0.9 * len(truth)
    rows = [here[t] for t, b in zip(at, both) if b]
    speeds = [float(np.abs(found[w][rows] - truth[w][both]).max() / np.abs(truth[w]).max())
              for w in names]
    states = [np.mean(found[s][rows] != truth[s][both]) for s in ("odd.state", "even.state")]
    return max(speeds), max(states), found["loss_energy"][-1] / truth["loss_energy"][-1] - 1


@pytest.fixture(scope="module")
def rigid(two, host, rows):
    return co_simulation(two, host, rows, 1)


def test_the_run_is_the_cycle_with_thirty_shifts(rigid):
    assert ece15.shifts() == 30
    top = max(v for _, v in ece15.SPEEDS) / 3.6 / ece15.RADIUS
    follows = [abs(w - ece15.speed(t)[0]) for t, w in zip(rigid["time"], rigid["output.w"])]
    assert max(follows) < 0.05 * top
    assert {0.0, 1.0, 2.0} == set(rigid["odd.state"]) == set(rigid["even.state"])


def test_rigid_by_cvode(two, rows, rigid):
    found = model_exchange(two, rows, 1, solver="CVode", output_interval=SAMPLE)
    speeds, states, energy = compare(found, rigid)
    assert speeds < 1e-3
    assert states < 5e-3  # sampled at events
    assert abs(energy) < 1e-3


def test_rigid_by_euler(two, host, rows):
    """First order: 1 ms is enough over the whole cycle (0.6e-3), but takes too long here;
    at its beginning synchronisers make most of the loss."""
    part = rows[:round(24 / ece15.HOLD)]
    step = 2.5e-4
    found = model_exchange(two, part, 1, solver="Euler", step_size=step, output_interval=step)
    speeds, _, energy = compare(found, co_simulation(two, host, part, 1))
    assert speeds < 1e-3
    assert abs(energy) < 1e-3


def test_lash_by_cvode(two, host, rows):
    """Every new torque and every gear that engages makes the input shaft ring at 225 Hz:
    steps of 1 ms damp that, a solver with error control follows it. The output hardly
    feels it, and the losses do not."""
    part = rows[:round(60 / ece15.HOLD)]
    found = model_exchange(two, part, 2, solver="CVode", output_interval=SAMPLE)
    truth = co_simulation(two, host, part, 2)
    speeds, states, energy = compare(found, truth)
    assert speeds < 1e-2
    assert states < 5e-3
    assert abs(energy) < 1e-3
    assert compare(found, truth, ["output.w"])[0] < 1e-3
