# SPDX-License-Identifier: BSD-2-Clause
"""FMUs where motion comes in and torque goes out, beside the one with torques in: the same
gearset, by fmpy."""

import fmpy
import numpy as np
import pytest
from conftest import Baked, bake
from fmpy.validation import validate_fmu

FLANGES = ("odd", "even", "output")
GIVEN = {"output_in": ("output",), "odd_in": ("odd", "output")}


@pytest.fixture(params=list(GIVEN))
def baked(request):
    return request.getfixturevalue(request.param)


@pytest.fixture
def given(baked):
    return [f for f in FLANGES if baked.variables[f"{f}.w"].causality == "input"]


def test_which_flanges_are_given(output_in, odd_in):
    for baked, names in ((output_in, GIVEN["output_in"]), (odd_in, GIVEN["odd_in"])):
        for f in FLANGES:
            swapped = f in names
            assert (f"{f}.w_start" in baked.variables) != swapped
            for x in ("phi", "w", "a"):
                v = baked.variables[f"{f}.{x}"]
                assert v.causality == ("input" if swapped else "output")
                assert (v.start is not None) == (swapped or x == "phi")
            tau = baked.variables[f"{f}.tau"]
            assert tau.causality == ("output" if swapped else "input")
            assert (tau.initial == "calculated") == swapped


def test_validates_without_problems(baked):
    assert validate_fmu(str(baked.file)) == []


def test_states_and_initial_unknowns_are_complete(baked, given):
    d = baked.description
    states = {u.variable.derivative.name for u in d.derivatives}
    assert states == {f"{f}.{x}" for f in FLANGES if f not in given for x in ("phi", "w")} | {
        "odd.twist", "even.twist", "work", "loss_energy"}
    assert d.numberOfContinuousStates == len(states)
    assert [u.variable.name for u in d.initialUnknowns] == [
        v.name for v in d.modelVariables
        if v.causality == "output" and v.initial == "calculated"]


def test_the_page_says_where_motion_comes_in(two, baked, given):
    page = (baked.folder / "documentation" / "index.html").read_text()
    sentence = "torque is an output at: " + ", ".join(f"<code>{f}</code>" for f in given)
    assert sentence in page
    assert sentence not in (two.folder / "documentation" / "index.html").read_text()


def test_the_component_is_another_one(two, output_in, odd_in):
    assert len({b.description.guid for b in (two, output_in, odd_in)}) == 3


# ---- dependencies and derivatives ----

POINTS = [  # gears; speeds of odd, even, output; torques; twists
    {"odd.gear": 3, "output.w": 21.0, "odd.w": 126.2, "even.w_start": 30.0, "odd.tau": 93.0,
     "even.tau": 1.0, "output.a": 3.0, "odd.a": 20.0, "odd.twist": 3.1e-3},
    {"odd.gear": 0, "even.gear": -1, "output.w": -8.0, "odd.w": 70.0, "odd.w_start": 70.0,
     "even.tau": -30.0, "odd.tau": 2.0, "output.a": -9.0, "even.twist": -3.3e-3},
    {"odd.gear": 1, "even.gear": 2, "output.w": 15.0, "odd.w": 224.0, "odd.tau": 51.0,
     "even.tau": 63.0, "output.a": 1.0, "odd.a": -30.0, "odd.twist": 3.1e-3,
     "even.twist": 3.0e-3},
    {"odd.gear": 0, "even.gear": 0, "output.w": 12.0, "odd.w": 80.0, "odd.w_start": 80.0,
     "even.w_start": 55.0, "odd.tau": 3.0, "even.tau": 2.0, "loss_scale": 0.5},
]


def usable(baked, point):
    return {k: v for k, v in point.items()
            if k in baked.variables and baked.variables[k].causality != "output"
            or k.endswith("twist")}


def references(baked, names):
    return [baked.variables[n].valueReference for n in names]


