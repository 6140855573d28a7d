# SPDX-License-Identifier: BSD-2-Clause
"""The map: everything that the page shows of it, as tables of pandas."""
import sqlite3
from dataclasses import dataclass, replace
from pathlib import Path

import pandas as pd

from .errors import ReportError

APPLICATION = 1198345584  # "GmMp", docs/map.md


@dataclass
class Map:
    path: str
    about: pd.Series  # v_map: name, title, ranges, hashes
    gears: pd.DataFrame  # v_gear
    configurations: pd.DataFrame
    load_loss: pd.DataFrame  # of the usual oil temperature, as the next two
    parasitic: pd.DataFrame
    drag: pd.DataFrame
    slices: dict  # oil temperature [degC] -> the last three, where there are several
    errors: pd.DataFrame  # verification, or empty
    points: pd.DataFrame  # compared points with their case, or empty
    tables: int
    values: int
    results: list  # JSON texts of verifications that the map keeps
    description: str  # text, or None

    @property
    def title(self):
        return self.about["title"] or self.about["name"]

    @property
    def paths(self):
        """Names in the order of the map."""
        return list(self.gears["path"].drop_duplicates())

    def at(self, temperature):
        """The same map at one of its oil temperatures."""
        return replace(self, **self.slices[temperature])

    def all_gears(self):
        """(path, number), forward gears first and rising, reverse last."""
        rows = sorted(zip(self.gears["path"], self.gears["gear"]),
                      key=lambda r: (r[1] < 0, abs(r[1])))
        return [(path, int(number)) for path, number in rows]

    def gear(self, path, number):
        rows = self.gears[(self.gears["path"] == path) & (self.gears["gear"] == number)]
        return rows.iloc[0]

    def configuration_of(self, path, number, other=0):
        """Gears of path 0 and 1 with this gear engaged and the other path in the gear
        other, 0: neutral (None: no such path)."""
        if len(self.paths) == 1:
            return number, None
        return (number, other) if self.paths.index(path) == 0 else (other, number)


VERIFICATION = "SELECT rowid AS id, * FROM verification"
POINTS = """SELECT v.kind, v.path, v.gear_0, v.gear_1, v.direction, v.largest_Nm,
    p.speed_rpm, p.torque_Nm, p.detailed_Nm, p.reduced_Nm
    FROM verification_point p JOIN verification v ON v.rowid = p.verification"""


def open_map(path):
    if not Path(path).is_file():
        raise ReportError("%s: there is no such file" % path)
    uri = "%s?mode=ro&immutable=1" % Path(path).resolve().as_uri()
    return sqlite3.connect(uri, uri=True)


def check_kind(path, connection):
    try:
        kind = connection.execute("PRAGMA application_id").fetchone()[0]
        state = connection.execute("SELECT value FROM meta WHERE key = 'state'").fetchone()
    except sqlite3.DatabaseError:
        raise ReportError("%s is not a map" % path) from None
    if kind != APPLICATION:
        raise ReportError("%s is not a map: it is an SQLite file of another kind" % path)
    if not state or state[0] != "finished":
        raise ReportError("%s is not a finished map" % path)


def optional(connection, table, query):
    """A table that need not be there: empty then."""
    there = connection.execute("SELECT count(*) FROM sqlite_master WHERE name = ?",
                               (table,)).fetchone()[0]
    return pd.read_sql_query(query, connection) if there else pd.DataFrame()


def slices_of(tables):
    """{oil temperature: tables at it} of tables by name; none if there is only one."""
    oil = next(iter(tables.values())).get("oil_degC")
    temperatures = [] if oil is None else sorted(oil.unique())
    if len(temperatures) < 2:
        return {}
    return {float(t): {name: rows[rows["oil_degC"] == t] for name, rows in tables.items()}
            for t in temperatures}


def read_map(path):
    connection = open_map(path)
    try:
        check_kind(path, connection)

        def view(name):
            return pd.read_sql_query("SELECT * FROM %s" % name, connection)

        text = optional(connection, "description", "SELECT text FROM description")
        kept = optional(connection, "result", "SELECT json FROM result ORDER BY rowid")
        count = connection.execute("SELECT count(*) FROM map_table").fetchone()[0]
        values = connection.execute("SELECT count(*) FROM value").fetchone()[0]
        about = view("v_map").iloc[0]
        tables = {"load_loss": view("v_load_loss"), "parasitic": view("v_parasitic_loss"),
                  "drag": view("v_drag")}
        slices = slices_of(tables)
        if slices:
            tables = slices[min(slices, key=lambda t: abs(t - about["oil_degC"]))]
        return Map(path=str(path), about=about, gears=view("v_gear"),
                   configurations=view("v_configuration"), **tables, slices=slices,
                   errors=optional(connection, "verification", VERIFICATION),
                   points=optional(connection, "verification_point", POINTS),
                   tables=count, values=values,
                   results=list(kept["json"]) if len(kept) else [],
                   description=text["text"].iloc[0] if len(text) else None)
    except (sqlite3.DatabaseError, pd.errors.DatabaseError) as error:
        raise ReportError("%s is damaged: %s" % (path, error)) from None
    finally:
        connection.close()
