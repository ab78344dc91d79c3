// What the page can do, in words: what buttons say when a mouse rests on them, for those who have none.

import { dialog } from "./dialog.js";

const FINGERS = [
  ["Picture", "Drag to look around, pinch or wheel to zoom, double tap to reset"], ["Plots and phase portrait", "Touch to go to that time"],
  ["Ball", "In a live flight, drag and fling it; at the start, drag it to another start"], ["←, →", "Step by 1/30 s, with shift by 1 s; ↑ and ↓ change the speed"],
];

/** Show what the controls of `main` do: the hint of each, once. */
export function help(main) {
  const list = document.createElement("dl"), told = new Set();
  const entries = [...main.querySelectorAll(":is(button, a)[title]:not([title=''], .handle)")].map((button) => [named(button), button.title]);
  for (const [name, words] of [...FINGERS, ...entries]) {
    if (told.has(words)) continue;
    told.add(words);
    list.append(Object.assign(document.createElement("dt"), { textContent: name }), Object.assign(document.createElement("dd"), { textContent: words }));
  }
  dialog("What everything does", list);
}

/** What a button is called; one that says no more than a number or *reset* also by what it belongs to. */
function named(button) {
  const words = button.textContent.trim() || button.getAttribute("aria-label"), whose = button.closest("[data-whose]");
  return whose ? `${whose.dataset.whose} ${words}` : words;
}