def continuous(unknowns):
    return [u.variable.name for u in unknowns if u.variable.variability == "continuous"]


def jacobian(h, baked, unknowns, knowns):
    return np.array([h.fmu.getDirectionalDerivative(
        references(baked, unknowns), references(baked, [k]), [1.0]) for k in knowns]).T


def inputs(baked):
    return [v.name for v in baked.description.modelVariables
            if v.causality == "input" and v.type == "Real"]


def difference(h, baked, names, name, size):
    value, found = h.get(name), []
    for x in (value - size, value + size):
        h.set({name: x})
        found.append(np.array(h.fmu.getReal(references(baked, names))))
    h.set({name: value})
    return (found[1] - found[0]) / (2 * size)


def assert_same(found, expected, scale):
    # central differences over 1e-5: rounding of a value 1e-16/1e-5
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-8 + 1e-10 * scale)


@pytest.mark.parametrize("exchange", [False, True])
@pytest.mark.parametrize("point", POINTS)
def test_derivatives_to_inputs(baked, host, point, exchange):
    names, knowns = continuous(baked.description.outputs), inputs(baked)
    with host(baked, exchange=exchange) as h:
        h.start(usable(baked, point))
        scale = np.abs(np.array(h.fmu.getReal(references(baked, names)))).max()
        jac = jacobian(h, baked, names, knowns)
        for i, name in enumerate(knowns):
            assert_same(jac[:, i], difference(h, baked, names, name, 1e-5), scale)


@pytest.mark.parametrize("point", POINTS)
def test_derivatives_to_states(baked, host, point):
    names = continuous(baked.description.outputs)
    states = [u.variable.derivative.name for u in baked.description.derivatives]
    with host(baked, exchange=True) as h:
        h.start(usable(baked, point))
        x = h.states()
        jac = jacobian(h, baked, names, states)
        scale = np.abs(np.array(h.fmu.getReal(references(baked, names)))).max()
        for i, name in enumerate(states):
            size, found = (1e-6 if name.endswith("twist") else 1e-5), []
            for s in (-size, size):
                h.set_states(x + s * (np.arange(len(x)) == i))
                found.append(np.array(h.fmu.getReal(references(baked, names))))
            assert_same(jac[:, i], (found[1] - found[0]) / (2 * size), scale)


@pytest.mark.parametrize("point", POINTS)
def test_derivatives_to_start_values(baked, host, point):
    names = continuous(baked.description.initialUnknowns)
    knowns = inputs(baked) + [n for n in baked.variables if n.endswith("w_start")]
    with host(baked) as h:
        h.initialise(usable(baked, point))
        scale = np.abs(np.array(h.fmu.getReal(references(baked, names)))).max()
        jac = jacobian(h, baked, names, knowns)
        for i, name in enumerate(knowns):
            assert_same(jac[:, i], difference(h, baked, names, name, 1e-5), scale)


CHANGES = {"twist": [1e-3, 1.0], "fidelity": [1], "tau": [7.0, 1e4], "a": [5.0, 1e6],
           "w": [4.0, -40.0, 300.0], "phi": [1.0], "gear": [0, 1, 2, 3, -1, 9],
           "w_start": [5.0, -20.0, 300.0], "loss_scale": [1.5], "oil_temperature": [20.0],
           "sync_torque": [3.0]}


def changes_of(baked, point, initially):
    for name, v in baked.variables.items():
        if v.causality == "output" and not (initially and v.initial == "exact") or (
                not initially and v.causality != "input"):
            continue
        for step in CHANGES.get(name.split(".")[-1], []):
            old = point.get(name, float(v.start))
            new = step if name.endswith(("gear", "fidelity")) else old + step
            low = 2 if name == "fidelity" and v.min else 0
            if new != old and (name != "fidelity" or new >= low):
                yield name, {**point, name: new}


