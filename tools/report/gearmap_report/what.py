# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 1: what the gearset is."""
from html import escape

from .efficiency import GearLosses
from .end_view import draw_end_view
from .section import draw_section
from .words import easy, gear_name, number, ordinal, paragraph, percent, plural, table, unit

POINT = (2000.0, 0.4)  # rpm, share of the largest torque: where gears are compared


def point_of(data):
    """A speed and torque in the range of the map, easy to remember."""
    speed = min(POINT[0], easy(0.4 * data.about["speed_max_rpm"]))
    return speed, easy(POINT[1] * data.about["torque_max_Nm"])


def kind_of(gearset, data):
    paths = len(data.paths)
    planets = gearset and any(g["planets"] for g in gearset.parts["gears"])
    if planets:
        return "a planetary gearset: gears turn around each other on one axis"
    if paths > 1:
        return ("a gearset with two input shafts: one carries the odd gears, one the even "
                "ones, so the next gear can wait while the present one drives")
    if len(data.gears) == 1:
        return "a reducer with one speed: its gears are always in mesh"
    return "a gearset with one input shaft and %d gears" % len(data.gears)


def buttons(data):
    gears = data.all_gears()
    first = gears[0][1]
    labels = "".join(
        '<label><input type="radio" name="flow" value="%d"%s> %s</label>'
        % (number_, " checked" if number_ == first else "",
           "R" if number_ == -1 else number_) for _, number_ in gears)
    return ('<fieldset class="choice" id="flow-choice"%s><legend>Show the power flow of gear'
            "</legend>%s</fieldset>" % (" hidden" * (len(gears) < 2), labels))


def flow_words(gearset, number_of_gear):
    gear = gearset.flow(number_of_gear)
    names = " → ".join(escape(n.replace("_", " ")) for n in gear["power_flow"])
    locks = ", ".join(escape(n.replace("_", " ")) for n in gear["locks"])
    closed = " Locked: %s." % locks if locks else ""
    return '<p class="flow-words" data-gear="%d"><b>%s:</b> %s.%s</p>' % (
        number_of_gear, gear_name(number_of_gear).capitalize(), names, closed)


def drawing(data, gearset):
    """The drawings, or a sentence that there are none."""
    if gearset is None:
        return paragraph("The map does not hold the description it was made from, so the "
                         "layout cannot be drawn. A map that is swept again has it.",
                         class_="note")
    parts = gearset.parts
    label = "Section along the shafts of %s, to scale: %s, %s, %s." % (
        data.title, plural(len(parts["shafts"]), "shaft"),
        plural(len(parts["gears"]), "gear"), plural(len(parts["bearings"]), "bearing"))
    end = "The gears of %s seen along the shafts, to scale." % data.title
    words = "".join(flow_words(gearset, n) for _, n in data.all_gears())
    note = ("Section, to scale. Each part is drawn above and below its axis; point at a "
            "part for its name and size. Shafts are unfolded into one plane.")
    if "class=\"link\"" in (section := draw_section(gearset, label)):
        note += " Dashed lines: these two gears are in mesh, the unfolding moved them apart."
    if parts["clutches"]:
        note += " Clutches and brakes: the place is schematic."
    return (buttons(data) + '<div class="flow-list" aria-live="polite">%s</div>' % words
            + '<div class="drawings"><figure class="wide"><div class="scroll" tabindex="0" '
            'role="region" aria-label="Drawing of the section">%s</div>'
            "<figcaption>%s</figcaption></figure>"
            "<figure>%s<figcaption>The same, seen from the right end of the section."
            "</figcaption></figure></div>" % (section, note, draw_end_view(gearset, end))
            + key(parts))


def key(parts):
    """What the colours mean, of what there is."""
    planets = any(g["planets"] for g in parts["gears"])
    entries = [("gear", "gear fixed on its shaft", True),
               ("idler", "gear that turns freely until locked",
                any(g["idles"] for g in parts["gears"])),
               ("idler", "planet", planets), ("shaft", "shaft", True),
               ("bearing", "bearing", True),
               ("sync", "synchroniser", parts["synchronisers"]),
               ("sync", "clutch or brake", parts["clutches"]),
               ("on", "carries the power", True)]
    return '<p class="key">%s</p>' % " ".join(
        '<span><span class="k %s"></span> %s</span>' % (kind, words)
        for kind, words, there in entries if there)


def gear_rows(data):
    speed, torque = point_of(data)
    out = data.about["inertia_output_kgm2"]
    rows = []
    for path, n in data.all_gears():
        gear = data.gear(path, n)
        ratio = gear["ratio"]
        inertia = (out + gear["inertia_extra_kgm2"]) / ratio ** 2 + gear["path_inertia_kgm2"]
        losses = GearLosses(data, path, n)
        eta = losses.efficiency_at(speed, [torque])[0]
        stiffness = gear["stiffness_Nm_rad"]
        rows.append([ordinal(n).capitalize(), number(ratio, 5),
                     percent(eta, 4), number(inertia, 3),
                     number(stiffness, 3) if stiffness else "rigid",
                     number(gear["lash_deg"], 3)])
    return rows


def gear_table(data):
    speed, torque = point_of(data)
    head = ["Gear", "Ratio", "Efficiency", "Inertia at the input [kg·m²]",
            "Stiffness at the input [N·m/rad]", "Free play at the input [°]"]
    caption = ("Ratio: turns of the input for one turn of the output. Efficiency: at %s and "
               "%s of the input. Inertia: of all that turns with this gear, as the input feels "
               "it. Stiffness and free play: with the output held."
               % (unit(speed, "rpm", 4), unit(torque, "N·m")))
    return table(head, gear_rows(data), caption)


def chapter(data, gearset):
    return ('<section id="layout"><h2>What is this gearset?</h2>'
            + paragraph("It is %s." % kind_of(gearset, data),
                        "It takes up to %s at up to %s." % (
                            unit(data.about["torque_max_Nm"], "N·m"),
                            unit(data.about["speed_max_rpm"], "rpm", 5)))
            + drawing(data, gearset) + '</section><section id="gears-table">'
            + "<h2>Which gears does it have?</h2>" + gear_table(data) + "</section>")
