# SPDX-License-Identifier: BSD-2-Clause
"""FMUs of somebody else, made from law_fmu.c, with rig files for them."""

import os
import subprocess
import zipfile
from pathlib import Path

import fmpy

ROOT = Path(os.environ["GM_SOURCE_DIR"])
CC = os.environ["GM_C_COMPILER"]
HEADERS = Path(fmpy.__file__).parent / "c-code"
TOKEN = "{8c4e810f-3df3-4a00-8276-176fa3c9f001}"
PLATFORM = {2: "linux64", 3: "x86_64-linux"}
GEARS = {"LAW_TWO_PATHS": [{-1: -12.0, 1: 14.0, 3: 4.125}, {2: 9.0, 4: 3.0}]}
ONE_PATH = [{-1: -12.0, 1: 14.0, 2: 8.25, 3: 4.125, 4: 2.5}]
SPEED_IN = {"LAW_SPEED_INPUT": [0, 1], "LAW_SPEED_OUTPUT": [1, 0], "LAW_SPEED_BOTH": [1, 1]}


def binary(folder, variant, version, defines):
    library = folder / "law.so"
    subprocess.run(
        [CC, "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-O2", "-fPIC", "-shared",
         f"-DLAW_FMI={version}", f"-DLAW_VARIANT={variant}", f'-DLAW_TOKEN="{TOKEN}"',
         *(f"-D{d}" for d in defines), f"-I{ROOT / 'tests/rig'}", f"-I{HEADERS}",
         ROOT / "tests/rig/law_fmu.c", ROOT / "tests/rig/law.c", "-lm", "-o", library],
        check=True)
    return library


def variables(variant, odd_units):
    """(name, reference, causality, unit, more) of the reals; names as people choose them.
    The one with odd units says in words what it does otherwise, and how far it goes."""
    takes_speed = SPEED_IN.get(variant, [0, 0, 0])
    paths = len(GEARS.get(variant, ONE_PATH))
    names = ["output", "input"] if paths == 1 else ["output", "odd", "even"]
    units = {"tau": "kN.m" if odd_units else "N.m", "w": "rpm" if odd_units else "rad/s"}
    words = {"tau": ' description="torque leaving the gearset"', "w": ""} if odd_units else {}
    most = {"tau": ' max="0.2"', "w": ' max="5730"'} if odd_units else {}
    found = []
    for flange, name in enumerate(names):
        speed = flange < len(takes_speed) and takes_speed[flange]
        for what, causality in zip(("w", "tau") if speed else ("tau", "w"), ("input", "output")):
            found.append((f"{name}.{what}", flange + 10 * (causality == "output"), causality,
                          units[what], words.get(what, ""), most.get(what, "") if flange else ""))
    found.append(("oil_temperature", 30, "input", "degC" if odd_units else "K", "", ""))
    return found, names


