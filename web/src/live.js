// A page that flies by itself: the laboratory on machine code of its own, for one vehicle, law and plant or for several.

import { Laboratory } from "./lab/laboratory.js";
import { Local } from "./live/local.js";
import { Shelf } from "./live/shelf.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);
window.flypend = new Laboratory(data, (told) => (data.engines ? new Shelf(data, told) : new Local(data, told))).provide();
