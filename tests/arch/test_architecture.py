# SPDX-License-Identifier: BSD-2-Clause
"""The rules of the source tree that a compiler does not check: which room may include
which, what the shipped core may call and hold, which files belong to the build."""

import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["GM_SOURCE_DIR"])
CC = os.environ["GM_C_COMPILER"]

# Includes point from a room to these only. "tools" may include everything.
ARROWS = {
    "core": set(),
    "base": set(),
    "model": {"core", "base"},
    "map": {"core", "base"},
    "plant": {"model", "base"},
    "solve": {"plant", "base"},
    "sweep": {"plant", "solve", "map", "base"},
    "bake": {"map", "model", "core", "base"},
    "vehicle": {"plant", "solve", "model", "base"},
    "fmu": {"core"},
    "embedded": {"core"},
    "fmu_detailed": {"fmu", "model", "core", "base"},
}
# A foreign library is the business of these rooms only.
LIBRARIES = {
    r"(cvode|kinsol|ida|sun\w*|nvector)/": {"solve"},
    r"sqlite3\.h": {"map"},
    r"libfyaml\.h": {"model"},
    r"libxml/": {"bake", "plant"},
    r"zip\.h": {"bake", "plant"},
    r"pthread\.h": {"base", "plant", "sweep"},
    r"(md5|sha2|sha512)\.h": {"base"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^">]+)[">]', re.M)


def room_folder(room):
    top = room in ("fmu", "fmu_detailed", "embedded", "tools")
    return ROOT / room if top else ROOT / "src" / room


def c_files(room):
    folder = room_folder(room)
    return sorted(f for f in folder.rglob("*") if f.suffix in (".c", ".h", ".def"))


def shown(path):
    return str(path.relative_to(ROOT))


@pytest.mark.parametrize("room", ARROWS)
def test_includes_follow_the_arrows(room):
    allowed = ARROWS[room] | {room}
    wrong = []
    for file in c_files(room):
        for kind, name in INCLUDE.findall(file.read_text()):
            target = name.split("/")[0] if "/" in name else None
            if kind == '"' and target in ARROWS and target not in allowed:
                wrong.append(f"{shown(file)} includes {name}")
    assert not wrong


def test_foreign_libraries_stay_in_their_rooms():
    wrong = []
    for room in [*ARROWS, "tools"]:
        for file in c_files(room):
            for kind, name in INCLUDE.findall(file.read_text()):
                for pattern, rooms in LIBRARIES.items():
                    if kind == "<" and re.match(pattern, name) and room not in rooms:
                        wrong.append(f"{shown(file)} includes {name}")
    assert not wrong


def test_core_and_fmu_include_siblings_by_bare_name():
    """In an FMU all sources lie in one folder."""
    wrong = [f"{shown(file)} includes {name}"
             for room in ("core", "fmu", "embedded") for file in c_files(room)
             for kind, name in INCLUDE.findall(file.read_text())
             if kind == '"' and "/" in name]
    assert not wrong


INCLUDE_PATH = [ROOT / "src", ROOT / "src" / "core", ROOT / "fmu", ROOT / "fmu" / "example",
                ROOT / "fmu_detailed", ROOT / "embedded", ROOT / "tools",
                Path(os.environ["GM_BINARY_DIR"]) / "share/gearmap/fmi2"]


def compile_alone(source, *options, standard="c11"):
    return subprocess.run(
        [CC, f"-std={standard}", "-D_POSIX_C_SOURCE=200809L",
         *(f"-I{folder}" for folder in INCLUDE_PATH), *options, source],
        capture_output=True, text=True)


@pytest.mark.parametrize("room", [*ARROWS, "tools"])
def test_headers_compile_alone(room, tmp_path):
    wrong = []
    for header in c_files(room):
        if header.suffix != ".h" or header.name == "gm_tables.h":  # data for one file
            continue
        unit = tmp_path / "unit.c"
        unit.write_text(f'#include "{header}"\ntypedef int gm_not_empty;\n')
        done = compile_alone(unit, "-fsyntax-only", "-Wall", "-Wextra", "-Werror")
        if done.returncode != 0:
            wrong.append(f"{shown(header)}: {done.stderr.splitlines()[0]}")
    assert not wrong


def symbols(obj):
    """(type, name) of every symbol of an object."""
    out = subprocess.run(["nm", "-P", obj], capture_output=True, text=True, check=True)
    return [(line.split()[1], line.split()[0]) for line in out.stdout.splitlines()]


def shipped_objects(room, folder, frame):
    """Symbols of a room's objects, compiled as a component is; no stack frame is larger
    than frame bytes."""
    objects = {}
    for source in sorted(room_folder(room).glob("*.c")):
        obj = folder / (source.stem + ".o")
        # -fno-pic: constants that hold addresses then count as the constants they are
        done = compile_alone(source, "-O2", "-ffp-contract=off", "-fno-stack-protector",
                             "-fno-pic", f"-Wframe-larger-than={frame}", "-Werror", "-c", "-o", obj,
                             standard="c99")
        assert done.returncode == 0, done.stderr
        objects[source.name] = symbols(obj)
    assert objects
    return objects


@pytest.fixture(scope="session")
def core_objects(tmp_path_factory):
    return shipped_objects("core", tmp_path_factory.mktemp("core"), 2048)


@pytest.fixture(scope="session")
def fmu_objects(tmp_path_factory):
    # a start keeps the state that was, to fall back on, beside the new one
    return shipped_objects("fmu", tmp_path_factory.mktemp("fmu"), 4096)


def test_core_calls_nothing_but_itself_and_memory_copies(core_objects):
    own = {name for table in core_objects.values() for kind, name in table if kind != "U"}
    allowed = own | {"memcpy", "memmove", "memset", "memcmp", "_GLOBAL_OFFSET_TABLE_"}
    wrong = [f"{source}: {name}" for source, table in core_objects.items()
             for kind, name in table if kind == "U" and name not in allowed]
    assert not wrong


def test_shipped_code_has_no_writable_data(core_objects, fmu_objects):
    wrong = [f"{source}: {name}"
             for source, table in [*core_objects.items(), *fmu_objects.items()]
             for kind, name in table if kind in "dDbBcCsSgG"
             and not name.startswith(".")]
    assert not wrong


def test_fmu_calls_no_operating_system(core_objects, fmu_objects):
    """Text, memory copies and the one allocation of an instance; no files, no time."""
    objects = {**core_objects, **fmu_objects}
    own = {name for table in objects.values() for kind, name in table if kind != "U"}
    allowed = own | {"memcpy", "memmove", "memset", "memcmp", "strcmp", "strncmp", "strlen",
                     "strcpy", "strncpy", "strncat", "strcat", "snprintf", "vsnprintf",
                     "calloc", "free", "_GLOBAL_OFFSET_TABLE_"}
    wrong = [f"{source}: {name}" for source, table in fmu_objects.items()
             for kind, name in table if kind == "U" and name not in allowed]
    assert not wrong


def test_core_prefixes_its_names(core_objects):
    wrong = [f"{source}: {name}" for source, table in core_objects.items()
             for kind, name in table if kind in "TDBR" and not name.startswith("gm_")]
    assert not wrong


def test_library_prefixes_its_names():
    archives = sorted(Path(os.environ["GM_BINARY_DIR"]).glob("src/lib*.a"))
    assert archives
    wrong = []
    for archive in archives:
        out = subprocess.run(["nm", "-P", "-g", "--defined-only", archive],
                             capture_output=True, text=True, check=True)
        names = [line.split()[:2] for line in out.stdout.splitlines()
                 if len(line.split()) > 1]
        wrong += [f"{archive.name}: {name}" for name, kind in names
                  if kind in "TDBR" and not name.startswith(("gm_", "__odr_asan.gm_"))]
    assert not wrong


SOURCES = ["*.c", "*.h", "*.def", "*.py", "*.sh", "*.cmake", "CMakeLists.txt"]
FOLDERS = ["src", "fmu", "fmu_detailed", "embedded", "tools", "tests", "bench", "examples",
           "cmake"]


def all_sources():
    files = [f for folder in FOLDERS for pattern in SOURCES
             for f in (ROOT / folder).rglob(pattern)]
    files += [ROOT / name for name in ("CMakeLists.txt", "quickstart.sh", "test.sh", ".ci/run")]
    return sorted(f for f in files if "__pycache__" not in f.parts)


def test_every_source_names_its_licence():
    wrong = [shown(f) for f in all_sources()
             if not any("SPDX-License-Identifier: BSD-2-Clause" in line
                        for line in f.read_text().splitlines()[:2])]
    assert not wrong


def test_lines_and_files_stay_short():
    wrong = []
    for file in all_sources():
        lines = file.read_text().splitlines()
        if file.suffix in (".c", ".h"):
            wrong += [f"{shown(file)}:{i}: {len(line)} columns"
                      for i, line in enumerate(lines, 1) if len(line) > 90]
        if file.suffix in (".c", ".h", ".py") and len(lines) > 500:
            wrong.append(f"{shown(file)}: {len(lines)} lines")
    assert not wrong


def test_functions_stay_short():
    """A function's body starts and ends with a brace in the first column."""
    wrong = []
    for file in (f for room in [*ARROWS, "tools"] for f in c_files(room)):
        start = None
        for i, line in enumerate(file.read_text().splitlines(), 1):
            if line == "{":
                start = i
            elif line == "}" and start is not None:
                if i - start + 1 > 60:
                    wrong.append(f"{shown(file)}:{start}: {i - start + 1} lines")
                start = None
    assert not wrong


@pytest.mark.parametrize("room", [*ARROWS, "tools"])
def test_build_lists_every_source(room):
    folder = room_folder(room)
    listed = set(re.findall(r"[\w.-]+\.c\b", (folder / "CMakeLists.txt").read_text()))
    present = {f.name for f in folder.glob("*.c")}
    assert present <= listed, f"not built: {present - listed}"
    missing = {name for name in listed - present
               if not any((ROOT / "src").rglob(name)) and not any((ROOT / "fmu").rglob(name))}
    assert not missing


def test_build_lists_every_test():
    wrong = []
    for file in sorted((ROOT / "tests").glob("*/test_*.c")):
        lists = (file.parent / "CMakeLists.txt").read_text()
        name = file.stem.removeprefix("test_")  # some lists name what follows the prefix
        if not re.search(rf"\b(test_)?{name}\b", lists):
            wrong.append(shown(file))
    for file in sorted((ROOT / "tests").glob("*/test_*.py")):
        if file.parent.name in ("importers", "embedded"):
            continue  # not part of the build: needs what its run.sh installs
        lists = (file.parent / "CMakeLists.txt").read_text()
        if file.name not in lists and file.parent.name not in lists and "pytest" not in lists:
            wrong.append(shown(file))
    assert not wrong


def test_tools_are_not_included_by_the_library():
    wrong = [f"{shown(file)} includes {name}" for room in ARROWS for file in c_files(room)
             for kind, name in INCLUDE.findall(file.read_text())
             if kind == '"' and (ROOT / "tools" / name).exists()
             and not (file.parent / name).exists()]
    assert not wrong
