# SPDX-License-Identifier: BSD-2-Clause
"""host_ecos.py JOB RESULT: a run in ecos; job and result as for host_cosim.py."""

import json
import sys

from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure
from ecospy.EcosParameterSet import EcosParameterSet

import fmpy


def main(job, result):
    EcosLib.set_log_level("warn")
    kinds = {v.name: v.type for v in fmpy.read_model_description(job["fmu"]).modelVariables}
    with EcosSimulationStructure() as structure, EcosParameterSet() as start:
        structure.add_model("gearset", job["fmu"])
        for name, value in job["start"].items():
            start.add_real(f"gearset::{name}", value)
        structure.add_parameter_set("start", start)
        record = {name: [] for name in job["outputs"]}
        with EcosSimulation(structure=structure, step_size=job["step"] / 1e9) as simulation:
            assert simulation.init(parameter_set="start"), EcosLib.get_last_error()
            for row in job["rows"]:
                for name, value in row.items():
                    call = simulation.set_real if kinds[name] == "Real" else \
                        simulation.set_integer
                    call(f"gearset::{name}", value)
                simulation.step()
                for name, values in record.items():
                    call = {"Real": simulation.get_real, "Boolean": simulation.get_bool}.get(
                        kinds[name], simulation.get_integer)
                    values.append(float(call(f"gearset::{name}")))
            simulation.terminate()
    with open(result, "w") as file:
        json.dump(record, file)


if __name__ == "__main__":
    with open(sys.argv[1]) as file:
        main(json.load(file), sys.argv[2])
