// The parts of the page, and the legend that tells the flights apart.

import { DASHES } from "./series.js";
import { writeSymbol } from "./words.js";

/** Build the page into its body with the style sheet `css`; returns its parts by name. */
export function frame(css, title) {
  const style = document.createElement("style");
  style.textContent = css;
  document.head.append(style);
  const main = document.createElement("main");
  main.innerHTML = `
    <header><h1></h1><div class="legend"></div></header>
    <section class="scene" aria-label="Flight"><canvas class="picture" role="img"></canvas><p class="note" role="status"></p><p class="invite" hidden></p><div class="low"></div></section>
    <section class="plots" aria-label="Plots" tabindex="0"></section>
    <footer><div class="player"></div><div class="choices"></div></footer>`;
  document.body.append(main);
  const find = (selector) => main.querySelector(selector);
  find("h1").textContent = title;
  return {
    legend: find(".legend"), scene: find(".scene"), canvas: find(".picture"), note: find(".note"), invite: find(".invite"), low: find(".low"), plots: find(".plots"), player: find(".player"), choices: find(".choices"),
  };
}

/** One line for each flight: how its curves are drawn, its name, its gains, how it ended. */
export function legend(parent, flights) {
  parent.replaceChildren();
  flights.forEach((flight, i) => {
    const entry = document.createElement("p");
    entry.innerHTML = `<svg width="30" height="10" aria-hidden="true"><line x1="1" x2="29" y1="5" y2="5"/></svg>
      <strong></strong> <span class="detail"></span> <em class="verdict"></em>`;
    const find = (selector) => entry.querySelector(selector);
    find("line").setAttribute("stroke-dasharray", DASHES[i].join(" "));
    entry.className = flights.length === 1 ? "only" : i ? "ghost" : "";
    find("strong").textContent = flight.title;
    flight.gains.forEach(([name, value], k) => {
      if (k) find(".detail").append(", ");
      writeSymbol(find(".detail"), name);
      find(".detail").append(` = ${value}`);
    });
    judge(find("em"), flight.verdict);
    parent.append(entry);
  });
}

/** Write a verdict, with a sign of its state: done, recovering or failed. */
export function judge(element, { words, state, reason }) {
  element.textContent = words;
  if (reason && !words.includes(reason)) element.textContent += `: ${reason}`;
  element.className = `verdict ${state}`;
}
