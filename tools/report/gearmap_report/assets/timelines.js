/* SPDX-License-Identifier: BSD-2-Clause
 * Lines over time. The page holds every sample as 16 bits; what is drawn is the smallest
 * and the largest of each column of the screen, so a zoom shows more. All figures over
 * time show the same range. */

const COLUMNS = 700;
let facts = null; // n, step, series: {name: [block, lowest, scale]}
let blocks = null; // bytes of all series
const known = new Map(); // name -> Float32Array
let range = null; // s

async function loadSeries() {
  const holder = document.getElementById("series-facts");
  if (!holder) return;
  facts = JSON.parse(holder.textContent);
  blocks = await unpack("series");
  range = [0, (facts.n - 1) * facts.step];
}

function samplesOf(name) {
  if (!known.has(name)) {
    const [block, lowest, scale] = facts.series[name];
    const steps = new Uint16Array(blocks, 2 * block * facts.n, facts.n);
    const values = new Float32Array(facts.n);
    let level = 0;
    for (let i = 0; i < facts.n; i++) {
      level = (level + steps[i]) & 65535;
      values[i] = lowest + scale * level;
    }
    known.set(name, values);
  }
  return known.get(name);
}

/* Samples from..to, thinned to columns that keep their extremes. */
function viewOf(values, from, to) {
  const x = [], y = [];
  const add = (i) => { x.push(i * facts.step); y.push(values[i]); };
  const wide = (to - from) / COLUMNS;
  if (wide <= 2) {
    for (let i = from; i <= to; i++) add(i);
    return { x, y };
  }
  for (let c = 0; c < COLUMNS; c++) {
    const begin = Math.floor(from + c * wide), end = Math.min(to, Math.floor(from + (c + 1) * wide));
    let low = begin, high = begin;
    for (let i = begin; i < end; i++) {
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
    add(Math.min(low, high));
    if (low !== high) add(Math.max(low, high));
  }
  return { x, y };
}

function fillTraces(traces) {
  const from = Math.max(0, Math.floor(range[0] / facts.step) - 1);
  const to = Math.min(facts.n - 1, Math.ceil(range[1] / facts.step) + 1);
  for (const trace of traces)
    if (trace.visible === true) Object.assign(trace, viewOf(samplesOf(trace.meta.series), from, to));
}

/* Time is zoomed alone; heights follow what is seen. */
function prepareTimeline(data, layout) {
  layout.xaxis.range = [...range];
  for (const key of Object.keys(layout)) if (/^yaxis/.test(key)) layout[key].fixedrange = true;
  fillTraces(data);
}

function fillTimeline(div) {
  fillTraces(div.data);
  div.layout.xaxis.range = [...range];
  div.layout.xaxis.autorange = false;
  Plotly.redraw(div);
}

function showRange(from, to) {
  const end = (facts.n - 1) * facts.step;
  const width = Math.max(10 * facts.step, Math.min(end, to - from));
  const start = Math.max(0, Math.min(end - width, from));
  range = [start, start + width];
  for (const div of drawnFigures()) if (div.dataset.kind === "timeline") fillTimeline(div);
}

function listenToTimeline(div) {
  div.on("plotly_relayout", (change) => {
    if ("xaxis.range[0]" in change) showRange(change["xaxis.range[0]"], change["xaxis.range[1]"]);
    else if (change["xaxis.autorange"]) showRange(0, Infinity);
  });
}

const MOVES = {
  in: (a, b) => [a + (b - a) / 4, b - (b - a) / 4],
  out: (a, b) => [a - (b - a) / 2, b + (b - a) / 2],
  left: (a, b) => [a - (b - a) / 2, b - (b - a) / 2],
  right: (a, b) => [a + (b - a) / 2, b + (b - a) / 2],
};

function startTimelines() {
  const look = document.getElementById("look");
  if (!look) return;
  look.addEventListener("change", () => showRange(...look.value.split(",").map(Number)));
  for (const button of document.querySelectorAll("[data-move]"))
    button.addEventListener("click", () => showRange(...MOVES[button.dataset.move](...range)));
}
