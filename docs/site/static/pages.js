// A formula that is wider than its column shrinks, to no less than LEAST of its size.
const LEAST = 0.6;
function fit(formula) {
  formula.style.fontSize = "";
  const share = formula.clientWidth / formula.scrollWidth;
  if (share < 1) formula.style.fontSize = `${Math.max(LEAST, 0.99 * share)}em`;
}
const widths = new ResizeObserver((entries) => entries.forEach(({ target }) => fit(target.firstElementChild)));
for (const formula of document.querySelectorAll("article div.math")) {
  const column = document.createElement("div");
  formula.replaceWith(column);
  column.append(formula);
  widths.observe(column);
}

// What is wider than its column scrolls, by the keyboard as well: then it can be focused.
const resized = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const wide of document.querySelectorAll("article pre, .table-wrapper, .math-wrapper, .output")) resized.observe(wide);

// Live figures take the theme that is chosen, and letters as large as the page's.
const dark = matchMedia("(prefers-color-scheme: dark)");
function paint(frame) {
  const { theme } = document.body.dataset;
  const name = theme === "light" || theme === "dark" ? theme : dark.matches ? "dark" : "light";
  const letters = parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
  frame.contentWindow.postMessage({ theme: name, letters }, "*");
}
const figures = document.querySelectorAll(".live iframe");
for (const frame of figures) frame.addEventListener("load", () => paint(frame));
new MutationObserver(() => figures.forEach(paint)).observe(document.body, { attributeFilter: ["data-theme"] });
