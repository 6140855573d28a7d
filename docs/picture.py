# SPDX-License-Identifier: BSD-2-Clause
"""Draws docs/dct7.svg from what ./quickstart.sh leaves in build/. Needs matplotlib.

    python docs/picture.py build/dct7.map build/dct7.csv docs/dct7.svg
"""

import csv
import sqlite3
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "gearmap", "font.size": 9, "axes.grid": True,
                            "grid.alpha": 0.3, "axes.spines.top": False,
                            "axes.spines.right": False, "svg.fonttype": "none"})
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito: told apart by the colour-blind
COLOURS = ["#000000", "#E69F00", "#56B4E9", "#009E73", "#D55E00", "#0072B2", "#CC79A7",
           "#777777"]
SPEED = 2000.0  # rpm


def efficiencies(db):
    """gear -> (torques, total efficiency at SPEED, forward), the other path at rest."""
    curves = {}
    for path, gear, ratio in db.execute("SELECT path, gear, ratio FROM gear ORDER BY gear"):
        name = "gear_0" if path == 0 else "gear_1"
        other = "gear_1" if path == 0 else "gear_0"
        direction = "backward" if ratio < 0 else "forward"
        rows = db.execute(
            "SELECT torque_Nm, speed_rpm, loss_torque_Nm FROM v_load_loss l JOIN path p ON "
            "p.name = l.path WHERE p.path = ? AND gear = ? AND path_direction = 'forward' "
            "AND torque_Nm >= 5 ORDER BY torque_Nm, speed_rpm", (path, gear)).fetchall()
        parasitic = db.execute(
            f"SELECT output_speed_rpm, loss_torque_Nm FROM v_parasitic_loss WHERE {name} = ? "
            f"AND {other} = 0 AND output_direction = ? ORDER BY 1",
            (gear, direction)).fetchall()
        at_input = between(parasitic, SPEED / abs(ratio)) / abs(ratio)
        torques = sorted({row[0] for row in rows})
        curves[gear] = (torques, [
            100 * (1 - (between([(s, d) for t, s, d in rows if t == torque], SPEED)
                        + at_input) / torque) for torque in torques])
    return curves


def between(points, x):
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return points[-1][1]


def draw_efficiency(axes, db):
    for colour, (gear, (torque, eta)) in zip(COLOURS, efficiencies(db).items()):
        axes.plot(torque, eta, color=colour, lw=1.5, label="R" if gear < 0 else str(gear))
    axes.legend(frameon=False, ncols=4, loc="lower right", title="gear")
    axes.set(xlabel="input torque [N·m]", ylabel="efficiency [%]", ylim=(91, 99),
             title=f"Map: efficiency of each gear, {SPEED:.0f} rpm, with final drive")


def draw_drive(axes, power, rows):
    time = [row["time [s]"] for row in rows]
    for colour, name in zip(COLOURS, ["engine", "odd", "even"]):
        axes.plot(time, [row[f"{name} speed [rpm]"] for row in rows], color=colour, lw=1.4,
                  label=name)
    axes.set(ylabel="speed [rpm]", title="FMU: driving away, gears 1, 2, 3")
    axes.legend(frameon=False, ncols=3, loc="lower right")
    axes.tick_params(labelbottom=False)
    power.plot(time, [row["loss power [W]"] for row in rows], color=COLOURS[4], lw=1.2)
    power.set(xlabel="time [s]", ylabel="lost [W]")


def main():
    map_file, csv_file, picture = sys.argv[1:]
    with open(csv_file, newline="") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    db = sqlite3.connect(f"file:{map_file}?mode=ro", uri=True)
    figure = plt.figure(figsize=(10, 3.9), layout="constrained")
    grid = figure.add_gridspec(2, 2, height_ratios=[2.2, 1])
    draw_efficiency(figure.add_subplot(grid[:, 0]), db)
    draw_drive(figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1]), rows)
    figure.savefig(picture, metadata={"Date": None})


if __name__ == "__main__":
    main()
