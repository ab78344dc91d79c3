// What a page lets one take away: numbers, a picture, an address.

import { picture, save } from "../record.js";
import { download } from "./table.js";

const HTML = `<h2>Keep</h2>
  <div class="row two"><button type="button" data-keep="csv" title="Times, states, forces of the flight that is shown">CSV</button>
  <button type="button" data-keep="png" title="The picture as it is, in the size of movies">PNG</button></div>
  <div class="row two"><button type="button" data-keep="link" title="An address that leads to this setting">Copy link</button>
  <button type="button" data-keep="pin" aria-pressed="false" title="Leave the flight as a ghost while the setting changes">Pin</button></div>`;

export class Saving {
  /** In the panel of the laboratory `lab`. */
  constructor(lab) {
    this.lab = lab;
    const root = document.createElement("section");
    root.innerHTML = HTML;
    lab.panel.root.append(root);
    for (const button of root.querySelectorAll("[data-keep]")) button.addEventListener("click", () => this[button.dataset.keep](button));
    lab.panel.pin = root.querySelector("[data-keep=pin]");
    lab.panel.pins(lab.pinned.length > 0);
  }

  csv() {
    const { flights } = this.lab.viewer;
    save(download(flights[0]), "flight.csv");
  }

  png() {
    const { viewer } = this.lab;
    if (viewer.stage) picture(viewer, viewer.size, (blob) => save(blob, "flight.png"));
  }

  link(button) {
    this.lab.setting.keep();
    const copied = navigator.clipboard?.writeText(location.href) ?? Promise.reject(new Error("no clipboard"));
    copied.then(() => "Copied", () => "See the address bar").then((words) => {
      button.textContent = words;
      setTimeout(() => (button.textContent = "Copy link"), 1500);
    });
  }

  pin() {
    this.lab.pin();
  }
}
