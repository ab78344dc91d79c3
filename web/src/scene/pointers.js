// Mouse, pen and fingers on the picture: one turns the camera, two pinch, the wheel zooms, a double tap resets.
// In a frame the wheel scrolls what is around it, and zooms with Ctrl.

export function steer(element, rig, changed) {
  const held = new Map();
  let span = 0;
  const spread = () => {
    const [a, b] = [...held.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const down = (event) => {
    element.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (held.size === 2) span = spread();
  };
  const move = (event) => {
    const last = held.get(event.pointerId);
    if (!last) return;
    const next = { x: event.clientX, y: event.clientY };
    held.set(event.pointerId, next);
    if (held.size === 1) rig.move(-0.007 * (next.x - last.x), 0.007 * (next.y - last.y));
    if (held.size === 2) {
      const now = spread();
      rig.move(0, 0, now / Math.max(span, 1));
      span = now;
    }
    changed();
  };
  const up = (event) => held.delete(event.pointerId);
  const framed = self !== top;
  const wheel = (event) => {
    if (framed && !event.ctrlKey) return;
    event.preventDefault();
    rig.move(0, 0, Math.exp(-0.0015 * event.deltaY));
    changed();
  };
  const reset = () => {
    rig.choose(rig.preset);
    changed();
  };
  const listeners = {
    pointerdown: down, pointermove: move, pointerup: up, pointercancel: up, lostpointercapture: up, dblclick: reset,
  };
  for (const [name, listener] of Object.entries(listeners)) element.addEventListener(name, listener);
  element.addEventListener("wheel", wheel, { passive: false });
}
