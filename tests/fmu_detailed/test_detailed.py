# SPDX-License-Identifier: BSD-2-Clause
"""The detailed gearset as an FMU: its archive, interface and calls."""

import math
import re
import shutil
import subprocess

import fmpy
import numpy as np
import pytest
from conftest import EXAMPLES, ROOT, Host, gearmap, succeeds, unpack
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

DCT = ROOT / "examples/dct7.yaml"
START = {"odd.gear": 1, "output.w_start": 20.0, "odd.tau": 30.0, "output.tau": -300.0}


@pytest.mark.parametrize("name", EXAMPLES)
def test_validates(bake, name):
    assert validate_fmu(bake(name).file) == []


@pytest.mark.parametrize("name", ["at3_simpson", "dct7", "ev1"])
def test_has_the_interface_of_the_reduced_one(bake, reduced, name):
    mine, theirs = bake(name).variables, reduced(name).variables
    for v in theirs.values():
        own = mine[v.name]
        for attribute in ("valueReference", "type", "unit", "causality", "variability", "min",
                          "max"):
            assert getattr(own, attribute) == getattr(v, attribute), (v.name, attribute)
        assert (own.declaredType and own.declaredType.name) == (
            v.declaredType and v.declaredType.name)
        if not v.name.endswith(".twist"):  # no state here: a result of all deflections
            assert own.start == v.start and own.initial == v.initial, v.name
    assert [v for v in mine if v in theirs] == list(theirs)  # the common ones come first
    assert list(mine)[:len(theirs)] == list(theirs)


def test_names_and_references_are_unique(bake):
    for name in EXAMPLES:
        variables = bake(name).description.modelVariables
        assert len({v.name for v in variables}) == len(variables)
        assert len({v.valueReference for v in variables}) == len(variables)


def test_library_stands_alone(bake):
    """Only FMI's functions are seen, only the C library is needed."""
    fmu = bake("dct7")
    binary = fmu.folder / "binaries/linux64/dct7.so"
    out = subprocess.run(["nm", "-D", "--defined-only", binary], capture_output=True, text=True,
                         check=True).stdout
    names = [line.split()[-1].split("@")[0] for line in out.splitlines()]
    assert names and all(n.startswith("fmi2") for n in names)
    out = subprocess.run(["readelf", "-d", binary], capture_output=True, text=True,
                         check=True).stdout
    needed = set(re.findall(r"NEEDED.*\[(.*?)\]", out))
    assert needed <= {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}, needed


def test_same_bytes_twice(bake, tmp_path):
    again = tmp_path / "again.fmu"
    succeeds("bake", "--detailed", DCT, "-o", again)
    with open(bake("dct7").file, "rb") as first:
        assert first.read() == again.read_bytes()


def test_refuses_what_is_no_description(tmp_path):
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("format: 1\n")
    done = gearmap("bake", "--detailed", wrong, "-o", tmp_path / "x.fmu")
    assert done.returncode == 1 and len(done.stderr.splitlines()) == 1
    assert "wrong.yaml" in done.stderr and list(tmp_path.iterdir()) == [wrong]
    done = gearmap("bake", "--detailed", DCT, "-o", tmp_path / "none/x.fmu")
    assert done.returncode == 1 and "none" in done.stderr


def test_description_of_another_gearset_is_refused(bake, tmp_path):
    fmu = bake("dct7")
    other = tmp_path / "other"
    shutil.copytree(fmu.folder, other)
    text = (other / "resources/gearset.yaml").read_text()
    (other / "resources/gearset.yaml").write_text(text + "\n# touched\n")
    changed = unpack_folder(fmu, other)
    with pytest.raises(Exception):
        Host(changed).open()
    (other / "resources/gearset.yaml").unlink()
    with pytest.raises(Exception):
        Host(changed).open()


def unpack_folder(fmu, folder):
    changed = type(fmu)(**vars(fmu))
    changed.folder = folder
    return changed


def test_folder_with_odd_characters(bake, host, tmp_path):
    folder = tmp_path / "a b%20c ü"
    shutil.copytree(bake("ev1").folder, folder)
    with host(unpack_folder(bake("ev1"), folder)) as h:
        h.start({"output.w_start": 3.0})
        assert h.get("output.w") == 3.0


# ---- values ----

def test_start(bake, host):
    """The output wins; what is engaged turns with it, elastic parts are unloaded."""
    fmu = bake("dct7")
    with host(fmu) as h:
        h.start({**START, "odd.w_start": 1.0, "even.w_start": 5.0})
        assert h.get("odd.w") == pytest.approx(20.0 * fmu.gears["odd"][1], rel=1e-12)
        assert (h.get("even.w"), h.get("output.w")) == (5.0, 20.0)
        assert (h.get("odd.state"), h.get("even.state")) == (2, 0)
        assert h.get("odd.twist") == h.get("elastic_energy") == 0.0
        assert h.get("odd.twist_rate") == pytest.approx(0.0, abs=1e-12)
        assert h.get("power") == pytest.approx(
            30.0 * h.get("odd.w") - 300.0 * 20.0, rel=1e-12)


