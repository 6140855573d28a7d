# SPDX-License-Identifier: BSD-2-Clause
"""What can be told without running: warnings, MISRA, recursion, stack, sizes, symbols."""

import csv
import re
import subprocess

import pytest

import callgraph
from conftest import ROOT
from folder import COMMON, HERE, M4, STRICT, measured, run

KINDS = [("float", "float"), ("float", "int16"), ("double", "float")]


@pytest.mark.parametrize("compiler", ["gcc", "clang", "m4"])
@pytest.mark.parametrize("real,tables", KINDS)
def test_no_warnings(bake, tmp_path, compiler, real, tables):
    folder = bake(real, tables)
    command = M4 if compiler == "m4" else [compiler]
    for source in [*folder.sources(), folder.path / "main.c"]:
        run(*command, *COMMON, *STRICT, *folder.include, "-c", source, "-o",
            tmp_path / "x.o")


@pytest.fixture(scope="module")
def objects(bake, tmp_path_factory):
    """{(real, tables): folder with Cortex-M4F objects and their call graphs}"""
    done = {}

    def build(real, tables):
        if (real, tables) not in done:
            folder, out = bake(real, tables), tmp_path_factory.mktemp("m4")
            for source in folder.sources():
                run(*M4, *COMMON, *folder.include, "-fcallgraph-info=su", "-c", source,
                    "-o", out / f"{source.stem}.o", cwd=out)
            done[real, tables] = out
        return done[real, tables]
    return build


def test_no_recursion_and_little_stack(objects):
    out = objects("float", "float")
    frames, calls, dynamic = callgraph.read(sorted(out.glob("*.ci")))
    assert "gm_gearset_step" in frames
    assert not callgraph.cycles(calls)
    assert not dynamic
    assert not [f for f in frames if "__indirect_call" in calls.get(f, ())]
    depth, chain = callgraph.deepest("gm_gearset_step", frames, calls)
    print("stack of gm_gearset_step", depth, "bytes:",
          " ".join(f"{f.split(':')[-1]} {frames.get(f, 0)}" for f in chain))
    assert depth <= measured()["stack"]


ENTRY = """
#include "gm_gearset.h"
#include "gm_tables.h"
gm_gearset g; gm_gearset_start s; gm_reduced_inputs i; gm_gearset_outputs o;
void _start(void);
void _start(void)
{
    gm_gearset_defaults(&gm_tables_map, &s);
    (void)gm_gearset_init(&gm_tables_map, &s, &g);
    gm_gearset_set(&i, &g);
    (void)gm_gearset_step(&gm_tables_map, &g, GM_STEP);
    (void)gm_gearset_get(&gm_tables_map, &g, &o);
}
"""


def flash(bake, objects, tmp_path, tables):
    """(code, tables) in bytes of a program that uses every call."""
    folder, out = bake("float", tables), objects("float", tables)
    (tmp_path / "entry.c").write_text(ENTRY)
    run(*M4, *COMMON, *folder.include, "-nostartfiles", "-Wl,--gc-sections", "-Wl,-Map",
        f"-Wl,{tmp_path / 'map'}", tmp_path / "entry.c", *sorted(out.glob("*.o")), "-o",
        tmp_path / "a.elf")
    text = int(run("arm-none-eabi-size", tmp_path / "a.elf").splitlines()[1].split()[0])
    data = int(run("arm-none-eabi-size", out / "gm_tables.o").splitlines()[1].split()[0])
    return text - data, data


@pytest.mark.parametrize("tables,most", [("float", 128), ("int16", 64)])
def test_flash(bake, objects, tmp_path, tables, most):
    """Beyond the stated bound in kB this is a failure of what is promised."""
    code, data = flash(bake, objects, tmp_path, tables)
    print(f"flash {tables}: code {code} + tables {data} = {code + data} bytes,"
          f" bound {most * 1024}")
    assert code <= measured()["code"]
    assert code + data <= most * 1024


def test_ram(bake, tmp_path):
    folder = bake("float", "float")
    unit = tmp_path / "unit.c"
    unit.write_text('#include "gm_gearset.h"\nchar size[sizeof(gm_gearset)];\n')
    run(*M4, *COMMON, *folder.include, "-c", unit, "-o", tmp_path / "unit.o")
    line = run("arm-none-eabi-nm", "-S", tmp_path / "unit.o").split()
    print("RAM of a gearset", int(line[1], 16), "bytes")
    assert int(line[1], 16) <= min(512, measured()["ram"])


def test_nothing_is_called_and_nothing_written_outside(objects):
    """No library but the compiler's own; no variables."""
    out = objects("float", "float")
    table = [line.split() for f in sorted(out.glob("*.o"))
             for line in run("arm-none-eabi-nm", "-P", f).splitlines()]
    defined = {s[0] for s in table if s[1] != "U"}
    foreign = {s[0] for s in table if s[1] == "U"} - defined
    assert foreign <= {"memcpy", "memset", "memmove"}
    assert not [s[0] for s in table if s[1] in "dDbBcC"]


def test_the_list_of_tables_is_where_they_are(bake, tmp_path):
    """tables.csv against offsetof in the compiled struct."""
    folder = bake("float", "int16")
    with open(folder.path / "tables.csv") as file:
        rows = list(csv.DictReader(file))
    lines = "".join(
        f'    check(offsetof(gm_calibration_block, {r["symbol"].split(".")[1]}) =='
        f' {r["offset_bytes"]} && sizeof {r["symbol"]} == {r["size_bytes"]});\n'
        for r in rows)
    (tmp_path / "unit.c").write_text(
        '#include "gm_tables.h"\n#include <stddef.h>\n#include <stdio.h>\n'
        "static int bad;\nstatic void check(int ok) { bad += !ok; }\n"
        f"int main(void)\n{{\n{lines}    return bad != 0;\n}}\n")
    run("gcc", "-std=c99", *folder.include, tmp_path / "unit.c",
        folder.path / "gm_tables.c", "-o", tmp_path / "unit")
    run(tmp_path / "unit")
    assert sum(int(r["rows"]) * int(r["columns"]) for r in rows) > 1000


def allowed_rules():
    """Rules that docs/misra.md lists as deviations."""
    text = (ROOT / "docs" / "misra.md").read_text()
    return set(re.findall(r"^\| (\d+\.\d+) ", text, re.M))


def test_misra(bake, tmp_path):
    folder = bake("float", "float")
    done = subprocess.run(
        ["cppcheck", "--addon=misra", "--std=c99", "--platform=unix32", "--quiet",
         "--enable=warning,portability,performance", "--error-exitcode=0",
         "--inline-suppr", "--template={file}:{line}: {severity}: {id}: {message}",
         *folder.include[:2],
         *[str(s) for s in folder.sources(tables=False)]],
        capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found = [line for line in done.stderr.splitlines() if " misra-c2012-" in line]
    other = [line for line in done.stderr.splitlines()
             if line not in found and re.search(r": (error|warning|portability|performance):",
                                                line)]
    rules = {re.search(r"misra-c2012-(\d+\.\d+)", line)[1] for line in found}
    print("MISRA deviations:", {r: sum(f"2012-{r}:" in line for line in found)
                                for r in sorted(rules)})
    assert found, "the addon did not run"
    assert not other, "\n".join(other)
    assert rules <= allowed_rules(), "\n".join(
        line for line in found
        if re.search(r"misra-c2012-(\d+\.\d+)", line)[1] not in allowed_rules())
