# SPDX-License-Identifier: BSD-2-Clause
"""The library in the FMU, and its sources without it."""

import os
import re
import shutil
import subprocess

import fmpy
import numpy as np
import pytest

CC = os.environ["GM_C_COMPILER"]


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout


def dynamic_symbols(binary, *options):
    return [line.split() for line in run("nm", "-D", "-P", *options, binary).splitlines()]


def test_exports_only_fmi_functions(two):
    names = {s[0] for s in dynamic_symbols(two.binary, "--defined-only")}
    assert names and all(n.startswith("fmi2") for n in names)
    assert {"fmi2Instantiate", "fmi2DoStep", "fmi2GetRealOutputDerivatives",
            "fmi2GetDirectionalDerivative", "fmi2GetStringStatus"} <= names
    assert not any("_" in n for n in names)


def test_needs_only_the_c_library(two):
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", two.binary)))
    assert needed <= {"libc.so.6", "libm.so.6"}


def test_calls_nothing_that_enters_the_system(two):
    """Formatting of messages into the stack, and calloc/free as the default of missing
    callbacks; all else is arithmetic and moving of memory."""
    allowed = {"calloc", "free", "memcpy", "memmove", "memset", "memcmp", "strcmp", "strlen",
               "snprintf", "vsnprintf", "__snprintf_chk", "__vsnprintf_chk", "__memcpy_chk",
               "__stack_chk_fail", "__cxa_finalize", "__gmon_start__",
               "_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable"}
    names = {s[0].split("@")[0] for s in dynamic_symbols(two.binary, "--undefined-only")}
    assert names <= allowed


def test_runs_with_an_old_c_library(two):
    versions = re.findall(r"GLIBC_([\d.]+)", run("readelf", "-V", two.binary))
    newest = max(tuple(map(int, v.split("."))) for v in versions)
    assert newest <= (2, 17)  # of 2012


def test_has_no_writable_data_of_its_own(two, tmp_path):
    sources = sorted((two.folder / "sources").glob("*.c"))
    assert sources
    for source in sources:
        obj = tmp_path / (source.stem + ".o")
        run(CC, "-std=c99", "-O2", "-fPIC", "-c", source, "-o", obj)
        for line in run("size", "-A", obj).splitlines():
            fields = line.split()
            if fields and fields[0] in (".data", ".bss", ".data.rel", ".data.rel.local"):
                assert fields[1] == "0", f"{source.name}: {line}"


def test_sources_compile_without_warnings(two, tmp_path):
    for source in sorted((two.folder / "sources").glob("*.c")):
        done = subprocess.run(
            [CC, "-std=c99", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c", source,
             "-o", tmp_path / "unit.o"], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr


def test_nothing_of_this_machine_is_inside(two):
    data = two.binary.read_bytes()
    for word in (str(two.folder.parent).encode(), b"/tmp/", os.environ["GM_SOURCE_DIR"].encode()):
        assert word not in data


def test_is_small(two):
    assert two.file.stat().st_size < 2 * 1024 * 1024


def simulate(file):
    return fmpy.simulate_fmu(
        str(file), stop_time=2.0, step_size=0.01, output_interval=0.01,
        start_values={"output.w_start": 30.0, "odd.gear": 3, "odd.tau": 40.0},
        output=["output.w", "odd.phi", "loss_energy", "output.a", "even.w"])


def build_from_sources(unpacked, archive):
    """fmpy moved its function in 0.3.27: by file before, by folder since."""
    try:
        from fmpy.build import build_platform_binary
    except ImportError:
        from fmpy.util import compile_platform_binary
        compile_platform_binary(str(archive))
        return archive
    build_platform_binary(unpacked)
    return unpacked


def test_compiles_from_the_sources_alone_to_the_same_results(two, tmp_path):
    """On x86-64 without FMA the usual flags give the same bits too."""
    unpacked, archive = tmp_path / "unpacked", tmp_path / "sources.fmu"
    shutil.copytree(two.folder, unpacked)
    shutil.rmtree(unpacked / "binaries")
    shutil.make_archive(str(tmp_path / "sources"), "zip", unpacked)
    (tmp_path / "sources.zip").rename(archive)
    with pytest.raises(Exception):
        simulate(archive)
    again, shipped = simulate(build_from_sources(unpacked, archive)), simulate(two.file)
    for name in shipped.dtype.names:
        assert np.array_equal(again[name], shipped[name])
