# SPDX-License-Identifier: BSD-2-Clause
"""What the tables of a map say about one gear with the other path in neutral and at rest:

    lost torque at the input   D(w, tau) + P(w / r) / |r|
    efficiency, driving        1 - lost / tau        driven   |tau| / (|tau| + lost)
"""
import numpy as np

from .words import RPM


class GearLosses:
    """Tables of one gear, rotation forward. speed [rpm], torque [N.m]; load[speed][torque]
    and no_load[speed] as lost torque at the input [N.m]."""

    def __init__(self, data, path, number):
        rows = data.load_loss
        rows = rows[(rows["path"] == path) & (rows["gear"] == number)
                    & (rows["path_direction"] == "forward")]
        grid = rows.pivot_table(index="speed_rpm", columns="torque_Nm",
                                values="loss_torque_Nm")
        self.path, self.number = path, number
        self.ratio = float(data.gear(path, number)["ratio"])
        self.speed = grid.index.to_numpy(float)
        self.torque = grid.columns.to_numpy(float)
        self.load = grid.to_numpy(float)
        self.no_load = np.interp(self.speed, *self.parasitic(data))

    def parasitic(self, data, other=0):
        """P with the other path in a gear or in neutral, turned to the input: nodes of
        speed and torque, none if the map has no such configuration."""
        first, second = data.configuration_of(self.path, self.number, other)
        rows = data.parasitic
        chosen = rows[rows["gear_0"] == first]
        if second is not None:
            chosen = chosen[chosen["gear_1"] == second]
        sense = "forward" if self.ratio > 0 else "backward"
        chosen = chosen[chosen["output_direction"] == sense].sort_values("output_speed_rpm")
        ratio = abs(self.ratio)
        return (chosen["output_speed_rpm"].to_numpy(float) * ratio,
                chosen["loss_torque_Nm"].to_numpy(float) / ratio)

    @property
    def lost(self):
        return self.load + self.no_load[:, None]

    @property
    def efficiency(self):
        """NaN at zero torque, and where nothing comes out."""
        torque = self.torque[None, :]
        with np.errstate(divide="ignore", invalid="ignore"):
            driving = 1.0 - self.lost / torque
            driven = -torque / (-torque + self.lost)
        eta = np.where(torque > 0, driving, driven)
        eta[:, self.torque == 0] = np.nan
        return np.where(eta > 0, eta, np.nan)

    @property
    def power(self):
        return self.lost * self.speed[:, None] / RPM

    def lost_at(self, speed, torque):
        """Between the nodes, linearly in both directions. torque: array."""
        rows = np.array([np.interp(torque, self.torque, row) for row in self.lost])
        return np.array([np.interp(speed, self.speed, rows[:, j])
                         for j in range(len(torque))])

    def efficiency_at(self, speed, torque):
        """torque: array, driving."""
        return 1.0 - self.lost_at(speed, torque) / torque


def all_gears(data):
    return [GearLosses(data, path, number) for path, number in data.all_gears()]
