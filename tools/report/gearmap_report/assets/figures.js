/* SPDX-License-Identifier: BSD-2-Clause
 * Draws the figures, one after the other, without holding up the page. */

const CONFIG = {
  responsive: true,
  displaylogo: false,
  modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
  toImageButtonOptions: { format: "svg" },
};

function drawnFigures() {
  return [...document.querySelectorAll(".plot")].filter((div) => div.layout);
}

/* "a.b.c": value into an object of objects. */
function put(target, path, value) {
  const names = path.split(".");
  const last = names.pop();
  for (const name of names) target = target[name] = target[name] || {};
  target[last] = value;
}

function narrow() {
  return window.innerWidth < 640;
}

/* On a narrow screen a finger scrolls the page, titles take less room, and the legend
 * stands in lines of its own above the figure. */
function fitScreen(div, layout, data) {
  if (!narrow()) return;
  const names = new Set(data.filter((t) => t.name && t.visible === true &&
    t.showlegend !== false && layout.showlegend !== false).map((t) => t.name));
  layout.height += 19 * Math.max(0, names.size - 2);
  div.style.height = layout.height + "px";
  layout.dragmode = false;
  layout.margin = { ...layout.margin, l: 44, t: 16 };
  layout.font.size = 11;
  for (const trace of data)
    if (trace.colorbar)
      trace.colorbar = {
        ...trace.colorbar, orientation: "h", x: 0.5, y: -0.2, yanchor: "top", len: 1,
        thickness: 10, title: { ...trace.colorbar.title, side: "bottom",
          text: trace.colorbar.title.text.replace("<br>", " ") },
      };
}

async function draw(div) {
  const { data, layout } = JSON.parse(document.getElementById(div.id + "-data").textContent);
  for (const [path, value] of Object.entries(themeOf(layout))) put(layout, path, value);
  showChosen(div.id, data);
  fitScreen(div, layout, data);
  if (div.dataset.kind === "timeline") prepareTimeline(data, layout);
  await Plotly.newPlot(div, data, layout, narrow() ? { ...CONFIG, displayModeBar: false } : CONFIG);
  if (div.dataset.kind === "timeline") listenToTimeline(div);
  // the figure's label stands for what is drawn; the buttons beside it stay
  for (const drawn of div.querySelectorAll(".main-svg")) drawn.ariaHidden = "true";
}

function breathe() {
  return new Promise((done) => setTimeout(done, 0));
}

async function drawAll() {
  for (const div of document.querySelectorAll(".plot")) {
    await draw(div);
    await breathe();
  }
}
