// The sphere of directions on a disc of equal areas (Lambert's azimuthal projection): one pole in the middle, the other all along
// the rim, headings as seen from above. Directions have e3 up; places are in radii of the disc, y down as on a screen.

import { font } from "./drawing.js";

const RINGS = [30, 60, 90, 120, 150]; // degrees from the middle
const LEVEL = 90;

/** Where a unit vector is on the disc; `pole` is 1 with upright in the middle, −1 with hanging. */
export function place([a, b, c], pole = 1) {
  const level = Math.hypot(a, b), share = Math.sqrt(Math.max(1 - pole * c, 0) / 2);
  return level > 1e-9 ? [share * a / level, -share * b / level] : [share, 0];
}

/** The unit vector at a place of the disc, upright in the middle; null beyond the rim. */
export function direction([x, y]) {
  const square = x * x + y * y, stretch = 2 * Math.sqrt(1 - square);
  return square <= 1 ? [x * stretch, -y * stretch, 1 - 2 * square] : null;
}

/** Whether something goes from place to place through the rim, where it comes in again on the other side. */
const leaps = (x, y, a, b) => Math.hypot(a - x, b - y) > 0.5;

/** Stroke the way through `places` (x, y of each, one after the other), from the point `first` on. */
export function way(context, places, radius, first = 0) {
  context.beginPath();
  for (let i = 2 * first; i < places.length; i += 2) {
    const [x, y] = [radius * places[i], radius * places[i + 1]];
    if (i === 2 * first || leaps(places[i - 2], places[i - 1], places[i], places[i + 1])) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
  context.stroke();
}

/** Rings around the middle, that of level rods twice as wide, and the rim, in their colours. */
export function rings(context, radius, ring, rim) {
  const circle = (share, width, colour) => {
    Object.assign(context, { lineWidth: width, strokeStyle: colour });
    context.beginPath();
    context.arc(0, 0, radius * share, 0, 2 * Math.PI);
    context.stroke();
  };
  for (const angle of RINGS) circle(Math.sin(angle * Math.PI / 360), angle === LEVEL ? 2 : 1, ring);
  circle(1, 1, rim);
}

/** Names of the first two axes at the rim, for a frame with `e3` up or down. */
export function axes(context, radius, e3, colour) {
  Object.assign(context, { font: font(12), textAlign: "center", textBaseline: "middle", fillStyle: colour });
  context.fillText("e₁", radius + 15, 0);
  context.fillText("e₂", 0, (e3 === "up" ? -1 : 1) * (radius + 15));
}
