# SPDX-License-Identifier: BSD-2-Clause
"""Nothing is lost: kill -9 at any moment and a full disk cost no finished point, and the
same command goes on to the same map.

GM_KILLS: how many random moments to kill at (10); GM_KILLS_SEED: of the moments (1).
"""

import os
import random
import resource
import signal
import subprocess
import time
from pathlib import Path

import pytest
from conftest import EXAMPLE, PROGRAM, ROOT, result_of

KILLS = int(os.environ.get("GM_KILLS", "10"))
SEED = int(os.environ.get("GM_KILLS_SEED", "1"))
SMALL = ROOT / "tests" / "cli" / "two_speed.yaml"
# short enough for many runs, long enough to be hit everywhere
SWEEPS = {
    "by error": [SMALL, "--tolerance", "0.1%"],
    "by error, cubics": [SMALL, "--tolerance", "0.05%", "--interpolation", "monotone"],
    "steps": [SMALL, "--speed-step", "50rpm", "--torque-step", "4Nm"],
    "two paths": [EXAMPLE, "--tolerance", "2%"],
    "oil axis, steps": [SMALL, "--speed-step", "200rpm", "--torque-step", "8Nm",
                        "--oil-temperature", "-10,20,60,100"],
}


def sweep(arguments, path, **options):
    return subprocess.Popen(
        [PROGRAM, "sweep", *map(str, arguments), "-o", path], stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


@pytest.mark.parametrize("kind", SWEEPS)
def test_killed_at_random_moments(kind, tmp_path):
    arguments, path = SWEEPS[kind], tmp_path / "m.map"
    start = time.monotonic()
    whole = result_of("sweep", *arguments, "-o", tmp_path / "whole.map")
    duration = time.monotonic() - start
    bytes_of_whole = (tmp_path / "whole.map").read_bytes()
    dice = random.Random(SEED)
    killed = resumed = 0
    for k in range(max(1, KILLS // len(SWEEPS))):
        threads = ["--threads", str(dice.randint(1, 3))]
        process = sweep([*arguments, *threads], path)
        time.sleep(dice.uniform(0.0, duration))
        process.kill()
        process.communicate(timeout=60)
        killed += process.returncode == -signal.SIGKILL
        result = result_of("sweep", *arguments, "-o", path)
        resumed += result["resumed"] > 0
        assert result["content_hash"] == whole["content_hash"]
        if process.returncode == -signal.SIGKILL:
            assert result["points"] + result["resumed"] == whole["points"]
        assert {p.name for p in tmp_path.iterdir()} == {"m.map", "whole.map"}
        if "steps" in kind:  # no measured errors beside: the file too is the same
            assert path.read_bytes() == bytes_of_whole
        path.unlink()
    print(f"{kind}: {killed} killed, {resumed} of them resumed something")


def full_disk(arguments, path, limit):
    """Files may not grow beyond the limit; write() then fails as on a full disk."""
    def limit_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    process = sweep(arguments, path, preexec_fn=limit_files)
    out, err = process.communicate(timeout=300)
    return process.returncode, out, err


@pytest.mark.parametrize("kind", ["by error", "steps"])
@pytest.mark.parametrize("limit", [20_000, 150_000, 700_000])
def test_a_full_disk_costs_nothing(kind, limit, tmp_path):
    arguments, path = SWEEPS[kind], tmp_path / "m.map"
    code, out, err = full_disk(arguments, path, limit)
    whole = result_of("sweep", *arguments, "-o", tmp_path / "whole.map")
    if code == 0:  # it fitted
        assert limit > 300_000
    else:
        assert code == 1 and out == ""
        assert len(err.splitlines()) == 1 and err.startswith("gearmap: ")
        assert str(path) in err
        assert not path.exists()
    result = result_of("sweep", *arguments, "-o", path)
    assert result["content_hash"] == whole["content_hash"]
    if code != 0:
        assert result["points"] + result["resumed"] == whole["points"]
    if code != 0 and limit >= 150_000:
        assert result["resumed"] > 0
    assert {p.name for p in tmp_path.iterdir()} == {"m.map", "whole.map"}


def mounted(folder, size):
    return subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", folder],
                          capture_output=True).returncode == 0


def test_a_small_file_system_that_is_full(tmp_path):
    """The real thing, where the tests may mount."""
    disk = tmp_path / "disk"
    disk.mkdir()
    if os.geteuid() != 0 or not mounted(disk, "200k"):
        pytest.skip("a file system can be mounted by root only")
    try:
        arguments, path = SWEEPS["by error"], disk / "m.map"
        process = sweep(arguments, path)
        out, err = process.communicate(timeout=300)
        assert process.returncode == 1 and out == ""
        assert len(err.splitlines()) == 1 and "no space is left" in err and str(path) in err
        subprocess.run(["mount", "-o", "remount,size=50m", disk], check=True)
        result = result_of("sweep", *arguments, "-o", path)
        whole = result_of("sweep", *arguments, "-o", tmp_path / "whole.map")
        assert result["resumed"] > 0
        assert result["points"] + result["resumed"] == whole["points"]
        assert result["content_hash"] == whole["content_hash"]
        assert [p.name for p in Path(disk).iterdir()] == ["m.map"]
    finally:
        subprocess.run(["umount", disk], check=True)