def test_bad_numbers_are_errors(bake, host):
    for values in ({"odd.tau": math.nan}, {"odd.tau": math.inf}, {"loss_scale": -1.0},
                   {"odd.w": 1.0}, {"fidelity": 3}):
        with host(bake("dct7")) as h:
            with pytest.raises(FMICallException):
                h.start(values)
            assert [status for status, _ in h.said] == [3]  # one message, an error
    for call in ("states", "time"):
        with host(bake("dct7")) as h:
            h.start(START)
            x = h.states()
            x[0] = math.nan
            with pytest.raises(FMICallException):
                h.set_states(x) if call == "states" else h.fmu.setTime(math.nan)
            assert h.fmu.getReal([8]) == [-300.0]  # values may still be read
            with pytest.raises(FMICallException):
                h.set_states(np.nan_to_num(x))  # but it does not go on
            h.fmu.reset()
            h.start(START)


def test_huge_numbers_are_discarded(bake, host):
    with host(bake("dct7")) as h:
        h.start(START)
        x = h.states()
        h.set_states(np.full(h.n, 1e300))
        with pytest.raises(FMICallException):
            h.rates()
        assert h.said[-1][0] == 2
        h.set_states(x)
        assert np.isfinite(h.rates()).all()


def test_unknown_gear_keeps_the_one_that_was(bake, host):
    with host(bake("dct7")) as h:
        h.start(START)
        h.event({"odd.gear": 4})
        assert h.get("odd.gear_refused") == 1 and h.get("odd.state") == 2
        assert [s for s, _ in h.said] == [1] and "odd.gear = 4" in h.said[0][1]
        h.event({"odd.tau": 1.0})
        assert len(h.said) == 1  # told once
        h.event({"odd.gear": 3})
        assert h.get("odd.gear_refused") == 0


def test_loss_scale(bake, host):
    """Friction doubles; what dampers lose does not count among the torques."""
    losses = []
    for scale in (1.0, 2.0):
        with host(bake("dct7")) as h:
            h.start({**START, "loss_scale": scale, "even.w_start": 40.0})
            losses.append([h.get(n) for n in ("even.loss_torque", "output.loss_torque",
                                              "loss_power")])
    assert np.array(losses[1]) == pytest.approx(2.0 * np.array(losses[0]), rel=1e-12)


def test_oil_temperature_takes_effect_at_events(bake, host):
    with host(bake("dct7")) as cold:
        cold.start({**START, "oil_temperature": 300.0})
        there = cold.get("loss_power")
    with host(bake("dct7")) as h:
        h.start(START)
        here = h.get("loss_power")
        h.set({"oil_temperature": 300.0})
        assert h.get("loss_power") == here
        assert h.fmu.completedIntegratorStep()[0]  # asks for an event
        assert not h.event()  # no state jumps
        assert h.get("loss_power") == there > 1.2 * here
        assert not h.fmu.completedIntegratorStep()[0]


def test_energies(bake, host):
    """Rates of the stored energies and the losses balance the power, by differences."""
    fmu, h_t = bake("dct7"), 1e-9
    with host(fmu) as h:
        h.start({**START, "even.w_start": 50.0})
        h.euler(1e-8, 3000)
        x, rates = h.states(), h.rates()
        def stored(at):
            h.set_states(at)
            return h.get("kinetic_energy") + h.get("elastic_energy")
        rate = (stored(x + h_t * rates) - stored(x - h_t * rates)) / (2 * h_t)
        h.set_states(x)
        assert h.get("power") == pytest.approx(rate + h.get("loss_power"), rel=1e-4)
        assert abs(h.get("odd.twist")) > 1e-6


@pytest.mark.parametrize("name, path", [("dct7", "odd"), ("at4_ravigneaux", "input")])
def test_twist_is_the_integral_of_its_rate(bake, host, name, path):
    with host(bake(name)) as h:
        h.start({f"{path}.gear": 1, "output.w_start": 5.0, f"{path}.tau": 50.0})
        h.euler(1e-8, 2000)
        x, rates, dt = h.states(), h.rates(), 1e-7
        values = []
        for sign in (-1, 1):
            h.set_states(x + sign * dt * rates)
            values.append(h.get(f"{path}.twist"))
        h.set_states(x)
        assert (values[1] - values[0]) / (2 * dt) == pytest.approx(
            h.get(f"{path}.twist_rate"), rel=1e-6)


# ---- derivatives ----

