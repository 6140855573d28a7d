/* SPDX-License-Identifier: BSD-2-Clause
 * Radio buttons of a figure: a trace shows when all that its meta says is chosen. */

function chosenOf(id) {
  const chosen = {};
  for (const group of document.querySelectorAll(`fieldset[data-figure="${id}"]`))
    chosen[group.dataset.key] = group.querySelector(":checked").value;
  return chosen;
}

function fits(trace, chosen) {
  return Object.entries(trace.meta || {}).every(
    ([key, value]) => !(key in chosen) || chosen[key] === value);
}

function showChosen(id, traces) {
  const chosen = chosenOf(id);
  for (const trace of traces) trace.visible = fits(trace, chosen);
}

function choose(group) {
  const div = document.getElementById(group.dataset.figure);
  if (!div.layout) return;
  if (group.dataset.key === "scale") {
    const scale = chosenOf(div.id).scale;
    Plotly.relayout(div, { "yaxis.type": scale, "yaxis.autorange": true,
      "yaxis.dtick": scale === "log" ? 1 : null });
    return;
  }
  const chosen = chosenOf(div.id);
  Plotly.restyle(div, { visible: div.data.map((trace) => fits(trace, chosen)) });
  if (div.dataset.kind === "timeline") fillTimeline(div);
}

function startChoices() {
  for (const group of document.querySelectorAll("fieldset[data-figure]"))
    group.addEventListener("change", () => choose(group));
}
