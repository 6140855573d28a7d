# SPDX-License-Identifier: BSD-2-Clause
"""Where the power is lost, component by component: at chosen points, and over a drive.

The detailed model is solved at each point (`gearmap check --points`). Over a drive the
points are those of the detailed drive, ten for each second, as if each were steady.
"""
import numpy as np
import pandas as pd
import plotly.graph_objects as go

from .colours import COMPONENTS
from .drive import ENGAGED
from .figure import canvas, choice, embed
from .words import gear_name, number, ordinal, paragraph, percent, unit

SPEEDS = (0.15, 0.35, 0.7)  # of the largest
TORQUES = (("0.1", 0.1), ("0.4", 0.4), ("1", 1.0), ("-0.2", -0.2))
STEP = 0.1  # s
SLOWEST = 10.0  # rpm: slower, the input stands


def column(kind):
    return kind.replace(" ", "_") + "_W"


def bars(rows, names, divide, meta, visible):
    """Stacked bars: rows[kind] for each of names. Components without loss are left out."""
    found = []
    for kind, (colour, pattern) in COMPONENTS.items():
        values = rows[column(kind)].to_numpy(float) / divide
        if values.max() <= 0.001 * rows["loss_W"].max() / divide:
            continue
        found.append(go.Bar(
            y=names, x=values, name=kind, orientation="h", meta=meta, visible=visible,
            marker=dict(color=colour, line=dict(width=0),
                        pattern=dict(shape=pattern, fillmode="overlay",
                                     fgcolor="rgba(255,255,255,0.6)", size=7,
                                     solidity=0.2)),
            hovertemplate="%{y}: " + kind + " %{x:.4g}<extra></extra>"))
    return found


def points_table(data):
    rows = []
    for share in SPEEDS:
        speed = round(share * data.about["speed_max_rpm"], -2)
        for key, torque in TORQUES:
            rows += [(n, speed, round(torque * data.about["torque_max_Nm"], 1), key)
                     for _, n in data.all_gears()]
    return pd.DataFrame(rows, columns=["gear", "speed_rpm", "torque_Nm", "key"])


def points_figure(data, gearset):
    table = points_table(data)
    table = pd.concat([gearset.losses(table.drop(columns="key")), table["key"]], axis=1)
    plot = canvas(150 + 34 * len(data.gears), "lost power [W]", None, barmode="stack")
    speeds = sorted(table["speed_rpm"].unique())
    for speed in speeds:
        for key, _ in TORQUES:
            rows = table[(table["speed_rpm"] == speed) & (table["key"] == key)][::-1]
            names = [ordinal(n) for n in rows["gear"]]
            meta = {"speed": "%g" % speed, "torque": key}
            plot.add_traces(bars(rows, names, 1.0, meta, False))
            plot.add_trace(go.Scatter(
                x=rows["loss_W"], y=names, mode="text", meta=meta, visible=False,
                textposition="middle right", showlegend=False, hoverinfo="skip",
                cliponaxis=False,
                text=[" %.0f W" % w if pd.isna(e) else " %.0f W, %.1f %%" % (w, 100 * e)
                      for w, e in zip(rows["loss_W"], rows["efficiency"])]))
    plot.update_layout(margin=dict(l=64, r=96, t=70, b=52), legend_traceorder="normal")
    torque = {k: unit(t * data.about["torque_max_Nm"], "N·m") for k, t in TORQUES}
    choices = choice("components", "speed", "Speed of the input",
                     [("%g" % s, unit(s, "rpm", 4)) for s in speeds],
                     "%g" % speeds[1]) + choice(
        "components", "torque", "Torque", [(k, torque[k]) for k, _ in TORQUES], "0.4")
    return embed("components", plot,
                 "At the end of each bar: all the power lost, and the efficiency. Other "
                 "input shaft in neutral, turning freely. From the detailed model.",
                 "Power lost in each gear by component: meshes, bearings, seals, oil and "
                 "others, at a chosen speed and torque of the input.", choices)


# ---- over a drive ----

def operating_points(drive):
    """One row for each STEP of the detailed drive with a gear engaged: gear, speed, torque
    (means of the step), preselected."""
    every = max(1, round(STEP / drive.step))
    count = drive.n // every

    def means(values):
        return values[:count * every].reshape(count, every).mean(axis=1)

    def ends(values):
        return values[:count * every].reshape(count, every)[:, every // 2]

    speed, torque, engaged, gear = [], [], [], []
    for path in drive.paths:
        speed.append(means(drive.run("detailed", path + ".speed_rpm")))
        torque.append(means(drive.run("detailed", path + ".tau_Nm")))
        gear.append(ends(drive.run("detailed", path + ".gear")).astype(int))
        engaged.append((ends(drive.run("detailed", path + ".state")) == ENGAGED)
                       & (np.abs(speed[-1]) > SLOWEST) & (gear[-1] != 0))
    speed, torque, engaged, gear = map(np.array, (speed, torque, engaged, gear))
    loaded = np.argmax(np.where(engaged, np.abs(torque), -1.0), axis=0)
    at = (loaded, np.arange(count))
    waits = np.zeros(count, int)
    if len(drive.paths) > 1:
        other = (1 - loaded, np.arange(count))
        waits = np.where(engaged[other], gear[other], 0)
    table = pd.DataFrame({"gear": gear[at], "speed_rpm": speed[at], "torque_Nm": torque[at],
                          "preselected": waits})
    return table[engaged[at]].reset_index(drop=True)


def drive_figure(drive, gearset):
    table = operating_points(drive)
    if not len(table):
        return ""
    losses = gearset.losses(table)
    energy = losses.groupby("gear").sum(numeric_only=True) * STEP / 1e3
    energy = energy.sort_index(ascending=False)
    names = [ordinal(int(n)) for n in energy.index]
    plot = canvas(150 + 44 * len(energy), "lost energy [kJ]", None, barmode="stack")
    plot.add_traces(bars(energy, names, 1.0, None, True))
    plot.update_layout(margin=dict(l=64, r=24, t=70, b=52), legend_traceorder="normal")
    total = float(energy["loss_W"].sum())
    measured = float(drive.lost("detailed")[-1]) / 1e3
    shares = {k: float(energy[column(k)].sum()) / total for k in COMPONENTS}
    first, second = sorted(shares, key=shares.get, reverse=True)[:2]
    words = paragraph("Most of it goes into %s (%s) and %s (%s)." % (
        first, percent(shares[first], 2), second, percent(shares[second], 2)))
    return ("<h3>Which parts lose the energy of a drive?</h3>" + words
            + embed("drive-components", plot,
                    "Drive: %s. The detailed model at the speeds and torques of the drive, "
                    "taken as steady: %s; the drive itself lost %s." % (
                        drive.name, unit(total, "kJ"), unit(measured, "kJ")),
                    "Energy lost over the drive by gear and component."))


def chapter(data, gearset, drive):
    if gearset is None:
        return ""
    return ('<section id="parts"><h2>Which parts lose the power?</h2>'
            + points_figure(data, gearset) + "</section>"
            + ('<section id="drive-parts">%s</section>'
               % drive_figure(drive, gearset).replace("h3>", "h2>") if drive else ""))
