// What a page lets one take away: numbers, a picture, an address.

import { picture, save } from "../record.js";
import { show } from "./code.js";
import { download } from "./table.js";

const HTML = `<h2>Keep</h2>
  <div class="row two"><button type="button" data-keep="csv" title="Times, states, forces of the flight that is shown">CSV</button>
  <button type="button" data-keep="png" title="The picture as it is, in the size of movies">PNG</button></div>
  <div class="row two"><button type="button" data-keep="link" title="An address that leads to this setting">Copy link</button>
  <button type="button" data-keep="embed" title="The line of HTML that shows this setting in another page">Copy embed code</button></div>
  <div class="row two"><button type="button" data-keep="code" title="The address of this setting as a QR code">QR code</button>
  <button type="button" data-keep="kiosk" title="For an exhibition: the swing-up again and again, and a game against the controller (k)">Kiosk</button></div>
  <div class="row two"><button type="button" data-keep="pin" aria-pressed="false" title="Leave the flight as a ghost while the setting changes">Pin</button></div>`;

/** The HTML of a frame with the page at `address`. */
const framed = (address, title) => {
  const frame = document.createElement("iframe");
  for (const [name, value] of Object.entries({ src: address, title, width: 960, height: 640, loading: "lazy", style: "border:0" })) frame.setAttribute(name, value);
  return frame.outerHTML;
};

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
    this.#copy(button, (address) => address, "See the address bar");
  }

  embed(button) {
    this.#copy(button, (address) => framed(address, this.lab.viewer.title), "No clipboard here");
  }

  code() {
    this.lab.setting.keep();
    show(location.href);
  }

  kiosk() {
    this.lab.exhibit();
  }

  /** Copy what `made` makes of the address of the setting, and say so on `button` for a while, or what to do `otherwise`. */
  #copy(button, made, otherwise) {
    const name = (button.dataset.words ??= button.textContent);
    this.lab.setting.keep();
    const copied = navigator.clipboard?.writeText(made(location.href)) ?? Promise.reject(new Error("no clipboard"));
    copied.then(() => "Copied", () => otherwise).then((words) => {
      button.textContent = words;
      setTimeout(() => (button.textContent = name), 1500);
    });
  }

  pin() {
    this.lab.pin();
  }
}
