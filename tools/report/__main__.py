# SPDX-License-Identifier: BSD-2-Clause
"""`gearmap report`: OUTPUT MAP [RESULT...], started by the command."""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
PACKAGES = ("pandas", "plotly")


def missing_packages():
    import importlib.util
    return [name for name in PACKAGES if importlib.util.find_spec(name) is None]


def main():
    if sys.version_info < (3, 9):
        sys.exit("gearmap: the report needs Python 3.9 or newer, %s is %d.%d"
                 % (sys.executable, *sys.version_info[:2]))
    missing = missing_packages()
    if missing:
        sys.exit("gearmap: the report needs the Python packages %s: %s -m pip install -r %s"
                 % (" and ".join(missing), sys.executable, HERE / "requirements.txt"))
    from gearmap_report.command import run
    run(sys.argv[1], sys.argv[2], sys.argv[3:])


if __name__ == "__main__":
    main()
