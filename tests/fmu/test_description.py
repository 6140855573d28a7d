# SPDX-License-Identifier: BSD-2-Clause
"""modelDescription.xml: schema, rules of the standard, and that what it says is true."""

import itertools
import re
import zipfile

import numpy as np
import pytest
from conftest import bake
from fmpy.validation import validate_fmu

BASE = {"N.m": {"kg": 1, "m": 2, "s": -2}, "J": {"kg": 1, "m": 2, "s": -2},
        "W": {"kg": 1, "m": 2, "s": -3}, "K": {"K": 1}, "1": {}, "rad": {"rad": 1},
        "rad/s": {"rad": 1, "s": -1}, "rad/s2": {"rad": 1, "s": -2}, "s": {"s": 1},
        "kg.m2": {"kg": 1, "m": 2}}


@pytest.fixture(params=["one", "two"])
def baked(request):
    return request.getfixturevalue(request.param)


def test_validates_without_problems(baked):
    assert validate_fmu(str(baked.file)) == []


def test_every_real_has_a_unit_with_its_base_units(baked):
    units = {u.name: u for u in baked.description.unitDefinitions}
    for v in baked.description.modelVariables:
        if v.type != "Real":
            continue
        base = units[v.unit].baseUnit
        exponents = {k: getattr(base, k) for k in ("kg", "m", "s", "A", "K", "mol", "cd", "rad")}
        assert {k: n for k, n in exponents.items() if n} == BASE[v.unit]
        assert v.declaredType.unit == v.unit
        assert v.nominal is not None


def test_people_see_rpm_and_degrees(baked):
    types = {t.name: t for t in baked.description.typeDefinitions}
    assert types["AngularVelocity"].displayUnit == "rpm"
    assert types["Temperature"].displayUnit == "degC"
    units = {u.name: u for u in baked.description.unitDefinitions}
    rpm, = units["rad/s"].displayUnits
    assert float(rpm.factor) == pytest.approx(60 / 6.283185307179586, rel=1e-15)
    celsius, = units["K"].displayUnits
    assert 353.15 * float(celsius.factor) + float(celsius.offset) == pytest.approx(80)


def test_quantity_tells_torque_from_energy(baked):
    types = {t.name: t for t in baked.description.typeDefinitions}
    assert types["Torque"].quantity == "Torque"
    assert types["Energy"].quantity == "Energy"


def test_gears_have_the_range_of_their_path(two, one):
    assert (two.variables["odd.gear"].declaredType.name,
            two.variables["even.gear"].declaredType.name) == ("OddGear", "EvenGear")
    text = (two.folder / "modelDescription.xml").read_text()
    assert re.search(r'name="OddGear".*?<Integer [^>]*min="0" max="3"', text, re.S)
    assert re.search(r'name="EvenGear".*?<Integer [^>]*min="-1" max="2"', text, re.S)
    assert one.variables["input.gear"].declaredType.name == "InputGear"


def test_enumerations(two):
    types = {t.name: t for t in two.description.typeDefinitions}
    assert [(i.name, int(i.value)) for i in types["PathState"].items] == [
        ("neutral", 0), ("synchronising", 1), ("engaged", 2)]
    assert [(i.name, int(i.value)) for i in types["Fidelity"].items] == [
        ("rigid", 1),
        ("lash", 2),
    ]


def test_names_follow_the_number_of_paths(one, two):
    assert {n.split(".")[0] for n in one.variables if "." in n} == {"input", "output"}
    assert {n.split(".")[0] for n in two.variables if "." in n} == {"odd", "even", "output"}
    assert {n.split(".")[-1] for n in one.variables} == {n.split(".")[-1] for n in two.variables}
    assert one.variables["output.w"].valueReference == two.variables["output.w"].valueReference


def test_structure_is_complete_by_rule(baked):
    d = baked.description
    outputs = [v.name for v in d.modelVariables if v.causality == "output"]
    assert [u.variable.name for u in d.outputs] == outputs
    assert [u.variable.name for u in d.initialUnknowns] == [
        v.name for v in d.modelVariables
        if v.causality == "output" and v.initial == "calculated"]
    assert all(u.dependencies is not None
               for u in [*d.outputs, *d.derivatives, *d.initialUnknowns])