def description(variant, version, modes, odd_units, token):
    reals, names = variables(variant, odd_units)
    states = 8
    lines = []
    if version == 2:
        for name, reference, causality, unit, words, most in reals:
            start = ' start="0"' if causality == "input" else ""
            lines.append(f'<ScalarVariable name="{name}" valueReference="{reference}"{words} '
                         f'causality="{causality}"><Real unit="{unit}"{most}{start}/>'
                         "</ScalarVariable>")
        for path, name in enumerate(names[1:]):
            lines.append(f'<ScalarVariable name="{name}.gear" valueReference="{20 + path}" '
                         'causality="input" variability="discrete"><Integer start="0"/>'
                         "</ScalarVariable>")
        first = len(lines) + 1
        for i in range(states):
            lines.append(f'<ScalarVariable name="x{i}" valueReference="{40 + i}">'
                         '<Real/></ScalarVariable>')
        for i in range(states):
            lines.append(f'<ScalarVariable name="der(x{i})" valueReference="{60 + i}">'
                         f'<Real derivative="{first + i}"/></ScalarVariable>')
        structure = "<Derivatives>" + "".join(
            f'<Unknown index="{first + states + i}"/>' for i in range(states)) + "</Derivatives>"
    else:
        for name, reference, causality, unit, words, most in reals:
            start = ' start="0"' if causality == "input" else ""
            lines.append(f'<Float64 name="{name}" valueReference="{reference}"{words} '
                         f'causality="{causality}" unit="{unit}"{most}{start}/>')
        for path, gears in enumerate(GEARS.get(variant, ONE_PATH)):
            lines.append(f'<Int32 name="{names[1 + path]}.gear" valueReference="{20 + path}" '
                         'causality="input" variability="discrete" start="0" '
                         f'min="{min(0, *gears)}" max="{max(gears)}"/>')
        for i in range(states):
            lines.append(f'<Float64 name="x{i}" valueReference="{40 + i}"/>')
        for i in range(states):
            lines.append(f'<Float64 name="der(x{i})" valueReference="{60 + i}" '
                         f'derivative="{40 + i}"/>')
        structure = "".join(f'<ContinuousStateDerivative valueReference="{60 + i}"/>'
                            for i in range(states))
    interfaces = {"cs": '<CoSimulation modelIdentifier="law"/>',
                  "me": '<ModelExchange modelIdentifier="law"/>'}
    units = "".join(
        f'<Unit name="{unit}"><BaseUnit {base}/></Unit>' for unit, base in {
            "rpm": 'rad="1" s="-1" factor="0.10471975511965977"', "rad/s": 'rad="1" s="-1"',
            "kN.m": 'kg="1" m="2" s="-2" factor="1000"', "N.m": 'kg="1" m="2" s="-2"',
            "K": 'K="1"', "degC": 'K="1" offset="273.15"'}.items())
    key = "guid" if version == 2 else "instantiationToken"
    return (f'<?xml version="1.0"?><fmiModelDescription fmiVersion="{version}.0" '
            f'modelName="law" {key}="{token}">{"".join(interfaces[m] for m in modes)}'
            f'<UnitDefinitions>{units}</UnitDefinitions>'
            f'<ModelVariables>{"".join(lines)}</ModelVariables>'
            f'<ModelStructure>{structure}</ModelStructure></fmiModelDescription>')


def make_fmu(folder, variant="LAW_RIGID", version=2, modes=("cs",), defines=(), token=TOKEN,
             name="law.fmu"):
    odd_units = "LAW_ODD_UNITS" in defines
    library = binary(folder, variant, version, defines)
    with zipfile.ZipFile(folder / name, "w") as archive:
        archive.writestr("modelDescription.xml",
                         description(variant, version, modes, odd_units, token))
        archive.write(library, f"binaries/{PLATFORM[version]}/law.so")
    return folder / name


def make_rig(folder, variant="LAW_RIGID", model="law.fmu", minus=False, extra=""):
    """A rig file that names everything; minus: torques count out of the flanges."""
    takes_speed = SPEED_IN.get(variant, [0, 0, 0])
    gears = GEARS.get(variant, ONE_PATH)
    names = ["output", "input"] if len(gears) == 1 else ["output", "odd", "even"]

    def flange(i, indent):
        speed = i < len(takes_speed) and takes_speed[i]
        sign = ", sign: minus" if minus else ""
        return (f"{indent}drive: {'speed' if speed else 'torque'}\n"
                f"{indent}torque: {{variable: {names[i]}.tau{sign}}}\n"
                f"{indent}speed: {{variable: {names[i]}.w}}\n")
    text = (f"format: 1\nname: law\nmodel: {model}\n{extra}"
            "limits: {input_speed_max_rpm: 5730, input_torque_max_Nm: 200}\n"
            "oil_temperature: {variable: oil_temperature}\npaths:\n")
    for p, path in enumerate(gears):
        text += f"  {names[1 + p]}:\n{flange(1 + p, '    ')}"
        text += f"    gear: {{variable: {names[1 + p]}.gear}}\n    gears:\n"
        text += "".join(f"      {g}: {{ratio: {r}}}\n" for g, r in path.items())
    text += "output:\n" + flange(0, "  ")
    file = folder / "rig.yaml"
    file.write_text(text)
    return file
