# SPDX-License-Identifier: BSD-2-Clause
"""Sweeps random valid variations of the example and counts points without a solution.

    python3 bench/sweep_variations.py build/gearmap 200 1

All dimensions and friction parameters vary by 20 %, tooth counts by 2
(tests/variations.py). Every sweep must solve every point.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main():
    command, count, seed = Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
    points, failed = 0, []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, ROOT / "tests" / "variations.py", folder, count, seed],
                       check=True, stdout=subprocess.DEVNULL)
        for path in sorted(Path(folder).glob("*.yaml")):
            done = subprocess.run([command, "sweep", path, "-o", path.with_suffix(".map"),
                                   "--json"], capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL)
            if done.returncode == 0:
                points += json.loads(done.stdout)["points"]
            else:
                failed.append(f"{path.name}: {done.stderr.strip()}")
            path.with_suffix(".map").unlink(missing_ok=True)
    print(f"{count} variations, {points} steady points solved, {len(failed)} sweeps failed")
    for line in failed:
        print(line)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
