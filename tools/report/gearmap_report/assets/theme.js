/* SPDX-License-Identifier: BSD-2-Clause
 * Figures take the colours of the page. */

function pageColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/* What of a layout depends on the theme, as for Plotly.relayout. */
function themeOf(layout) {
  const changes = {
    "font.color": pageColour("--ink"),
    "hoverlabel.bgcolor": pageColour("--paper"),
    "hoverlabel.font.color": pageColour("--ink"),
    "hoverlabel.bordercolor": pageColour("--line"),
    "modebar.bgcolor": "rgba(0,0,0,0)",
    "modebar.color": pageColour("--soft"),
    "modebar.activecolor": pageColour("--accent"),
  };
  for (const key of Object.keys(layout)) {
    if (/^[xy]axis/.test(key)) {
      changes[key + ".gridcolor"] = pageColour("--grid");
      changes[key + ".linecolor"] = pageColour("--line");
      changes[key + ".tickcolor"] = pageColour("--line");
    }
  }
  return changes;
}

function paintFigures() {
  for (const div of drawnFigures()) Plotly.relayout(div, themeOf(div.layout));
}

function setTheme(name) {
  if (name === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = name;
}

function startTheme() {
  const select = document.getElementById("theme");
  select.addEventListener("change", () => {
    setTheme(select.value);
    paintFigures();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paintFigures);
}
