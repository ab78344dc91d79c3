// The laboratory with the server that has sent the page.

import { Laboratory } from "./lab/laboratory.js";
import { Link } from "./lab/link.js";

const data = JSON.parse(document.getElementById("flypend-data").textContent);
window.flypend = new Laboratory(data, (told, say) => new Link(told, (open) => say(open ? "" : "no connection to the server"))).provide();