def test_states_are_the_same_for_every_gearset_and_mode(baked):
    d = baked.description
    paths = {n.split(".")[0] for n in baked.variables if "." in n}
    states = [u.variable.derivative.name for u in d.derivatives]
    assert set(states) == {*(f"{p}.{x}" for p in paths for x in ("phi", "w")),
                           *(f"{p}.twist" for p in paths if p != "output"),
                           "work", "loss_energy"}
    assert d.numberOfContinuousStates == len(states)
    n_paths = len(paths) - 1
    assert d.numberOfEventIndicators == 2 * n_paths + 2
    for u in d.derivatives:
        assert u.variable.variability == "continuous"


def test_model_exchange_tells_what_it_can(baked):
    d = baked.description.modelExchange
    assert d.modelIdentifier == baked.description.coSimulation.modelIdentifier
    assert not d.needsCompletedIntegratorStep
    assert d.canGetAndSetFMUstate and d.canSerializeFMUstate


def test_titles_with_markup_survive(two):
    assert two.description.description == 'Reduced gearset: An example <gearset> & its "title"'
    assert two.description.modelName == "example-2"
    assert two.description.coSimulation.modelIdentifier == "example_2"


def test_source_files_are_those_in_the_archive(baked):
    files = baked.description.buildConfigurations[0].sourceFileSets[0].sourceFiles
    names = zipfile.ZipFile(baked.file).namelist()
    assert sorted(files) == sorted(n.removeprefix("sources/") for n in names
                                   if n.startswith("sources/") and n.endswith(".c"))
    assert names == sorted(names)
    for needed in ("documentation/index.html", "documentation/licenses/license.txt",
                   "sources/gm_tables.h", "sources/fmi2Functions.h"):
        assert needed in names


def test_date_only_from_the_environment(two, tmp_path):
    assert two.description.generationDateAndTime is None
    file = bake(tmp_path, 2, SOURCE_DATE_EPOCH="1700000000")
    text = zipfile.ZipFile(file).read("modelDescription.xml").decode()
    assert 'generationDateAndTime="2023-11-14T22:13:20Z"' in text


def test_documentation_names_every_variable(baked):
    page = (baked.folder / "documentation" / "index.html").read_text()
    assert all(f"<code>{name}</code>" in page for name in baked.variables)
    assert "An example &lt;gearset&gt; &amp;" in page


def test_start_values_are_those_of_the_binary(baked, host):
    with host(baked) as h:
        h.initialise()
        for v in baked.description.modelVariables:
            if v.start is not None:
                assert h.get(v.name) == pytest.approx(float(v.start), rel=0, abs=0), v.name


# ---- dependencies, by trying ----

POINTS = [  # gears and speed at the start, torques
    {"odd.gear": 3, "output.w_start": 20.0, "even.w_start": 30.0, "odd.tau": 90.0,
     "even.tau": 1.0, "output.tau": -400.0},
    {"odd.gear": 0, "even.gear": -1, "output.w_start": -8.0, "odd.w_start": 70.0,
     "even.tau": -30.0, "odd.tau": 2.0, "output.tau": 100.0},
    {"odd.gear": 1, "even.gear": 2, "output.w_start": 15.0, "odd.tau": 50.0,
     "even.tau": 60.0, "output.tau": -900.0},
    {"odd.gear": 0, "even.gear": 0, "output.w_start": 12.0, "odd.w_start": 80.0,
     "even.w_start": 55.0, "odd.tau": 3.0, "even.tau": 2.0, "output.tau": -50.0},
    # at edges of the map: speed in third and second gear, free shafts, torque
    {"odd.gear": 3, "even.gear": 0, "output.w_start": 120.0, "even.w_start": 1400.0},
    {"odd.gear": 0, "even.gear": 2, "output.w_start": 120.0, "odd.w_start": 1400.0},
    {"odd.gear": 3, "odd.tau": 399.98, "output.w_start": 100.0, "output.tau": -2334.0,
     "even.w_start": 600.0},
    {"odd.gear": 3, "odd.tau": -380.0, "output.w_start": 100.0, "output.tau": 2300.0},
]
TWISTS = {"fidelity": 2, "odd.twist": 3.1e-3, "even.twist": -3.3e-3}
POINTS = [{"fidelity": 1, **p} for p in POINTS]
POINTS += [{**p, **TWISTS} for p in POINTS[:5]]
POINTS += [
    # two springs against each other, the output held
    {"odd.gear": 1, "even.gear": 2, "odd.tau": 12.0, "even.tau": -16.0, "output.tau": -36.0,
     **TWISTS},
    # outside the map if rigid
    {"odd.gear": 3, "odd.tau": 900.0, "output.w_start": 50.0, **TWISTS},
]
CHANGES = {"twist": [1e-3, 1.0], "fidelity": [1], "tau": [7.0, 1e4],
           "gear": [0, 1, 2, 3, -1, 9], "w_start": [5.0, -20.0, 300.0],
           "loss_scale": [1.5], "oil_temperature": [20.0], "sync_torque": [3.0]}


