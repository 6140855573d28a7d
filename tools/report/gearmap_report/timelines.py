# SPDX-License-Identifier: BSD-2-Clause
"""Figures over the time of a drive. Their lines are filled in by the page's script from the
series, at the resolution of what is seen: so a zoom shows every sample. All of them zoom
together."""
from html import escape

import plotly.graph_objects as go

from .colours import RUNS
from .figure import canvas, choice, embed
from .series import pack
from .words import unit

STYLE = {"detailed": dict(width=4), "rigid": dict(width=1.6, dash="dash"),
         "lash": dict(width=1.6)}
ALONE = {"rigid": dict(width=1.1), "lash": dict(width=2.2)}  # of differences: no dashes
NAMES = {"detailed": "detailed model", "rigid": "component, rigid",
         "lash": "component, lash"}
TIME = "time [s]"


class Timelines:
    """Collects series and figures of one drive."""

    def __init__(self, drive):
        self.drive, self.series = drive, {}

    def line(self, plot, key, samples, run, row, meta=None, first=False, name=None,
             style=STYLE):
        self.series[key] = samples
        plot.add_trace(go.Scatter(
            x=[], y=[], mode="lines", name=name or NAMES[run], legendgroup=run,
            showlegend=first, line=dict(color=RUNS[run], **style[run]),
            xaxis="x", yaxis="y%s" % (row if row > 1 else ""), visible=meta is None,
            meta={"series": key, **(meta or {})},
            hovertemplate="%{x:.2f} s: %{y:.5g}<extra>" + (name or NAMES[run])
                          + "</extra>"))

    def rows(self, height, titles, gap=0.06):
        """Rows one above the other over one axis of time."""
        plot = canvas(height, TIME, None)
        count = len(titles)
        share = (1.0 - gap * (count - 1)) / count
        for i, title in enumerate(titles):
            top = 1.0 - i * (share + gap)
            axis = dict(domain=[max(0.0, top - share), top], title=title, zeroline=False,
                        automargin=True, title_standoff=8)
            plot.layout["yaxis%s" % (i + 1 if i else "")] = axis
        plot.layout.xaxis.anchor = "y%s" % (count if count > 1 else "")
        plot.update_layout(hovermode="x unified")
        return plot

    # ---- the three figures of the comparison ----

    def processor(self):
        drive = self.drive
        plot = self.rows(340, ["processor time [s]"])
        ends = {r: float(drive.run(r, "cpu_s")[-1]) for r in drive.runs}
        for run in drive.runs:
            self.line(plot, run + ".cpu", drive.run(run, "cpu_s"), run, 1, first=True,
                      name="%s: %s" % (NAMES[run], unit(ends[run], "s")))
        plot.update_yaxes(rangemode="tozero")
        choices = choice("cpu", "scale", "Scale", [("linear", "linear"),
                                                   ("log", "by powers of ten")], "linear")
        return embed("cpu", plot, "Computing time since the start of the drive: the flatter, "
                     "the faster. One processor core.",
                     "Processor time over the time of the drive for the detailed model and "
                     "the component.", choices, kind="timeline")

    def motion(self):
        drive = self.drive
        plot = self.rows(460, ["vehicle [km/h]", "engine [rpm]"])
        for run in drive.runs:
            self.line(plot, run + ".car", drive.run(run, "vehicle_speed_km_h"), run, 1,
                      first=True)
            self.line(plot, run + ".engine", drive.run(run, "engine_speed_rpm"), run, 2)
        return embed("motion", plot, "The lines lie on each other where component and "
                     "detailed model agree: the detailed model is the wide line behind.",
                     "Speed of the vehicle and of the engine over the time of the drive, "
                     "detailed model and component.", kind="timeline")

    def torques(self):
        drive = self.drive
        flanges = drive.flanges()
        plot = self.rows(180 * len(flanges) + 60,
                         ["%s [N·m]" % (f if f == "output" else "input " + f
                                        if f != "input" else f) for f in flanges], 0.04)
        for view in ("smooth", "raw"):
            for run in drive.runs:
                for row, flange in enumerate(flanges, 1):
                    samples = (drive.filtered[run, flange] if view == "smooth"
                               else drive.run(run, flange + ".tau_Nm"))
                    self.line(plot, "%s.%s.%s" % (run, flange, view), samples, run, row,
                              {"view": view}, first=row == 1)
        choices = choice("torques", "view", "Show", [
            ("smooth", "below 5 Hz: what car and driver feel"),
            ("raw", "everything, with vibrations")], "smooth")
        return embed("torques", plot, "Torques into the gearset at its inputs and out of it "
                     "at its output. Draw a box around a moment, or choose one above, to see "
                     "it closer.", "Torques at every flange of the gearset over the "
                     "time of the drive, detailed model and component.", choices,
                     kind="timeline")

    def differences(self):
        drive = self.drive
        plot = self.rows(520, ["vehicle [km/h]", "engine [rpm]", "output [N·m]"], 0.05)
        for run in reversed(drive.reduced):  # the smaller ones in front
            for row, (key, got, true) in enumerate((
                    ("car", drive.run(run, "vehicle_speed_km_h"),
                     drive.run("detailed", "vehicle_speed_km_h")),
                    ("engine", drive.run(run, "engine_speed_rpm"),
                     drive.run("detailed", "engine_speed_rpm")),
                    ("output", drive.filtered[run, "output"],
                     drive.filtered["detailed", "output"])), 1):
                self.line(plot, "%s.%s.difference" % (run, key), got - true, run, row,
                          first=row == 1, style=ALONE)
        return embed("differences", plot, "Component minus detailed model; output torque "
                     "below 5 Hz. Zero: no difference.",
                     "Differences of vehicle speed, engine speed and output torque over "
                     "the time of the drive.", kind="timeline")

    # ---- where to look ----

    def places(self):
        """Ranges of time that are worth a look: (label, from, to)."""
        drive, end = self.drive, self.drive.time[-1]
        found = [("the whole drive", 0.0, end)]
        reduced = (drive.cycle or {}).get("reduced") or []
        for shift in reduced[0]["shifts"] if reduced else []:
            found.append(("shift %d to %d at %.1f s" % (shift["from"], shift["to"],
                                                        shift["time_s"]),
                          shift["time_s"] - 1.5, shift["time_s"] + 2.5))
        for run in reduced:
            for worst in run["worst"][:3]:
                found.append(("largest difference, %s, at %.1f s (%s)" % (
                    run["fidelity"], worst["time_s"], worst["cause"]),
                    worst["time_s"] - 1.0, worst["time_s"] + 1.0))
        return [(label, max(0.0, a), min(end, b)) for label, a, b in found]

    def controls(self):
        options = "".join('<option value="%.3f,%.3f">%s</option>' % (a, b, escape(label))
                          for label, a, b in self.places())
        return ('<div class="look"><label>Look at <select id="look">%s</select></label>'
                '<button type="button" data-move="in">closer</button>'
                '<button type="button" data-move="out">wider</button>'
                '<button type="button" data-move="left">earlier</button>'
                '<button type="button" data-move="right">later</button></div>' % options)

    def data(self):
        """Facts and bytes of all series."""
        return pack(self.series, self.drive.step)
