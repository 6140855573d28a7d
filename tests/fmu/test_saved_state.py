# SPDX-License-Identifier: BSD-2-Clause
"""States of the FMU in another process: a run resumed there from the bytes of a state is
the uninterrupted one, to the last bit."""

import multiprocessing
import random
import re
import struct
import zipfile

import pytest
from conftest import Baked, Host

STEPS, POINTS, RESUMED = 1500, 100, 60
H = 1.0 / 128  # binary: times are exact


@pytest.fixture(params=["one", "two", "output_in"])
def baked(request):
    return request.getfixturevalue(request.param)


@pytest.fixture(params=[1, 2], ids=["rigid", "lash"])
def fidelity(request):
    return request.param


def flanges(baked):
    return [n.split(".")[0] for n in baked.variables if n.endswith(".gear")]


def gears(baked, path):
    declared = baked.variables[f"{path}.gear"].declaredType
    return list(range(int(declared.min), int(declared.max) + 1))


def command(h, i):
    """What is set before step i: now and then a torque with its slope, a gear, a tunable
    parameter; else things go on."""
    draw = random.Random(i)
    path = draw.choice(flanges(h.baked))
    what = draw.randrange(24)
    if what == 0:
        h.set({f"{path}.gear": draw.choice(gears(h.baked, path))})
    elif what < 4:
        name, size = (f"{path}.tau", 60.0) if what < 3 else ("output.tau", 250.0)
        if h.baked.variables[name].causality == "output":
            name, size = "output.a", 50.0  # the speed goes on by itself
        h.set({name: draw.uniform(-size, size)})
        h.fmu.setRealInputDerivatives([h.baked.variables[name].valueReference], [1],
                                      [draw.uniform(-size, size)])
    elif what == 4:
        h.set({"loss_scale": draw.uniform(0.5, 2.0)})
    elif what == 5:
        h.set({f"{path}.sync_torque": draw.uniform(1.0, 10.0)})


def look(h):
    """The bits of all variables."""
    return struct.pack(f"{len(h.baked.variables)}d", *map(h.get, h.baked.variables))


def go_on(h, first, pending):
    """RESUMED steps; pending: the commands of the first are given already."""
    seen = []
    for i in range(first, first + RESUMED):
        if i > first or not pending:
            command(h, i)
        h.fmu.doStep(i * H, H)
        seen.append(look(h))
    return seen


def resume_all(file, folder, states, results):
    """In the other process."""
    h = Host(Baked(file, folder))
    for first, pending, data in states:
        state = h.fmu.deSerializeFMUstate(data)
        h.fmu.setFMUstate(state)
        h.fmu.freeFMUstate(state)
        results.put(go_on(h, first, pending))
    h.fmu.freeInstance()


def drive(h, fidelity):
    """Values after each step, and states kept on the way, every other one between the
    commands and the step."""
    h.start({"fidelity": fidelity})
    points = sorted(random.Random(1).sample(range(STEPS - RESUMED), POINTS))
    record, states, synchronising = [], [], 0
    for i in range(STEPS):
        pending = len(states) % 2 == 1
        if pending:
            command(h, i)
        if i in points:
            state = h.fmu.getFMUstate()
            states.append((i, pending, h.fmu.serializeFMUstate(state)))
            h.fmu.freeFMUstate(state)
            synchronising += any(h.get(f"{p}.state") == 1 for p in flanges(h.baked))
        if not pending:
            command(h, i)
        h.fmu.doStep(i * H, H)
        record.append(look(h))
    return record, states, synchronising


def test_runs_are_resumed_in_another_process(baked, fidelity, host, tmp_path):
    with host(baked) as h:
        record, states, synchronising = drive(h, fidelity)
    assert len(states) == POINTS
    assert synchronising > 0
    context = multiprocessing.get_context("spawn")
    results = context.Queue()
    other = context.Process(target=resume_all,
                            args=(baked.file, tmp_path / "unpacked", states, results))
    other.start()
    for first, _, _ in states:
        assert results.get(timeout=60) == record[first:first + RESUMED], first
    other.join()
    assert other.exitcode == 0


def test_states_go_back_in_the_same_process(baked, fidelity, host):
    with host(baked) as h:
        record, states, _ = drive(h, fidelity)
        h.fmu.reset()
        state = None
        for first, pending, data in reversed(states):
            state = h.fmu.deSerializeFMUstate(data, state)
            h.fmu.setFMUstate(state)
            assert go_on(h, first, pending) == record[first:first + RESUMED]
        h.fmu.freeFMUstate(state)


def test_the_same_state_has_the_same_bytes(baked, fidelity, host):
    def data():
        with host(baked) as h:
            return [s for _, _, s in drive(h, fidelity)[1]]
    assert data() == data()


def test_states_of_the_other_fmu_are_refused(one, two, host):
    with host(one) as a, host(two) as b:
        a.start()
        b.start({"output.w_start": 5.0})
        state = a.fmu.getFMUstate()
        data = a.fmu.serializeFMUstate(state)
        with pytest.raises(Exception):
            b.fmu.deSerializeFMUstate(data)
        with pytest.raises(Exception):
            b.fmu.setFMUstate(state)
        assert b.get("output.w") == 5.0
        a.fmu.setFMUstate(state)
        a.fmu.freeFMUstate(state)


def test_the_capabilities_are_declared(baked):
    described = baked.description.coSimulation
    assert described.canGetAndSetFMUstate and described.canSerializeFMUstate
    text = zipfile.ZipFile(baked.file).read("modelDescription.xml").decode()
    assert re.search(r'canGetAndSetFMUstate="true"\s+canSerializeFMUstate="true"', text)
