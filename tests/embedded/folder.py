# SPDX-License-Identifier: BSD-2-Clause
"""A folder of plain C that was baked: its programs on the host, on aarch64 and on an
emulated Cortex-M4F, and the folder as a library."""

import ctypes
import re
import struct
import subprocess
from pathlib import Path

HERE = Path(__file__).parent

M4 = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard",
      "-mfpu=fpv4-sp-d16"]
COMPILER = {"host": ["gcc"], "aarch64": ["aarch64-linux-gnu-gcc", "-static"], "m4": M4}
COMMON = ["-std=c99", "-O2", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections"]
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion",
          "-Wdouble-promotion", "-Wmissing-prototypes", "-Wstrict-prototypes", "-Wvla",
          "-Werror"]
M4_LINK = ["--specs=rdimon.specs", "-T", HERE / "m4" / "mps2.ld", HERE / "m4" / "start.c"]


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True,
                          **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def qemu(program, *arguments):
    """Runs on the emulated Cortex-M4F with a clock that counts instructions."""
    words = "".join(f",arg={a}" for a in (program.stem, *arguments))
    return run("qemu-system-arm", "-M", "mps2-an386", "-icount",
               "shift=6,align=off,sleep=off", "-semihosting-config",
               f"enable=on,target=native{words}", "-nographic", "-monitor", "none",
               "-serial", "none", "-kernel", program)


class Folder:
    VALUES = ["output.w", "odd.w", "even.w", "output.phi", "odd.twist", "even.twist",
              "work", "loss_energy", "output.inertia", "output.a", "loss_power"]

    def __init__(self, path):
        self.path = Path(path)
        self.include = [f"-I{self.path}", f"-I{self.path / 'core'}", f"-I{HERE}"]

    def sources(self, tables=True):
        own = ["gm_gearset.c"] + (["gm_tables.c"] if tables else [])
        return [self.path / name for name in own] + sorted((self.path / "core").glob("*.c"))

    def build(self, target, program, *options):
        """Compiles program.c of this folder with the gearset; returns the executable."""
        out = self.path / f"{program}-{target}{'-'.join(options).replace('/', '')}"
        if not out.exists():
            run(*COMPILER[target], *COMMON, *options, *self.include, HERE / f"{program}.c",
                *self.sources(), *(M4_LINK if target == "m4" else []), "-Wl,--gc-sections",
                "-o", out)
        return out

    def execute(self, target, program, *arguments):
        out = self.build(target, program)
        if target == "m4":
            return qemu(out, *arguments)
        return run(*(["qemu-aarch64"] if target == "aarch64" else []), out, *arguments)

    # as a library, with the names of the FMU's variables

    def start(self, values, fidelity=1, gears=(0, 0)):
        out = self.path / "shim.so"
        if not out.exists():
            run("gcc", *COMMON, "-shared", "-fPIC", *self.include, HERE / "shim.c",
                *self.sources(), "-o", out)
        self.library = ctypes.CDLL(str(out))
        self.library.shim_get.restype = ctypes.c_double
        self.library.shim_step.argtypes = [ctypes.c_double, ctypes.c_int]
        self.library.shim_set.argtypes = [ctypes.c_double] * 3 + [ctypes.c_int] * 2
        self.library.shim_start.argtypes = [ctypes.c_int, ctypes.c_double] \
            + [ctypes.c_int] * 2
        return self.library.shim_start(fidelity, values.get("output.w_start", 0.0), *gears)

    def get(self, name):
        return self.library.shim_get(self.VALUES.index(name))

    def set(self, inputs):
        self.library.shim_set(inputs["odd.tau"], inputs["even.tau"], inputs["output.tau"],
                              inputs["odd.gear"], inputs["even.gear"])

    def step(self, h, n):
        return self.library.shim_step(h, n)


def write_records(path, rows, steps):
    """rows: [(time, inputs)], each held for so many steps; see records.h."""
    with open(path, "wb") as file:
        for _, i in rows:
            file.write(struct.pack("<3i3f", steps, i["odd.gear"], i["even.gear"],
                                   i["odd.tau"], i["even.tau"], i["output.tau"]))


def measured():
    """The numbers that the README of every folder states: src/bake/c_measured.h."""
    text = (HERE.parents[1] / "src/bake/c_measured.h").read_text()
    return {name.lower(): int(value)
            for name, value in re.findall(r"#define GM_MEASURED_(\w+) (\d+)", text)}
