# SPDX-License-Identifier: BSD-2-Clause
"""What a second thread costs and gains in a sweep: processor time and wall time with one
and with two threads, medians of several runs taken in turn, and the content hashes.

    python3 bench/sweep_threads.py build/gearmap [description [runs [option ...]]]
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def run(program, description, threads, options, folder):
    """Wall time, processor time, content hash."""
    start, before = time.monotonic(), os.times()
    done = subprocess.run(
        [program, "sweep", description, "-o", f"{folder}/m.map", "--threads", str(threads),
         "--json", *options], capture_output=True, text=True, check=True)
    wall, after = time.monotonic() - start, os.times()
    cpu = (after.children_user + after.children_system
           - before.children_user - before.children_system)
    return wall, cpu, json.loads(done.stdout)["content_hash"]


def main():
    program = sys.argv[1]
    description = sys.argv[2] if len(sys.argv) > 2 else ROOT / "examples" / "dct7.yaml"
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 7
    options = sys.argv[4:] or ["--speed-step", "40rpm", "--torque-step", "5Nm"]
    times = {1: [], 2: []}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(runs):
            for threads in times:
                times[threads].append(run(program, description, threads, options, folder))
    wall = {n: statistics.median(t[0] for t in times[n]) for n in times}
    cpu = {n: statistics.median(t[1] for t in times[n]) for n in times}
    hashes = {t[2] for n in times for t in times[n]}
    print(f"load {os.getloadavg()[0]:.1f}, options {' '.join(options)}")
    for n in times:
        print(f"{n} thread{'s' * (n > 1)}  wall {wall[n]:7.3f} s  cpu {cpu[n]:7.3f} s")
    print(f"wall 1/2 {wall[1] / wall[2]:.2f}, cpu growth {100 * (cpu[2] / cpu[1] - 1):.1f} %, "
          f"{'one hash' if len(hashes) == 1 else 'DIFFERENT HASHES'}")
    return len(hashes) != 1


if __name__ == "__main__":
    sys.exit(main())
