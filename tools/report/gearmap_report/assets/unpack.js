/* SPDX-License-Identifier: BSD-2-Clause
 * Large blocks of the page are base64 of gzip. */
"use strict";

async function unpack(id) {
  const packed = atob(document.getElementById(id).textContent);
  const bytes = Uint8Array.from(packed, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function loadPlotly() {
  const text = new TextDecoder().decode(await unpack("plotly"));
  const script = document.createElement("script");
  script.textContent = text;
  document.head.append(script);
}
