# SPDX-License-Identifier: BSD-2-Clause
"""The detailed gearset behind a map, as `gearmap check` sees its description: parts with
places and sizes, the power flow of each gear, losses by component at points.

The map keeps the text of the description. Without it (a map of a plant that has none)
there is no gearset, and the page leaves out what needs it.
"""
import io
import json
import os
import subprocess
import tempfile
from pathlib import Path

import pandas as pd

from .errors import ReportError


class Gearset:
    def __init__(self, data, text):
        self.text = text
        self.temperature = data.about["oil_degC"]
        self.facts = json.loads(self.check("--json"))
        self.parts = self.facts["parts"]

    def check(self, *options, table=None):
        """Standard output of `gearmap check` on the description; table: for --points."""
        with tempfile.TemporaryDirectory() as folder:
            description = Path(folder, "description.yaml")
            description.write_text(self.text, encoding="utf-8", newline="")
            command = [os.environ.get("GEARMAP", "gearmap"), "check", str(description),
                       "--oil-temperature", "%.9g" % self.temperature, *options]
            if table is not None:
                points = Path(folder, "points.csv")
                table.to_csv(points, index=False)
                command += ["--points", str(points)]
            try:
                done = subprocess.run(command, capture_output=True, text=True)
            except OSError as error:
                raise ReportError("%s: cannot be started: %s"
                                  % (command[0], error.strerror)) from None
        if done.returncode != 0:
            raise ReportError("the description in the map: %s"
                              % done.stderr.strip().removeprefix("gearmap: "))
        return done.stdout

    def losses(self, table):
        """Columns gear, speed_rpm, torque_Nm, preselected in; the same with losses out."""
        return pd.read_csv(io.StringIO(self.check(table=table)))

    def flow(self, number):
        """The gear's entry in the facts: power_flow, locks, inertia."""
        for path in self.facts["paths"]:
            for gear in path["gears"]:
                if gear["number"] == number:
                    return gear
        raise KeyError(number)


def read_gearset(data):
    return Gearset(data, data.description) if data.description else None
