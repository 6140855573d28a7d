# SPDX-License-Identifier: BSD-2-Clause
"""Arguments: what is accepted, what is refused and in which words."""

import os
import re
import subprocess

import pytest
from conftest import EXAMPLE, PROGRAM, ROOT, fails, gearmap, succeeds

COMMANDS = ["check", "sweep", "bake", "reduce", "verify", "simulate", "batch", "rig"]
VERSION = (ROOT / "VERSION").read_text().strip()


def test_version():
    assert succeeds("--version").stdout == f"gearmap {VERSION}\n"


def test_without_a_command_the_overview_goes_to_stderr():
    done = gearmap()
    assert done.returncode == 2
    assert done.stdout == ""
    assert all(f"  {name} " in done.stderr for name in COMMANDS)


def test_help_names_every_command():
    for arguments in (["--help"], ["help"], ["-h"]):
        text = succeeds(*arguments).stdout
        assert all(f"  {name} " in text for name in COMMANDS)
        assert "gearmap help format" in text


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_a_command_is_the_same_both_ways(command):
    text = succeeds(command, "--help").stdout
    assert text == succeeds("help", command).stdout
    assert text.startswith(f"usage: gearmap {command} ")
    assert max(len(line) for line in text.splitlines()) <= 80


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_in_the_help_is_accepted(command):
    """The help and the reader use one table: an option of the help is never unknown."""
    text = succeeds(command, "--help").stdout
    options = sorted(set(re.findall(r"--[a-z][a-z-]*", text)) - {"--help"})
    assert "--json" in options
    for option in options:
        done = gearmap(command, option)
        assert done.returncode == 2
        assert "has no option" not in done.stderr


def test_help_of_the_description_format_has_every_key_of_the_example():
    text = succeeds("help", "format").stdout
    keys = set(re.findall(r"\b([a-z][a-z0-9]*(?:_[A-Za-z0-9]+)+):", EXAMPLE.read_text()))
    units = {k for k in keys if k.endswith(("_mm", "_deg", "_Nm", "_kgm2", "_mm2_s"))}
    assert len(units) > 10
    assert not [k for k in sorted(units) if k not in text]


def test_quantities_name_their_unit():
    text = succeeds("sweep", "--help").stdout
    assert "--speed-step SPEED" in text and "[rpm]" in text
    assert "[Nm]" in text and "[degC]" in text


