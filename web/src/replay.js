// The replay: a viewer of the runs in the page.

import { Viewer } from "./viewer.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);
const viewer = new Viewer(data);
window.flypend = viewer.offer();
viewer.open();
