// The laboratory with the server that has sent the page.

import { Hybrid } from "./lab/hybrid.js";
import { Laboratory } from "./lab/laboratory.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);
window.flypend = new Laboratory(data, (told, say) => new Hybrid(told, say)).provide();