@pytest.mark.parametrize("name", EXAMPLES)
def test_directional_derivatives(bake, host, name):
    """Of rates by states and torques: exact, so differences converge to them; nothing
    outside the declared dependencies changes."""
    fmu = bake(name)
    path = next(iter(fmu.gears))
    structure = fmu.description.derivatives
    rates = [u.variable.valueReference for u in structure]
    states = [u.variable.derivative.valueReference for u in structure]
    torques = [v.valueReference for n, v in fmu.variables.items() if n.endswith(".tau")]
    with host(fmu) as h:
        gear = max(fmu.gears[path])
        h.start({f"{path}.gear": gear, "output.w_start": 30.0, f"{path}.tau": 60.0,
                 "output.tau": -50.0,  # and nothing near rest, where friction bends
                 **{f"{p}.w_start": 77.0 for p in fmu.gears}})
        h.euler(2e-8, 2000)
        x, nominal = h.states(), h.nominals()
        for j, known in enumerate([*states, *torques]):
            exact = np.array(h.fmu.getDirectionalDerivative(rates, [known], [1.0]))
            around = []
            for sign in (-1, 1):
                if j < len(x):
                    moved = x.copy()
                    moved[j] += sign * 1e-5 * nominal[j]
                    h.set_states(moved)
                    step = 1e-5 * nominal[j]
                else:
                    value = h.fmu.getReal([known])[0]
                    h.fmu.setReal([known], [value + sign * 1e-3])
                    step = 1e-3
                around.append(h.rates())
                h.set_states(x)
                if j >= len(x):
                    h.fmu.setReal([known], [value])
            differences = (around[1] - around[0]) / (2 * step)
            scale = np.abs(around[0]) + np.abs(around[1]) + 1.0
            # friction bends and rounding: a millionth of the rates themselves per step
            assert np.all(np.abs(exact - differences) * step <=
                          1e-3 * np.abs(exact) * step + 1e-9 * scale), (known, j)
            for i, unknown in enumerate(structure):
                depends = {d.valueReference for d in unknown.dependencies}
                if known not in depends:
                    assert exact[i] == 0.0 == differences[i], (unknown.variable.name, known)


def test_derivatives_of_other_outputs(bake, host):
    """By differences inside: losses and forces along a state and a torque, and at the start
    along a start value."""
    fmu = bake("dct7")
    vr = {n: v.valueReference for n, v in fmu.variables.items()}
    with host(fmu) as h:
        h.start(START)
        h.euler(1e-8, 2000)
        before = h.states(), h.get("loss_power"), h.get("odd.tau")
        d = h.fmu.getDirectionalDerivative(
            [vr["kinetic_energy"], vr["loss_power"], vr["odd.w"]], [vr["odd.w"]], [1.0])
        inertia = h.get("odd.inertia")
        assert d[0] == pytest.approx(inertia * h.get("odd.w"), rel=1e-6)
        assert d[1] > 0.0 and d[2] == 1.0
        assert np.array_equal(before[0], h.states())
        assert before[1:] == (h.get("loss_power"), h.get("odd.tau"))
    with host(fmu) as h:
        h.fmu.setupExperiment(startTime=0.0)
        h.fmu.enterInitializationMode()
        h.set(START)
        d = h.fmu.getDirectionalDerivative(
            [vr["odd.w"], vr["power"]], [vr["output.w_start"]], [1.0])
        assert d[0] == pytest.approx(fmu.gears["odd"][1], rel=1e-6)
        assert d[1] == pytest.approx(30.0 * fmu.gears["odd"][1] - 300.0, rel=1e-6)
        assert h.get("output.w") == 20.0


# ---- saved states ----

def test_saved_state_resumes_to_the_bit(bake, host):
    """Also as bytes, in another instance, with another oil, in the middle of a shift."""
    fmu = bake("dct7")
    with host(fmu) as h, host(fmu) as other:
        h.start({**START, "oil_temperature": 320.0})
        h.event({"even.gear": 2})
        assert h.get("even.state") == 1
        h.euler(1e-8, 100)
        state = h.fmu.getFMUstate()
        kept = h.fmu.serializeFMUstate(state)
        h.euler(1e-8, 100)
        after = h.states(), h.rates(), h.get("even.loss_torque"), h.indicators()
        h.fmu.setFMUstate(state)
        other.fmu.setupExperiment(startTime=0.0)
        copy = other.fmu.deSerializeFMUstate(kept)
        other.fmu.setFMUstate(copy)
        for instance in (h, other):
            assert instance.get("even.state") == 1
            instance.euler(1e-8, 100)
            again = (instance.states(), instance.rates(), instance.get("even.loss_torque"),
                     instance.indicators())
            for a, b in zip(after, again):
                assert np.array_equal(a, b)
        h.fmu.freeFMUstate(state)
        other.fmu.freeFMUstate(copy)


def test_foreign_states_are_refused(bake, host):
    with host(bake("dct7")) as h:
        h.start(START)
        state = h.fmu.getFMUstate()
        kept = bytearray(h.fmu.serializeFMUstate(state))
        h.fmu.freeFMUstate(state)
        for place in (0, len(kept) // 2, len(kept) - 1):
            damaged = kept.copy()
            damaged[place] ^= 1
            with host(bake("dct7")) as g:
                g.start(START)
                with pytest.raises(FMICallException):
                    g.fmu.deSerializeFMUstate(bytes(damaged))
    with host(bake("mt5")) as h:
        h.start()
        with pytest.raises(FMICallException):
            h.fmu.deSerializeFMUstate(bytes(kept))
