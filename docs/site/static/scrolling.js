// What is wider than its column scrolls, by the keyboard as well: then it can be focused.
const resized = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const wide of document.querySelectorAll("article pre, .table-wrapper, .math-wrapper, .output")) resized.observe(wide);