def observed(baked, host, unknowns, initially):
    """Pairs (output, known) where a change of the known changed the output."""
    seen, names = set(), [u.variable.name for u in unknowns]
    for point in [usable(baked, p) for p in POINTS] + [
            {**usable(baked, p), "fidelity": 1} for p in POINTS
            if baked.variables["odd.w"].causality == "output"]:
        def values(changed):
            with host(baked) as h:
                h.initialise(changed if initially else point)
                if not initially:
                    h.fmu.exitInitializationMode()
                    h.set({k: x for k, x in changed.items()
                           if baked.variables[k].causality == "input"})
                return {n: h.get(n) for n in names}
        before = values(point)
        for name, changed in changes_of(baked, point, initially):
            after = values(changed)
            seen |= {(n, name) for n in names
                     if abs(after[n] - before[n]) > 1e-13 * max(abs(after[n]), abs(before[n]))}
    return seen


@pytest.mark.parametrize("initially", [False, True])
def test_nothing_depends_but_what_is_declared(baked, host, initially):
    d = baked.description
    unknowns = d.initialUnknowns if initially else d.outputs
    declared = {(u.variable.name, k.name) for u in unknowns for k in u.dependencies}
    seen = observed(baked, host, unknowns, initially)
    assert seen - declared == set()
    if not initially and baked.variables["odd.w"].causality == "output":
        # and from inputs nothing is declared that has no effect; where a path is given, all
        # gears of this example are elastic: torques then reach less than they may
        known = set(inputs(baked))
        assert {(a, b) for a, b in declared if b in known} - seen == set()


# ---- motion that torques have made ----

STOP, H = 6.0, 2e-4  # the springs' vibrations are followed
COMMANDS = {"odd.gear": lambda t: 1 if t < 3.5 else 3, "even.gear": lambda t: 0 if t < 1 else 2}


def torques(t, w):
    """Drive-away in first, hand-over to second and to third while the output is braked."""
    share = min(max((t - 3.0) / 0.4, 0.0), 1.0) - min(max((t - 4.5) / 0.4, 0.0), 1.0)
    return {"odd.tau": 50.0 * (1.0 - share), "even.tau": 50.0 * share,
            "output.tau": -8.0 * w - 60.0 * min(t, 1.0)}


def record(two, host):
    """Values at every communication point, and what acted over each step."""
    names = [f"{f}.{x}" for f in FLANGES for x in ("phi", "w", "a")] + [
        "work", "loss_energy", "odd.twist", "even.twist", "odd.state", "even.state"]
    rows = []
    with host(two) as h:
        h.start({k: f(0.0) for k, f in COMMANDS.items()})
        for i in range(round(STOP / H)):
            t = i * H
            acting = torques(t, h.get("output.w"))
            h.set({**acting, **{k: f(t) for k, f in COMMANDS.items()}})
            rows.append({**{n: h.get(n) for n in names}, **acting})
            h.step(H)
        rows.append({**{n: h.get(n) for n in names}, **acting})
    return {k: np.array([r[k] for r in rows]) for k in rows[0]}


@pytest.fixture(scope="module")
def driven(two, host):
    r = record(two, host)
    assert {0, 1, 2} <= set(r["odd.state"]) | set(r["even.state"])
    return r


def stored(h):
    return h.get("kinetic_energy") + h.get("elastic_energy")


def mean_acceleration(r, flange):
    return np.diff(r[f"{flange}.w"]) / H


