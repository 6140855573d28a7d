/* SPDX-License-Identifier: BSD-2-Clause
 * On paper: light, and every figure as wide as a page. */

const PAPER = 670; // px between the margins of a sheet of A4, and of US letter
const LOWER = 0.8; // heights, so that two questions fit on a sheet

function toPaper() {
  setTheme("light");
  for (const div of drawnFigures()) {
    div.dataset.height = div.offsetHeight;
    const height = LOWER * div.offsetHeight;
    div.style.height = height + "px";
    Plotly.relayout(div, { ...themeOf(div.layout), width: PAPER, height });
  }
}

function toScreen(theme) {
  setTheme(theme);
  for (const div of drawnFigures()) {
    div.style.height = div.dataset.height + "px";
    Plotly.relayout(div, { ...themeOf(div.layout), autosize: true });
  }
}

function startPrint() {
  const select = document.getElementById("theme");
  addEventListener("beforeprint", toPaper);
  addEventListener("afterprint", () => toScreen(select.value));
}
