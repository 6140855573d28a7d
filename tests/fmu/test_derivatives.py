# SPDX-License-Identifier: BSD-2-Clause
"""Directional derivatives of the FMU against differences and against the dependencies
that modelDescription.xml declares."""

import numpy as np
import pytest

POINTS = [  # gears and speeds at the start, torques
    {"odd.gear": 3, "output.w_start": 21.0, "even.w_start": 30.0, "odd.tau": 93.0,
     "even.tau": 1.0, "output.tau": -407.0},
    {"odd.gear": 0, "even.gear": -1, "output.w_start": -8.0, "odd.w_start": 70.0,
     "even.tau": -30.0, "odd.tau": 2.0, "output.tau": 100.0},
    {"odd.gear": 1, "even.gear": 2, "output.w_start": 15.0, "odd.tau": 51.0,
     "even.tau": 63.0, "output.tau": -900.0},
    {"odd.gear": 0, "even.gear": 0, "output.w_start": 12.0, "odd.w_start": 80.0,
     "even.w_start": 55.0, "odd.tau": 3.0, "even.tau": 2.0, "output.tau": -52.0},
    {"odd.gear": 1, "even.gear": 0, "odd.tau": 0.02, "even.w_start": 33.0,  # held
     "odd.twist": 2.506e-3},
    {"odd.gear": 3, "output.w_start": 21.0, "odd.tau": 93.0, "even.w_start": 9.0,
     "loss_scale": 0.0},
]
RIGID = {"fidelity": 1}
LASH = {"fidelity": 2, "odd.twist": 3.1e-3, "even.twist": -3.3e-3}


def references(baked, names):
    return [baked.variables[n].valueReference for n in names]


def jacobian(h, baked, unknowns, knowns):
    columns = [h.fmu.getDirectionalDerivative(
        references(baked, unknowns), references(baked, [k]), [1.0]) for k in knowns]
    return np.array(columns).T


def reals(h, baked, names):
    return np.array(h.fmu.getReal(references(baked, names)))


def continuous_outputs(baked):
    return [u.variable.name for u in baked.description.outputs
            if u.variable.variability == "continuous"]


def states(baked):
    return [u.variable.derivative.name for u in baked.description.derivatives]


INPUTS = ["odd.tau", "even.tau", "output.tau", "oil_temperature"]


def differences(h, baked, names, change, size):
    change(-size)
    low = reals(h, baked, names)
    change(size)
    high = reals(h, baked, names)
    change(0.0)
    return (high - low) / (2 * size)


def assert_same(found, expected, scale):
    # central differences over 1e-5: rounding of a value 1e-16/1e-5
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-8 + 1e-10 * scale)


@pytest.mark.parametrize("fidelity", [RIGID, LASH])
@pytest.mark.parametrize("point", POINTS)
def test_derivatives_to_inputs_and_states(two, host, point, fidelity):
    names, x_names = continuous_outputs(two), states(two)
    with host(two, exchange=True) as h:
        h.start({**fidelity, **point})
        x = h.states()
        scale = np.abs(reals(h, two, names)).max()
        jac = jacobian(h, two, names, INPUTS + x_names)
        for i, name in enumerate(INPUTS):
            value = h.get(name)
            assert_same(jac[:, i], differences(
                h, two, names, lambda s, n=name, v=value: h.set({n: v + s}), 1e-5), scale)
        for i, name in enumerate(x_names):
            size = 1e-6 if name.endswith("twist") else 1e-5
            assert_same(jac[:, len(INPUTS) + i], differences(
                h, two, names, lambda s, i=i: h.set_states(x + s * (np.arange(len(x)) == i)),
                size), scale)


@pytest.mark.parametrize("point", POINTS)
def test_derivatives_to_inputs_in_co_simulation(two, host, point):
    names = continuous_outputs(two)
    with host(two) as h:
        h.start(point)
        h.step(1e-3, 5)
        scale = np.abs(reals(h, two, names)).max()
        jac = jacobian(h, two, names, INPUTS)
        for i, name in enumerate(INPUTS):
            value = h.get(name)
            assert_same(jac[:, i], differences(
                h, two, names, lambda s, n=name, v=value: h.set({n: v + s}), 1e-5), scale)


@pytest.mark.parametrize("exchange", [False, True])
@pytest.mark.parametrize("point", POINTS[:4])
def test_derivatives_to_start_values(two, host, point, exchange):
    names = [u.variable.name for u in two.description.initialUnknowns
             if u.variable.variability == "continuous"]
    knowns = ["odd.tau", "output.w_start", "odd.w_start", "even.w_start", "loss_scale", "odd.phi"]
    with host(two, exchange=exchange) as h:
        h.initialise(point)
        scale = np.abs(reals(h, two, names)).max()
        jac = jacobian(h, two, names, knowns)
        for i, name in enumerate(knowns):
            value = h.get(name)
            assert_same(jac[:, i], differences(
                h, two, names, lambda s, n=name, v=value: h.set({n: v + s}), 1e-5), scale)


def test_nothing_depends_but_what_is_declared(two, host):
    declared = {(u.variable.name, k.name)
                for u in two.description.outputs for k in u.dependencies}
    names, knowns = continuous_outputs(two), [n for n in INPUTS] + states(two)
    for point in POINTS:
        for fidelity in (RIGID, LASH):
            with host(two, exchange=True) as h:
                h.start({**fidelity, **point})
                jac = jacobian(h, two, names, knowns)
                found = {(names[i], knowns[j]) for i, j in zip(*np.nonzero(jac))}
                assert found <= declared


def test_several_knowns_add_up(two, host):
    names, knowns = continuous_outputs(two), INPUTS + states(two)
    with host(two, exchange=True) as h:
        h.start(POINTS[2])
        seed = np.linspace(-1, 2, len(knowns))
        together = h.fmu.getDirectionalDerivative(
            references(two, names), references(two, knowns), list(seed))
        assert together == pytest.approx(jacobian(h, two, names, knowns) @ seed, rel=1e-12)


@pytest.mark.parametrize("unknown, known, rate", [
    ("odd.state", "odd.tau", 1.0), ("odd.a", "odd.gear", 1.0), ("odd.a", "loss_scale", 1.0),
    ("odd.tau", "odd.tau", 1.0), ("odd.a", "odd.tau", float("nan")), ("odd.a", "odd.a", 1.0)])
def test_what_has_no_derivative_is_refused(two, host, unknown, known, rate):
    with host(two) as h:
        h.start()
        with pytest.raises(Exception, match="fmi2GetDirectionalDerivative failed with status 3"):
            h.fmu.getDirectionalDerivative(
                references(two, [unknown]), references(two, [known]), [rate])
