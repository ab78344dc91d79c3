// What all that draws beside the scene does: a canvas as sharp as the screen, elements that follow the time.

/** How much larger letters, and all that is drawn, are than on a usual screen: see the first lines of replay.css. */
export const lettering = () => parseFloat(getComputedStyle(document.documentElement).fontSize) / 14;

/** Clear the canvas of `context` for `width` by `height` pixels of a usual screen, in which one then draws, from its upper left. */
export function clear(context, width, height) {
  const { canvas } = context, ratio = lettering() * (window.devicePixelRatio || 1), across = Math.round(width * ratio), along = Math.round(height * ratio);
  if (canvas.width !== across || canvas.height !== along) Object.assign(canvas, { width: across, height: along });
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, across, along);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
}

/** A font of `pixels` on such a canvas. */
export const font = (pixels) => `${pixels}px system-ui, sans-serif`;

/** Put `element` to `transform`, unless it is there: to write a style has styles computed anew. */
export function move(element, transform) {
  if (element.moved === transform) return;
  element.moved = transform;
  element.style.transform = transform;
}

/** Write `words` into `element`, which holds nothing else, unless they stand there; another text in the same node is cheaper. */
export function write(element, words) {
  const { firstChild: text } = element;
  if (!text) element.textContent = words;
  else if (text.data !== words) text.data = words;
}