def test_a_recorded_drive_gives_its_torques_back(baked, given, host, driven):
    """Every step with the mean acceleration of the recorded one. An event inside a step
    (a shaft starts, a cone closes) is a kink that a mean does not have: around it the
    vibration differs, and with it the torque. So torques are compared by their mean over
    0.1 s, that is by the work they do, and energies as they are."""
    work, tau = [], {f: [] for f in given}
    with host(baked) as h:
        h.start(usable(baked, {k: f(0.0) for k, f in COMMANDS.items()}))
        for i in range(len(driven["work"]) - 1):
            t = i * H
            h.set(usable(baked, {**{k: f(t) for k, f in COMMANDS.items()},
                                 **{f"{f}.tau": driven[f"{f}.tau"][i] for f in FLANGES},
                                 **{f"{f}.w": driven[f"{f}.w"][i] for f in given},
                                 **{f"{f}.a": mean_acceleration(driven, f)[i] for f in given}}))
            work.append(h.get("work"))
            for f in given:
                tau[f].append(h.get(f"{f}.tau"))
            h.step(H)
        end = {n: h.get(n) for n in ("work", "loss_energy")}
        assert end["work"] == pytest.approx(end["loss_energy"] + stored(h), rel=1e-9)
    assert end["work"] == pytest.approx(driven["work"][-1], rel=2e-3)
    assert end["loss_energy"] == pytest.approx(driven["loss_energy"][-1], rel=5e-3)
    for f in given:
        size = np.abs(driven[f"{f}.tau"]).max()
        means = [np.array(x[:29500]).reshape(-1, 500).mean(axis=1)
                 for x in (tau[f], driven[f"{f}.tau"])]
        assert np.abs(means[0] - means[1])[2:].max() < 0.05 * size, f


def test_exchange_and_co_simulation_are_the_same(output_in, host):
    """A smooth motion of the output, through rest and back, in gear: once by steps, once by
    explicit steps of 1e-5 s outside, which is what the springs want; events as they come."""
    def motion(t):
        return {"output.w": 6.0 * np.cos(4 * t), "output.a": -24.0 * np.sin(4 * t)}

    stop, h_outside = 0.8, 1e-5
    start = {"odd.gear": 3, "odd.tau": 30.0, "even.w_start": 5.0, **motion(0.0)}
    with host(output_in) as h:
        h.start(start)
        for i in range(round(stop / 1e-4)):
            t = i * 1e-4
            h.set({"output.w": motion(t)["output.w"],
                   "output.a": (motion(t + 1e-4)["output.w"] - motion(t)["output.w"]) / 1e-4})
            h.step(1e-4)
        slave = {n: h.get(n) for n in ("odd.w", "odd.twist", "even.w", "work", "loss_energy")}
    events = 0
    with host(output_in, exchange=True) as h:
        h.start(start)
        before, x, z = stored(h), h.states(), h.indicators()
        for i in range(round(stop / h_outside)):
            t = (i + 1) * h_outside
            half = x + h_outside / 2 * h.rates()  # midpoint
            h.set(motion(t - h_outside / 2))
            h.set_states(half)
            x = x + h_outside * h.rates()
            h.fmu.setTime(t)
            h.set(motion(t))
            h.set_states(x)
            now = h.indicators()
            if np.any((now > 0) != (z > 0)):
                events += 1
                h.event()
                x, now = h.states(), h.indicators()
            z = now
        assert events >= 2
        for name, value in slave.items():
            # steps of first order beside the events' kinks
            size = {"odd.w": 36.0, "even.w": 5.0, "odd.twist": 3e-3}.get(name, abs(value))
            assert h.get(name) == pytest.approx(value, abs=5e-3 * size), name
        # what the flanges did: of second order in the step but for the events' kinks
        change = stored(h) - before
        assert h.get("work") == pytest.approx(
            change + h.get("loss_energy"), abs=1e-3 * h.get("loss_energy"))


