// The spring by which a hand pulls the bob.

/**
 * Its force on a `bob` with the velocity `rate`, N: towards `place`, with `stiffness` (N/m), `damping` (N s/m), and `most` (N) at most.
 */
export function spring({ place, stiffness, damping, most }, bob, rate) {
  const force = place.map((value, k) => stiffness * (value - bob[k]) - damping * rate[k]), size = Math.hypot(...force);
  return size > most ? force.map((value) => (value * most) / size) : force;
}
