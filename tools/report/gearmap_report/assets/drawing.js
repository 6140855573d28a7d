/* SPDX-License-Identifier: BSD-2-Clause
 * The power flow of the chosen gear in the drawings. */

function showFlow(gear) {
  for (const part of document.querySelectorAll("[data-on]"))
    part.classList.toggle("on", part.dataset.on.split(" ").includes(gear));
  for (const part of document.querySelectorAll(".flow, .flow-words"))
    part.classList.toggle("shown", part.dataset.gear === gear);
}

function startDrawing() {
  const group = document.getElementById("flow-choice");
  if (!group) return;
  const show = () => showFlow(group.querySelector(":checked").value);
  group.addEventListener("change", show);
  show();
}