def test_two_gearsets_on_one_shaft(two, output_in, host):
    """The output of one turns the output of the other, which gives its torque: in each step
    the torque that the second took (its inertia included) acts on the first. Together they
    are one gearset with both inertias, driven by one torque."""
    h_step, steps = 1e-4, 20000
    with host(two) as first, host(output_in) as second:
        first.start({"odd.gear": 3, "odd.tau": 40.0})
        second.start({"even.gear": 2})
        for _ in range(steps):
            second.set({"output.w": first.get("output.w"), "output.a": first.get("output.a")})
            inertia = second.get("output.inertia")
            # the second's torque without its inertia, which is solved with the first's
            rest = second.get("output.tau") - inertia * first.get("output.a")
            own = first.get("output.inertia")
            first.set({"output.tau": 0.0})
            free = first.get("output.a")
            a = (own * free - rest) / (own + inertia)
            first.set({"output.tau": -(rest + inertia * a)})
            before = first.get("output.w")
            first.step(h_step)
            second.set({"output.a": (first.get("output.w") - before) / h_step})
            second.step(h_step)
        w = first.get("output.w")
        assert second.get("output.w") == pytest.approx(w, rel=1e-9)
        assert w > 1.0
        assert second.get("even.w") == pytest.approx((9 + 1 / 3) * w, rel=1e-3)
        # what leaves the first arrives in the second, but for the delay of a step
        given_away = 40.0 * first.get("odd.phi") - first.get("work")
        assert second.get("work") == pytest.approx(given_away, rel=2e-3)
        for h in (first, second):
            assert h.get("work") == pytest.approx(h.get("loss_energy") + stored(h), rel=1e-9)


def test_fmpy_drives_the_output(output_in):
    """By fmpy's own master, in both kinds: a speed that comes from a table."""
    t = np.linspace(0.0, 2.0, 401)
    signal = np.zeros(len(t), dtype=[("time", float), ("output.w", float),
                                     ("output.a", float), ("odd.tau", float)])
    signal["time"], signal["odd.tau"] = t, 20.0
    signal["output.w"], signal["output.a"] = 10.0 + 4.0 * np.sin(t), 4.0 * np.cos(t)
    r = {kind: fmpy.simulate_fmu(
        str(output_in.file), fmi_type=kind, stop_time=2.0, output_interval=0.005,
        start_values={"odd.gear": 3, "even.w_start": 10.0}, input=signal,
        output=["output.w", "output.tau", "odd.w", "work", "loss_energy", "kinetic_energy",
                "elastic_energy"]) for kind in ("CoSimulation", "ModelExchange")}
    for x in r.values():
        assert x["output.w"][-1] == pytest.approx(10.0 + 4.0 * np.sin(2.0), abs=0.03)
        assert x["odd.w"][-1] == pytest.approx(6.0 * x["output.w"][-1], rel=1e-2)
    late = [x["output.tau"][200:] for x in r.values()]
    assert late[0].mean() == pytest.approx(late[1].mean(), rel=0.02)


@pytest.mark.parametrize("names, said", [
    ("front", "front"), ("output,output", "twice"), ("odd,,output", "no flange"), (",", "no flange")])
def test_flanges_that_are_not_there_are_refused(tmp_path, names, said):
    with pytest.raises(AssertionError, match=said):
        bake(tmp_path, 2, names)


def test_a_torque_that_goes_out_cannot_be_set(baked, given, host):
    for name in [f"{f}.tau" for f in given]:
        with host(baked) as h, pytest.raises(Exception):
            h.start({name: 1.0})


@pytest.mark.parametrize("names", ["even", "odd,even", "even,output,odd"])
def test_other_flanges_validate_and_run(tmp_path, names):
    baked = Baked(bake(tmp_path, 2, names), tmp_path / "unpacked")
    given = [f for f in FLANGES if baked.variables[f"{f}.w"].causality == "input"]
    assert sorted(given) == sorted(names.split(","))
    assert validate_fmu(str(baked.file)) == []
    for kind in ("CoSimulation", "ModelExchange"):
        r = fmpy.simulate_fmu(str(baked.file), fmi_type=kind, stop_time=0.1,
                              output_interval=1e-3, output=["loss_energy"], start_values={
                                  "odd.gear": 1, **{f"{f}.w": 15.0 for f in given[:1]}})
        assert len(r) > 90 and np.isfinite(r["loss_energy"]).all()
