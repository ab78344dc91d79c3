// Small arithmetic on plain arrays; quaternions in the order x, y, z, w.

export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
export const mix = (a, b, share) => a + (b - a) * share;
export const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
export const norm = (a) => Math.hypot(...a);
export const unit = (a) => {
  const length = norm(a) || 1;
  return a.map((value) => value / length);
};

/** The angle of a `cosine`, which rounding may have put beyond 1, in degrees. */
export const degrees = (cosine) => (Math.acos(clamp(cosine, -1, 1)) * 180) / Math.PI;

/** Cubic through the values a, b with the rates da, db at the ends of an interval of `step` seconds. */
export function hermite(a, da, b, db, step, share) {
  const s = share, r = 1 - s;
  return a.map((value, i) =>
    (1 + 2 * s) * r * r * value + s * r * r * step * da[i] + s * s * (3 - 2 * s) * b[i] - s * s * r * step * db[i]);
}

/** Rotation between the unit quaternions a and b, at constant angular velocity along the shorter arc. */
export function slerp(a, b, share) {
  let cosine = dot(a, b);
  const sign = cosine < 0 ? -1 : 1;
  cosine = Math.min(Math.abs(cosine), 1);
  const angle = Math.acos(cosine), sine = Math.sin(angle);
  if (sine < 1e-6) return unit(a.map((value, i) => mix(value, sign * b[i], share)));
  const from = Math.sin((1 - share) * angle) / sine, to = sign * Math.sin(share * angle) / sine;
  return unit(a.map((value, i) => from * value + to * b[i]));
}

/** Rotation matrix, three rows, of the unit quaternion [x, y, z, w]. */
export function matrix([x, y, z, w]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
  ];
}

/** The last index i with times[i] <= t, and 0 before the first. */
export function indexBefore(times, t) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** The smallest of 1, 2, 5 times a power of ten that is not below `value`. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((step) => step * power >= value * (1 - 1e-9));
}
