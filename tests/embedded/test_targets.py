# SPDX-License-Identifier: BSD-2-Clause
"""The same trajectory on every target, and in float as in double."""

import numpy as np
import pytest

FIDELITY = {"rigid": 1, "lash": 2}


@pytest.fixture(scope="session")
def replay(bake, records):
    done = {}

    def text(real, tables, target, fidelity):
        key = real, tables, target, fidelity
        if key not in done:
            done[key] = bake(real, tables).execute(target, "replay", records,
                                                   FIDELITY[fidelity])
        return done[key]
    return text


def rows_of(text):
    """Step, speeds of output and paths, angle, work, loss energy."""
    return np.array([[float(x) for x in line.split()] for line in text.splitlines()[:-1]])


@pytest.mark.parametrize("fidelity", FIDELITY)
@pytest.mark.parametrize("real,tables,target", [
    ("float", "float", "m4"), ("float", "float", "aarch64"), ("float", "int16", "m4"),
    ("float", "int16", "aarch64"), ("double", "float", "aarch64")])
def test_targets_compute_the_same_bits(replay, real, tables, target, fidelity):
    assert replay(real, tables, target, fidelity) == replay(real, tables, "host", fidelity)


@pytest.mark.parametrize("fidelity", FIDELITY)
def test_float_follows_double(replay, fidelity):
    """Loss energy of the cycle within 0.01 %, speeds within 1e-4 of the top speeds; an
    angle of some thousand radians no worse than the speed that it is the integral of."""
    single = rows_of(replay("float", "float", "host", fidelity))
    double = rows_of(replay("double", "float", "host", fidelity))
    error = np.abs(single - double).max(axis=0)
    top = np.abs(double).max(axis=0)
    print(fidelity, "speeds", error[1:4] / top[1:4], "angle", error[4], "loss",
          abs(single[-1, 6] / double[-1, 6] - 1))
    assert (error[1:4] < 1e-4 * top[1:4]).all()
    assert abs(single[-1, 6] / double[-1, 6] - 1) < 1e-4
    assert error[4] < error[1] * 195


@pytest.mark.parametrize("fidelity", FIDELITY)
def test_work_is_lost_in_the_end(replay, fidelity):
    """In float too, over 195 000 steps. The run ends at rest, so all work is lost but for
    elastic energy, at most 1 J. 1e-4 of the loss energy: each increment is right to 1e-7,
    and work is the small difference of the powers of two flanges."""
    rows = rows_of(replay("float", "float", "host", fidelity))
    work, loss = rows[-1, 5], rows[-1, 6]
    assert abs(work - loss) < 1e-4 * loss + 1.0


def test_output_is_held_at_rest_to_the_last_bit(bake):
    """On a hill, with the brake torque below what friction holds: no creep in 100 s."""
    folder = bake("float")
    folder.start({}, fidelity=2, gears=(1, 0))
    folder.set({"odd.tau": 0.0, "even.tau": 0.0, "output.tau": -0.3, "odd.gear": 1,
                "even.gear": 0})
    folder.step(1e-3, 1000)
    angle = folder.get("output.phi")
    folder.step(1e-3, 100000)
    assert folder.get("output.w") == 0.0
    assert folder.get("output.phi") == angle
