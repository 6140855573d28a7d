# SPDX-License-Identifier: BSD-2-Clause
"""docs/report.png: parts of a page of `gearmap report`, as Chromium shows them.

    python docs/report_picture.py build/dct7.html docs/report.png

Needs Chromium, and websocket-client (tests/report/requirements.txt); pngquant, where it is
there, makes the file smaller.
"""
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "report"))
from browser import Browser  # noqa: E402

STYLE = """
  main > div { display: contents; } main { display: grid; grid-template-columns: 1fr 1fr;
  gap: 14px; max-width: none; padding: 14px; } nav, footer, .lead, .look { display: none; }
  .theme { display: none; } header { max-width: none; padding: 18px 20px 6px; } section { margin: 0; }
  section:not(#layout, #one-gear, #parts, #same-torque) { display: none; }
  #one-gear > p, #one-gear > h3 { display: none; } .flow { animation: none !important; }
  .drawings { grid-template-columns: 1fr !important; } .drawings figure:last-child,
  .modebar-container, .drawings figcaption { display: none; } .timelines { display: contents; }
"""
SHOW = """(async () => {
  const style = document.createElement('style'); style.textContent = %r;
  document.head.append(style);
  document.querySelector('#flow-choice [value="3"]').click();
  document.querySelector('[data-figure="loss-map"] [value="3"]').click();
  showRange(132.6, 136.2);
  dispatchEvent(new Event('resize'));
  for (const div of drawnFigures()) await Plotly.Plots.resize(div).catch(() => 0);
  await new Promise((done) => setTimeout(done, 1000));
})()""" % STYLE


def main(page, picture):
    with Browser() as browser:
        browser.open(page, width=1500)
        browser.run(SHOW)
        browser.picture(picture)
    if shutil.which("pngquant"):
        subprocess.run(["pngquant", "64", "--force", "--output", picture, picture],
                       check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
