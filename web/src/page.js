// The page: a viewer of its runs; or with an offer the laboratory, with the server that has sent it, or on machine code in the page, for
// one vehicle, law and plant or for several.

import { Hybrid } from "./lab/hybrid.js";
import { Laboratory } from "./lab/laboratory.js";
import { Local } from "./live/local.js";
import { Shelf } from "./live/shelf.js";
import { Viewer } from "./viewer.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);

function connected(told, say) {
  if (data.engines) return new Shelf(data, told);
  return data.engine ? new Local(data, told) : new Hybrid(told, say);
}

if (data.offer) window.flypend = new Laboratory(data, connected).provide();
else {
  const viewer = new Viewer(data);
  window.flypend = viewer.offer();
  viewer.open();
}
