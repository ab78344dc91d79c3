// The parts of the page, and the legend that tells the flights apart.

import { DASHES } from "./series.js";

/** Build the page into its body with the style sheet `css`; returns its parts by name. */
export function frame(css, title) {
  const style = document.createElement("style");
  style.textContent = css;
  document.head.append(style);
  const main = document.createElement("main");
  main.innerHTML = `
    <header><h1></h1><div class="legend"></div></header>
    <section class="scene" aria-label="Flight"><canvas class="picture"></canvas><p class="note"></p></section>
    <section class="plots" aria-label="Plots"></section>
    <footer><div class="player"></div><div class="choices"></div></footer>`;
  document.body.append(main);
  const find = (selector) => main.querySelector(selector);
  find("h1").textContent = title;
  return {
    legend: find(".legend"), scene: find(".scene"), canvas: find(".picture"), note: find(".note"), plots: find(".plots"), player: find(".player"), choices: find(".choices"),
  };
}

/** One line for each flight: how its curves are drawn, its name, how it ended. */
export function legend(parent, flights) {
  parent.replaceChildren();
  flights.forEach((flight, i) => {
    const entry = document.createElement("p");
    entry.innerHTML = `<svg width="30" height="10" aria-hidden="true"><line x1="1" x2="29" y1="5" y2="5"/></svg>
      <strong></strong> <span class="detail"></span> &ensp;<em></em>`;
    const find = (selector) => entry.querySelector(selector);
    find("line").setAttribute("stroke-dasharray", DASHES[i].join(" "));
    entry.className = flights.length === 1 ? "only" : i ? "ghost" : "";
    find("strong").textContent = flight.title;
    find(".detail").textContent = flight.detail;
    find("em").textContent = flight.outcome.text;
    find("em").title = flight.outcome.reason;
    find("em").className = flight.outcome.status;
    parent.append(entry);
  });
}
