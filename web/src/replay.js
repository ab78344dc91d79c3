// The replay: a viewer of the runs in the page.

import { Viewer } from "./viewer.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);
window.flypend = new Viewer(data).offer();
