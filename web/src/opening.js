// What a page does by itself when it opens: the flight plays, slowly through the flip and again and again, until somebody takes over.

const SLOW = 0.25; // of the speed, through the flip
const AROUND = 0.25; // s before and after it

export class Opening {
  /** Of `viewer`; `settled`, if given, is told once the rod stands as it will to the end, and takes over if it returns true. */
  constructor(viewer, settled = () => false) {
    const { clock } = viewer;
    Object.assign(this, { viewer, settled, speed: clock.speed });
    clock.loop = true;
    clock.play();
    this.leave = ({ target }) => !target.closest?.("canvas.picture") && viewer.take(); // to look around disturbs nothing
    for (const name of ["pointerdown", "keydown"]) document.addEventListener(name, this.leave, true);
  }

  /** Set the speed for the time shown. */
  frame() {
    const { viewer: { clock, flights: [flight] } } = this, { settling } = flight.verdict;
    const flipping = flight.phases.some(({ name, from, to }) => name === "flips" && clock.time > from - AROUND && clock.time < to + AROUND);
    const speed = flipping ? SLOW * this.speed : this.speed;
    if (clock.speed !== speed) clock.setSpeed(speed);
    if (settling !== null && clock.time > settling + AROUND && this.settled()) this.viewer.take();
  }

  end() {
    const { viewer: { clock } } = this;
    clock.loop = false;
    clock.setSpeed(this.speed);
    for (const name of ["pointerdown", "keydown"]) document.removeEventListener(name, this.leave, true);
  }
}
