# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 5: where all this comes from."""
from html import escape

from .words import number, paragraph, table


def chapter(data, results):
    about = data.about
    rows = [["Gearset", escape(data.title)],
            ["Map", "<code>%s</code>" % escape(data.path.rsplit("/", 1)[-1])],
            ["Content of the map", "%s values in %s tables" % (number(data.values, 9),
                                                               number(data.tables, 9))],
            ["Name of this content (hash)", "<code>%s</code>" % about["content_hash"]],
            ["Description it was made from (SHA-256)",
             "<code>%s</code>" % about["input_sha256"]],
            ["How it was swept", "<code>%s</code>" % escape(about["options"])],
            ["Made by", "Gearmap %s" % escape(about["tool_version"])]]
    if results.names:
        rows.append(["Results shown", ", ".join("<code>%s</code>" % escape(n)
                                                for n in results.names)])
    return ('<section id="source"><h2>Where does this come from?</h2>'
            + paragraph("Gearmap solves a detailed model of the gearset at many operating "
                        "points and keeps what it finds in tables: the map. The small "
                        "component reads these tables. The same description and options "
                        "always give the same map, and the hash names it.")
            + table(["What", "Value"], rows, "Origin of the numbers on this page.", 9)
            + "</section>")
