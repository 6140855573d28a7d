# SPDX-License-Identifier: BSD-2-Clause
"""What was measured of the component: by `verify --json`, `verify --trace`, the passport
inside an FMU (docs/passport.md), told apart by name and content, and what the map keeps of
`gearmap reduce`. What is given comes before what the map keeps."""
import json
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd
from pandas.api.types import is_numeric_dtype

from .errors import ReportError

PASSPORT = "extra/gearmap/passport.json"

# What the page reads of a result; a list stands for any number of its one entry.
CASES = {"max_relative": float, "rms_relative": float, "cases": [{"points": float}]}
STEADY = {"points": float, **CASES}
CYCLE = {
    "cycle": str, "duration_s": float, "distance_m": float, "detailed": {"cpu_s": float},
    "reduced": [{
        "fidelity": str, "cpu_s": float, "real_time_factor": float, "cpu_saved": float,
        "energy_balance_relative": float,
        "errors": {"engine_speed_rms_rad_s": float, "vehicle_speed_rms_km_h": float,
                   "output_torque_5Hz_rms_relative": float,
                   "input_torque_5Hz_rms_relative": float, "loss_energy_relative": float},
        "loss_by_gear": [{"gear": float, "time_s": float, "detailed_J": float,
                          "reduced_J": float}],
        "shifts": [{"from": float, "to": float, "time_s": float}],
        "worst": [{"time_s": float, "cause": str}]}]}
RUN = ("vehicle_speed_km_h", "engine_speed_rpm", "output.tau_Nm", "loss_energy_J", "cpu_s")
RUN_PATH = ("speed_rpm", "tau_Nm", "gear", "state")


@dataclass
class Results:
    steady: dict = None  # of verify --steady
    cycles: list = field(default_factory=list)  # of verify --cycle, dicts
    trace: pd.DataFrame = None  # of verify --trace
    trace_path: str = None
    names: list = field(default_factory=list)  # of the files


def has(value, shape):
    """Is there all of shape in the value?"""
    if isinstance(shape, dict):
        return isinstance(value, dict) and all(
            has(value.get(key), wanted) for key, wanted in shape.items())
    if isinstance(shape, list):
        return isinstance(value, list) and all(has(entry, shape[0]) for entry in value)
    if shape is float:
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    return isinstance(value, shape)


def check(path, found, shape):
    if not has(found, shape):
        raise ReportError("%s: is not a whole result of gearmap verify --json" % path)


def check_map(path, content_hash, data):
    if content_hash and content_hash != data.about["content_hash"]:
        raise ReportError("%s: is about a component that was made from another map than %s"
                          % (path, data.path))


def take_json(path, found, data, results):
    """Of verify, of reduce (which holds one of verify), or a passport."""
    if not isinstance(found, dict):
        raise ReportError("%s: is not a result of gearmap verify --json" % path)
    if "passport" in found:
        take_passport(path, found, data, results)
    elif isinstance(found.get("verify"), dict):
        take_json(path, found["verify"], data, results)
    elif "points" in found or "cycle" in found:
        check_map(path, (found.get("measured") or {}).get("map_hash"), data)
        if "points" in found:
            take_steady(path, found, results)
        if "cycle" in found:
            take_cycle(path, found, results)
    else:
        raise ReportError("%s: is not a result of gearmap verify --json" % path)


def take_steady(path, found, results):
    check(path, found, STEADY)
    check(path, list((found.get("groups") or {}).values()), [CASES])
    results.steady = results.steady or found


def of_several(cycle):
    """Results of a single fidelity lie beside it; here in it, in a list of one."""
    if not isinstance(cycle.get("reduced"), dict):
        return cycle
    own = {key: cycle[key] for key in (*CYCLE["reduced"][0], "differences") if key in cycle}
    return {**cycle, "reduced": [{**cycle["reduced"], **own}]}


def take_cycle(path, found, results):
    cycle = of_several(found)
    check(path, cycle, CYCLE)
    if cycle["reduced"] and cycle["cycle"] not in [c["cycle"] for c in results.cycles]:
        results.cycles.append(cycle)


def take_passport(path, passport, data, results):
    check_map(path, (passport.get("map") or {}).get("content_hash"), data)
    if passport.get("steady"):
        take_steady(path, passport["steady"], results)
    for cycle in passport.get("cycles") or []:
        take_cycle(path, cycle, results)


def read_json(path, data, results):
    try:
        found = json.loads(Path(path).read_text(encoding="utf-8"))
    except ValueError:
        raise ReportError("%s: is not JSON" % path) from None
    take_json(path, found, data, results)


def check_trace(path, trace, data):
    if "time_s" not in trace or "detailed.engine_speed_rpm" not in trace:
        raise ReportError("%s: is not a trace of gearmap verify --cycle" % path)
    runs = {c.split(".")[0] for c in trace if "." in c}
    wanted = {"%s.%s" % (run, c) for run in runs for c in RUN}
    wanted |= {"%s.%s.%s" % (run, p, c) for run in runs for p in data.paths
               for c in RUN_PATH}
    missing = sorted(wanted - set(trace))
    if missing:
        raise ReportError("%s: is not a trace of this gearset: it has no column %s"
                          % (path, missing[0]))
    if (len(trace) < 2 or trace.isna().any(axis=None)
            or not all(is_numeric_dtype(kind) for kind in trace.dtypes)):
        raise ReportError("%s: is cut off, or holds what is no number" % path)


def read_trace(path, data, results):
    if results.trace is not None:
        raise ReportError("%s: only one trace can be shown, and %s is there"
                          % (path, results.trace_path))
    try:
        trace = pd.read_csv(path)
    except ValueError:  # of pandas' own too
        raise ReportError("%s: is not a table" % path) from None
    check_trace(path, trace, data)
    results.trace, results.trace_path = trace, path


def read_fmu(path, data, results):
    try:
        with zipfile.ZipFile(path) as archive:
            if PASSPORT not in archive.namelist():
                return
            passport = json.loads(archive.read(PASSPORT))
    except (zipfile.BadZipFile, ValueError):
        raise ReportError("%s: is not an FMU" % path) from None
    take_json(path, passport, data, results)


def take_kept(data, results):
    """Results in the map, where none like them were given."""
    for text in data.results:
        take_json(data.path, json.loads(text), data, results)


def read_results(paths, data):
    results = Results()
    for path in paths:
        if not Path(path).is_file():
            raise ReportError("%s: there is no such file" % path)
        ending = Path(path).suffix.lower()
        if ending == ".csv":
            read_trace(path, data, results)
        elif ending == ".fmu":
            read_fmu(path, data, results)
        elif ending == ".json":
            read_json(path, data, results)
        else:
            raise ReportError("%s: a result ends in .json, .csv or .fmu" % path)
        results.names.append(Path(path).name)
    take_kept(data, results)
    return results
