# SPDX-License-Identifier: BSD-2-Clause
"""What was measured of the component: by `verify --json`, `verify --trace`, the passport
inside an FMU (docs/passport.md), told apart by name and content, and what the map keeps of
`gearmap reduce`. What is given comes before what the map keeps."""
import json
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from .errors import ReportError

PASSPORT = "extra/gearmap/passport.json"


@dataclass
class Results:
    steady: dict = None  # of verify --steady
    cycles: list = field(default_factory=list)  # of verify --cycle, dicts
    trace: pd.DataFrame = None  # of verify --trace
    trace_path: str = None
    names: list = field(default_factory=list)  # of the files


def take_json(path, found, results):
    if not isinstance(found, dict):
        raise ReportError("%s: is not a result of gearmap verify --json" % path)
    if "passport" in found:
        take_passport(found, results)
    elif "points" in found or "cycle" in found:
        if "points" in found:
            results.steady = found
        if "cycle" in found:
            results.cycles.append(found)
    elif isinstance(found.get("verify"), dict):  # of gearmap reduce --json
        take_json(path, found["verify"], results)
    else:
        raise ReportError("%s: is not a result of gearmap verify --json" % path)


def take_passport(passport, results):
    results.steady = results.steady or passport.get("steady")
    known = [c["cycle"] for c in results.cycles]
    results.cycles += [c for c in passport.get("cycles") or [] if c["cycle"] not in known]


def read_json(path, results):
    try:
        take_json(path, json.loads(Path(path).read_text(encoding="utf-8")), results)
    except (ValueError, UnicodeDecodeError):
        raise ReportError("%s: is not JSON" % path) from None


def read_trace(path, results):
    if results.trace is not None:
        raise ReportError("%s: only one trace can be shown, and %s is there"
                          % (path, results.trace_path))
    try:
        trace = pd.read_csv(path)
    except (ValueError, pd.errors.ParserError):
        raise ReportError("%s: is not a table" % path) from None
    if "time_s" not in trace or "detailed.engine_speed_rpm" not in trace:
        raise ReportError("%s: is not a trace of gearmap verify --cycle" % path)
    results.trace, results.trace_path = trace, path


def read_fmu(path, data, results):
    try:
        with zipfile.ZipFile(path) as archive:
            if PASSPORT not in archive.namelist():
                return
            passport = json.loads(archive.read(PASSPORT))
    except (zipfile.BadZipFile, ValueError):
        raise ReportError("%s: is not an FMU" % path) from None
    made_from = (passport.get("map") or {}).get("content_hash")
    if made_from and made_from != data.about["content_hash"]:
        raise ReportError("%s: was made from another map than %s" % (path, data.path))
    take_passport(passport, results)


def take_kept(data, results):
    """Results in the map, where none like them were given."""
    for text in data.results:
        kept = Results()
        take_json(data.path, json.loads(text), kept)
        results.steady = results.steady or kept.steady
        known = [c["cycle"] for c in results.cycles]
        results.cycles += [c for c in kept.cycles if c["cycle"] not in known]


def read_results(paths, data):
    results = Results()
    for path in paths:
        if not Path(path).is_file():
            raise ReportError("%s: there is no such file" % path)
        ending = Path(path).suffix.lower()
        if ending == ".csv":
            read_trace(path, results)
        elif ending == ".fmu":
            read_fmu(path, data, results)
        elif ending == ".json":
            read_json(path, results)
        else:
            raise ReportError("%s: a result ends in .json, .csv or .fmu" % path)
        results.names.append(Path(path).name)
    take_kept(data, results)
    return results
