// A window over the page: with a heading, and a button that closes it.

/** Open one with `title` and the element `content`; Escape and a touch beside it close it, too. */
export function dialog(title, content) {
  const root = document.createElement("dialog"), head = document.createElement("header"), heading = document.createElement("h2"), close = document.createElement("button");
  root.className = "sheet";
  root.setAttribute("aria-label", title);
  heading.textContent = title;
  head.append(heading, close);
  Object.assign(close, { type: "button", className: "close", textContent: "Close" });
  close.addEventListener("click", () => root.close());
  root.addEventListener("click", ({ target }) => target === root && root.close());
  root.addEventListener("keydown", (event) => event.stopPropagation()); // its keys are not those of the page
  root.addEventListener("close", () => root.remove());
  root.append(head, content);
  document.body.append(root);
  root.showModal();
}