@pytest.mark.parametrize("arguments, sentence", [
    (["swep"], "there is no command 'swep', did you mean sweep?"),
    (["dance"], "there is no command 'dance' (see gearmap --help)"),
    (["--json"], "the command comes first (see gearmap --help)"),
    (["help", "swep"], "there is no command 'swep', did you mean sweep?"),
    (["sweep"], "sweep needs FILE: the description of the gearset"),
    (["sweep", "a.yaml"], "sweep needs --output: the map to write"),
    (["sweep", "a.yaml", "-o"], "sweep: --output needs a value"),
    (["sweep", "a.yaml", "b.yaml", "-o", "m"],
     "sweep has no use for the argument 'b.yaml'"),
    (["sweep", "a.yaml", "-o", "m", "-o", "n"], "sweep: --output is given twice"),
    (["sweep", "a.yaml", "-o", "m", "--sped-step", "1"],
     "sweep has no option --sped-step, did you mean --speed-step?"),
    (["sweep", "a.yaml", "-o", "m", "--colour=red"],
     "sweep has no option --colour (see gearmap help sweep)"),
    (["sweep", "a.yaml", "-o", "m", "-x"], "sweep has no option -x (see gearmap help sweep)"),
    (["sweep", "a.yaml", "-o", "m", "--json=yes"], "sweep: --json takes no value"),
    (["sweep", "a.yaml", "-o", ""], "sweep: --output is empty"),
    (["sweep", "a.yaml", "-o", "m", "--speed-step", "150Nm"],
     "--speed-step needs a number in rpm (such as 100rpm), not '150Nm'"),
    (["sweep", "a.yaml", "-o", "m", "--speed-step", "1o0"],
     "--speed-step needs a number in rpm (such as 100rpm), not '1o0'"),
    (["sweep", "a.yaml", "-o", "m", "--speed-step", "nan"],
     "--speed-step needs a number in rpm (such as 100rpm), not 'nan'"),
    (["sweep", "a.yaml", "-o", "m", "--speed-step", "-150"],
     "--speed-step -150 is not between 1rpm and 100000rpm"),
    (["sweep", "a.yaml", "-o", "m", "--torque-step=0"],
     "--torque-step 0 is not between 0.1Nm and 100000Nm"),
    (["sweep", "a.yaml", "-o", "m", "--oil-temperature", "900degC"],
     "--oil-temperature 900degC is not between -50degC and 200degC"),
    (["sweep", "a.yaml", "-o", "m", "--threads", "two"],
     "--threads needs a whole number, not 'two'"),
    (["sweep", "a.yaml", "-o", "m", "--threads", "0"],
     "--threads 0 is not between 1 and 1024"),
    (["verify", "a.yaml", "f.fmu", "--steady", "--points", "100000000"],
     "--points 100000000 is not between 1 and 10000000"),
    (["help", "check", "extra"], "help has no use for the argument 'extra'"),
    (["bake", "m", "-o", "f", "--format", "elf"], "bake knows no format 'elf' (only fmu2, c)"),
    (["bake", "m", "-o", "f", "--speed-in", "output", "--format", "c"],
     "--speed-in is for FMUs of maps"),
    (["bake", "a.yaml", "-o", "f", "--speed-in", "output", "--detailed"],
     "--speed-in is for FMUs of maps"),
    (["verify", "a.yaml", "f.fmu"],
     "verify needs --steady, --cycle CYCLE or both"),
    (["check", "a.yaml", "--gear", "0", "--speed", "1000", "--torque", "1"],
     "an operating point needs a gear; 0 is neutral"),
    (["check", "a.yaml", "--gear", "1", "--speed", "0", "--torque", "1"],
     "an operating point needs a speed other than 0"),
    (["check", "a.yaml", "--preselect", "4"],
     "--preselect belongs to an operating point (--gear)"),
])
def test_wrong_usage(arguments, sentence, tmp_path):
    assert fails(*arguments, code=2, cwd=tmp_path) == sentence
    assert list(tmp_path.iterdir()) == []


def test_help_wins_over_wrong_arguments():
    assert succeeds("sweep", "--nonsense", "--help").stdout.startswith("usage:")


def test_help_is_not_taken_from_a_value(tmp_path):
    for arguments in (["-o", "-h"], ["--output", "--help"]):
        assert "none.yaml" in fails("sweep", "none.yaml", *arguments, cwd=tmp_path)


@pytest.mark.parametrize("option, value, sentence", [
    ("--speed-step", "7000", "--speed-step 7000 rpm is more than the maximum, 6500 rpm"),
    ("--torque-step", "300", "--torque-step 300 Nm is more than the maximum, 250 Nm")])
def test_a_step_beyond_the_axis(option, value, sentence, tmp_path):
    assert fails("sweep", EXAMPLE, "-o", tmp_path / "a.map", option, value) == sentence
    assert list(tmp_path.iterdir()) == []


def test_units_are_read_in_every_spelling():
    point = ["check", EXAMPLE, "--gear", "3", "--torque", "50"]
    expected = succeeds(*point, "--speed", "2000").stdout
    for text in ("2000rpm", "2000 rpm", "2e3rpm", "209.43951023931953rad/s"):
        assert succeeds(*point, f"--speed={text}").stdout == expected


def test_options_may_follow_or_precede_operands():
    a = succeeds("check", EXAMPLE, "--json").stdout
    assert a == succeeds("check", "--json", EXAMPLE).stdout
    assert a == succeeds("check", "--json", "--", EXAMPLE).stdout


def test_a_full_disk_behind_stdout_is_a_failure():
    with open("/dev/full", "w") as full:
        done = subprocess.run([PROGRAM, "--help"], stdout=full, stderr=subprocess.PIPE,
                              text=True, env=os.environ)
    assert done.returncode == 1
    assert done.stderr == "gearmap: the standard output could not be written\n"
