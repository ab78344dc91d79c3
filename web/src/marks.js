// Marks that tell curves apart without colour: on the curves of a plot, and beside their readings.

export const MARKS = ["disc", "square", "triangle", "diamond"];
const SIZE = 3.4; // CSS pixels, radius

/** The outline of a mark as points about the middle, for a radius of 1; "disc" is a circle. */
const OUTLINES = {
  square: [[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]],
  triangle: [[0, -1.15], [1.05, 0.75], [-1.05, 0.75]],
  diamond: [[0, -1.25], [1.05, 0], [0, 1.25], [-1.05, 0]],
};

/** Draw the mark `name` at (x, y) of a canvas, in `colour` with a rim of `paper`. */
export function drawMark(context, name, x, y, colour, paper) {
  context.beginPath();
  if (name === "disc") context.arc(x, y, SIZE, 0, 2 * Math.PI);
  else OUTLINES[name].forEach(([a, b]) => context.lineTo(x + SIZE * a, y + SIZE * b));
  context.closePath();
  Object.assign(context, { fillStyle: colour, strokeStyle: paper, lineWidth: 1.2 });
  context.fill();
  context.stroke();
}

/** The mark `name` as an SVG element's text, in the current colour. */
export function markIcon(name) {
  const shape = name === "disc" ? `<circle r="${SIZE}"/>`
    : `<polygon points="${OUTLINES[name].map(([a, b]) => `${SIZE * a},${SIZE * b}`).join(" ")}"/>`;
  return `<svg class="mark" viewBox="-9 -5 18 10" aria-hidden="true"><path d="M-9 0H9"/>${shape}</svg>`;
}
