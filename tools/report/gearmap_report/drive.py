# SPDX-License-Identifier: BSD-2-Clause
"""One drive of a cycle with the detailed gearset and with each fidelity of the component:
the trace of `gearmap verify --cycle`, by name."""
import numpy as np

from .low_pass import low_pass
from .words import cycle_name, unit

ENGAGED = 2  # state of a path
RUNS = ("detailed", "lash", "rigid")  # in the order in which they are drawn
FLANGE = ".tau_Nm"


class Drive:
    def __init__(self, trace, cycle):
        """cycle: the JSON of the same drive, or None."""
        self.trace, self.cycle = trace, cycle
        self.time = trace["time_s"].to_numpy(float)
        self.n = len(self.time)
        self.step = float(self.time[1] - self.time[0]) if self.n > 1 else 1.0
        self.runs = [r for r in RUNS if r + ".engine_speed_rpm" in trace]
        self.paths = [c.split(".")[1] for c in trace
                      if c.startswith("detailed.") and c.endswith(".gear")]
        self.name = cycle_name(cycle["cycle"]) if cycle else unit(self.time[-1], "s", 4)
        self.filtered = self.filter_torques()

    @property
    def reduced(self):
        return [r for r in self.runs if r != "detailed"]

    def run(self, name, column):
        return self.trace["%s.%s" % (name, column)].to_numpy(float)

    def flanges(self):
        return self.paths + ["output"]

    def filter_torques(self):
        """Torques below 5 Hz: {(run, flange): samples}."""
        keys = [(r, f) for r in self.runs for f in self.flanges()]
        columns = np.stack([self.run(r, f + FLANGE) for r, f in keys], axis=1)
        smooth = low_pass(columns, self.step)
        return {key: smooth[:, i] for i, key in enumerate(keys)}

    def lost(self, name):
        return self.run(name, "loss_energy_J")