def snapshot(h, unknowns):
    return {u.variable.name: h.get(u.variable.name) for u in unknowns}


def changes_of(baked, point, initially):
    for name, v in baked.variables.items():
        steps = CHANGES.get(name.split(".")[-1])
        if steps is None or (not initially and v.causality != "input"):
            continue
        for step in steps:
            old = point.get(name, float(v.start))
            new = step if name.endswith(("gear", "fidelity")) else old + step
            if new != old:
                yield name, {**point, name: new}


def differ(a, b):
    """More than by rounding: the fidelities add up kinetic energy in another order."""
    return abs(a - b) > 1e-13 * max(abs(a), abs(b))


def observed(baked, host, unknowns, initially):
    """Pairs (output, known) where a change of the known changed the output."""
    seen = set()
    for point in POINTS:
        def values(p):
            with host(baked) as h:
                if initially:
                    h.initialise(p)
                else:
                    h.start(point)
                    h.set({k: x for k, x in p.items()
                           if baked.variables[k].causality == "input"})
                return snapshot(h, unknowns)
        before = values(point)
        for name, changed in changes_of(baked, point, initially):
            after = values(changed)
            seen |= {(out, name) for out in before if differ(before[out], after[out])}
    return seen


def observed_of_states(baked, host):
    """Pairs (output, state) where a change of the state changed the output; whether the
    map is left is looked at in events only."""
    d, seen = baked.description, set()
    names = [u.variable.derivative.name for u in d.derivatives]
    for point, (i, name) in itertools.product(POINTS, enumerate(names)):
        with host(baked, exchange=True) as h:
            h.start(point)
            x, before = h.states(), snapshot(h, d.outputs)
            h.set_states(x + 0.5 * (np.arange(len(x)) == i))
            after = snapshot(h, d.outputs)
            h.set_states(x + 300.0 * (np.arange(len(x)) == i))
            h.event()
            after["out_of_map"] = h.get("out_of_map")
            seen |= {(out, name) for out in before if before[out] != after[out]}
    return seen


@pytest.mark.parametrize("initially", [False, True])
def test_dependencies_are_exact(two, host, initially):
    d = two.description
    unknowns = d.initialUnknowns if initially else d.outputs
    declared = {(u.variable.name, k.name) for u in unknowns for k in u.dependencies}
    seen = observed(two, host, unknowns, initially)
    if not initially:
        seen |= observed_of_states(two, host)
    assert seen - declared == set(), "undeclared"
    assert declared - seen == set(), "declared, but without effect"


def test_derivatives_depend_as_the_outputs_they_are(baked):
    outputs = {u.variable.name: u for u in baked.description.outputs}
    for u in baked.description.derivatives:
        o = outputs[u.variable.name]
        assert (u.dependencies, u.dependenciesKind) == (o.dependencies, o.dependenciesKind)


def test_speeds_and_angles_have_no_feedthrough(baked):
    for u in baked.description.outputs:
        if u.variable.name.split(".")[-1] in ("w", "phi"):
            assert u.dependencies == [u.variable]
            assert u.dependenciesKind == ["constant"]


def test_indices_are_unique(baked):
    references = [v.valueReference for v in baked.description.modelVariables]
    assert len(set(references)) == len(references)
    for a, b in itertools.pairwise(references):
        assert a < b
