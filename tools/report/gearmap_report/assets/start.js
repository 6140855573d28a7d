/* SPDX-License-Identifier: BSD-2-Clause
 * First what needs no figures, so that the first view is there at once. */

async function start() {
  startDrawing();
  startTheme();
  startChoices();
  startTimelines();
  startPrint();
  await breathe();
  await loadPlotly();
  await loadSeries();
  await drawAll();
  document.documentElement.dataset.drawn = "all";
}

start();
