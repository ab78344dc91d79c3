// An address as a QR code.

import { encode } from "uqr";
import { dialog } from "../dialog.js";

const MOST = 2900; // characters that a code takes
const SVG = "http://www.w3.org/2000/svg", QUIET = 4; // modules of white that readers want around a code
const HERE = ["", "localhost", "127.0.0.1", "[::1]"]; // hosts that no telephone finds

/** The drawing of a code that reads `text`. */
function drawn(text) {
  const { data, size } = encode(text, { ecc: "L", border: QUIET }), root = document.createElementNS(SVG, "svg"), path = document.createElementNS(SVG, "path");
  const dark = data.flatMap((row, y) => row.flatMap((on, x) => (on ? [`M${x} ${y}h1v1h-1z`] : [])));
  root.setAttribute("viewBox", `0 0 ${size} ${size}`);
  root.setAttribute("role", "img");
  root.setAttribute("aria-label", "QR code of the address of this setting");
  root.setAttribute("shape-rendering", "crispEdges");
  path.setAttribute("d", dark.join(""));
  root.append(path);
  return root;
}

/** Show `address` as a code for a telephone. */
export function show(address) {
  const content = document.createElement("div"), words = document.createElement("p"), { hostname } = new URL(address);
  if (address.length > MOST) {
    words.textContent = "The address is too long for a code. Copy the link instead.";
    content.append(words);
    dialog("QR code", content);
    return;
  }
  words.textContent = HERE.includes(hostname) ? "This page is on this computer alone: a phone can open the code once the page is on a web server." : "Point a phone's camera at the code: it opens this page with this setting.";
  content.append(drawn(address), words);
  dialog("QR code", content);
}
