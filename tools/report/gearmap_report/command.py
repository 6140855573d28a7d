# SPDX-License-Identifier: BSD-2-Clause
"""From files to the page, written as a whole or not at all."""
import os
import sys
from pathlib import Path

from .errors import ReportError
from .gearset import read_gearset
from .map_file import read_map
from .results import read_results


def write(path, text):
    """Under a name of its own first, so that a page is never half there."""
    own = Path("%s.%d.new" % (path, os.getpid()))
    try:
        own.write_text(text, encoding="utf-8")
        os.replace(own, path)
    except OSError as error:
        own.unlink(missing_ok=True)
        raise ReportError("%s: cannot be written: %s" % (path, error.strerror)) from None


def run(output, map_path, result_paths):
    try:
        data = read_map(map_path)
        results = read_results(result_paths, data)
        gearset = read_gearset(data)
        from . import page  # late: what is wrong with the input is told before Plotly loads
        text = page.make(data, gearset, results)
        write(output, text)
    except ReportError as error:
        sys.exit("gearmap: %s" % error)
    size = os.path.getsize(output) / 1e6
    print("report  %s, %.1f MB: open it in a browser" % (output, size))
