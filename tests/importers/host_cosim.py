# SPDX-License-Identifier: BSD-2-Clause
"""host_cosim.py JOB RESULT: a run in libcosim (Open Simulation Platform). The job, JSON:
fmu, step [ns], start, rows, outputs. The result, JSON: one list of values per output."""

import json
import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

REAL, INTEGER = 0, 1  # the others are booleans


def main(job, result):
    execution = CosimExecution.from_step_size(job["step"])
    slave = execution.add_local_slave(CosimLocalSlave(job["fmu"], "gearset"))
    known = {v.name.decode(): v for v in execution.slave_variables(slave)}
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    assert execution.add_observer(observer) and execution.add_manipulator(manipulator)
    for name, value in job["start"].items():
        assert execution.real_initial_value(slave, known[name].reference, value), name
    record = {name: [] for name in job["outputs"]}
    for row in job["rows"]:
        for name, value in row.items():
            real = known[name].type == REAL
            call = manipulator.slave_real_values if real else manipulator.slave_integer_values
            assert call(slave, [known[name].reference], [value]), name
        assert execution.step()
        for name, values in record.items():
            call = {REAL: observer.last_real_values, INTEGER: observer.last_integer_values}.get(
                known[name].type, observer.last_boolean_values)
            values.append(float(call(slave, [known[name].reference])[0]))
    with open(result, "w") as file:
        json.dump(record, file)


if __name__ == "__main__":
    with open(sys.argv[1]) as file:
        main(json.load(file), sys.argv[2])
