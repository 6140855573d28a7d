# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 3: is the small component as good as the detailed model? One vehicle drove one
cycle with both."""
from html import escape

import plotly.graph_objects as go

from . import accuracy
from .colours import RUNS
from .figure import canvas, embed
from .words import RPM, cycle_name, number, ordinal, paragraph, percent, table, unit

COMMANDS = """gearmap verify DESCRIPTION.yaml COMPONENT.fmu --steady --cycle ece15 \\
    --trace drive.csv --json &gt; verify.json
gearmap report %s verify.json drive.csv -o report.html"""


def how_to(data):
    return ('<section id="comparison"><h2>Is it as good as the detailed model?</h2>'
            + paragraph("This page was made without a comparison over a drive. These two "
                        "commands make one and put it here:")
            + "<pre><code>%s</code></pre></section>"
            % (COMMANDS % escape(data.path.rsplit("/", 1)[-1])))


def run_name(run):
    step = run.get("communication_step_s")
    return run["fidelity"] + (" in steps of %s" % unit(1e3 * step, "ms") if step else "")


def tiles(cycle):
    """The numbers that people remember, for each fidelity."""
    found = ""
    for run in cycle["reduced"]:
        faster = cycle["detailed"]["cpu_s"] / run["cpu_s"]
        entries = ((number(faster, 2) + "×", "faster than the detailed model"),
                   (number(run["real_time_factor"], 2) + "×", "faster than real time"),
                   (percent(abs(run["errors"]["loss_energy_relative"]), 2),
                    "difference of the energy lost"))
        found += '<div class="tile"><h3>%s</h3><ul class="facts">%s</ul>%s</div>' % (
            escape(run_name(run)),
            "".join("<li><b>%s</b> <span>%s</span></li>" % e for e in entries),
            largest_words(run))
    return '<div class="tiles">%s</div>' % found


def largest_words(run):
    """The largest differences of the motion; results of earlier versions have none."""
    found = run.get("differences") or {}
    car, engine = found.get("vehicle_speed_km_h"), found.get("engine_speed_rad_s")
    if not car or not engine:
        return ""
    return paragraph("At no moment of the drive was the vehicle more than %s away from its "
                     "speed with the detailed model, or the engine more than %s." % (
                         unit(car["max"], "km/h", 2), unit(engine["max"] * RPM, "rpm", 2)))


FIDELITIES = paragraph(
    "The component has two settings. <b>Rigid</b>: gears in mesh turn together without "
    "play, the fastest to compute. <b>Lash</b>: each input is joined by a spring with "
    "the free play of the teeth, which also shows the knock when the torque changes its "
    "sign.")


def passport_rows(cycle):
    runs = cycle["reduced"]

    def row(words, of):
        return [words] + [of(r) for r in runs]

    return [
        row("Processor time saved", lambda r: percent(r["cpu_saved"], 3)),
        row("Engine speed, typical difference",
            lambda r: unit(r["errors"]["engine_speed_rms_rad_s"] * RPM, "rpm", 2)),
        row("Vehicle speed, typical difference",
            lambda r: unit(r["errors"]["vehicle_speed_rms_km_h"], "km/h", 2)),
        row("Output torque below 5 Hz, typical difference",
            lambda r: percent(r["errors"]["output_torque_5Hz_rms_relative"], 2)),
        row("Input torque below 5 Hz, typical difference",
            lambda r: percent(r["errors"]["input_torque_5Hz_rms_relative"], 2)),
        row("Energy lost in the gearset",
            lambda r: percent(r["errors"]["loss_energy_relative"], 2)),
        row("Energy that is not accounted for",
            lambda r: number(1e6 * r["energy_balance_relative"], 2) + " millionths"),
    ]


def numbers_section(cycle):
    words = paragraph(
        "One and the same vehicle drove <b>%s</b> (%s, %s) with the detailed model and "
        "with the component." % (escape(cycle_name(cycle["cycle"])),
                                 unit(cycle["duration_s"], "s", 4),
                                 unit(cycle["distance_m"] / 1e3, "km")),
        "The detailed model took %s of one processor core." % unit(
            cycle["detailed"]["cpu_s"], "s"))
    passport = table([""] + [escape(run_name(r)) for r in cycle["reduced"]],
                     passport_rows(cycle), "Component against detailed model over the "
                     "drive. Typical: root mean square; torques relative to their own size.")
    return words + tiles(cycle) + FIDELITIES + passport


def gears_figure(cycle, figure_id):
    """Energy lost while each gear drives."""
    runs = cycle["reduced"]
    gears = [g["gear"] for g in runs[0]["loss_by_gear"]]
    names = [ordinal(n) for n in gears]
    plot = canvas(360, "gear", "lost energy [kJ]", barmode="group")
    bars = [("detailed model", RUNS["detailed"], "",
             [g["detailed_J"] for g in runs[0]["loss_by_gear"]])]
    bars += [("component, " + run_name(r), RUNS[r["fidelity"]], "/" if i == 0 else "",
              [g["reduced_J"] for g in r["loss_by_gear"]]) for i, r in enumerate(runs)]
    for name, colour, pattern, energy in bars:
        plot.add_trace(go.Bar(
            x=names, y=[e / 1e3 for e in energy], name=name,
            marker=dict(color=colour, pattern=dict(
                shape=pattern, fillmode="overlay", solidity=0.2,
                fgcolor="rgba(255,255,255,0.6)")),
            hovertemplate="%{x}, " + name + ": %{y:.4g} kJ<extra></extra>"))
    return embed(figure_id, plot, "Energy lost in the gearset while the wheels are driven in "
                 "each gear.", "Energy lost in each gear over the drive, detailed model "
                 "and component.")


def gears_table(cycle):
    rows = []
    for i, gear in enumerate(cycle["reduced"][0]["loss_by_gear"]):
        row = [ordinal(gear["gear"]).capitalize(), unit(gear["time_s"], "s"),
               unit(gear["detailed_J"] / 1e3, "kJ", 4)]
        for run in cycle["reduced"]:
            mine = run["loss_by_gear"][i]
            share = mine["reduced_J"] / mine["detailed_J"] - 1 if mine["detailed_J"] else 0
            row.append(("+" if share > 0 else "") + percent(share, 2))
        rows.append(row)
    head = ["Gear", "Time", "Detailed model"] + [escape(run_name(r)) + ", difference"
                                                 for r in cycle["reduced"]]
    return table(head, rows, "Energy lost in each gear.")


def section(name, question, body):
    return '<section id="%s"><h2>%s</h2>%s</section>' % (name, question, body)


def timeline_sections(timelines):
    return (
        '<div class="timelines">' + timelines.controls()
        + section("faster", "How much faster is it?", timelines.processor())
        + section("same-motion", "Do engine and vehicle move the same?",
                  timelines.motion())
        + section("same-torque", "Are the torques the same?", timelines.torques())
        + section("error-time", "When is it wrong?", timelines.differences()) + "</div>")


def chapter(data, results, timelines):
    text = ""
    for i, cycle in enumerate(results.cycles):
        name = "comparison-%d" % i
        text += section(name, "Is it as good as the detailed model?" if i == 0 else
                        "And over %s?" % escape(cycle_name(cycle["cycle"])), numbers_section(cycle))
    if timelines:
        text += timeline_sections(timelines)
    for i, cycle in enumerate(results.cycles):
        if cycle["reduced"] and cycle["reduced"][0]["loss_by_gear"]:
            text += section("gear-energy-section-%d" % i,
                            "How much energy is lost in each gear?",
                            gears_figure(cycle, "gear-energy-%d" % i) + gears_table(cycle))
    if not text:
        text = how_to(data)
    return text + accuracy.chapter(data, results)
