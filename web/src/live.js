// A page that flies by itself: the laboratory on machine code of its own, for one vehicle, law and plant.

import { Laboratory } from "./lab/laboratory.js";
import { Local } from "./live/local.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);
window.flypend = new Laboratory(data, (told) => new Local(data, told)).provide();
