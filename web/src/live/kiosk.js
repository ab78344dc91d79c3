// A page for an exhibition: it shows the swing-up again and again, and whoever touches it plays against the controller.

import { write } from "../drawing.js";

const QUIET = 60; // s without a touch, after which it shows the swing-up again
const HOVER = 0.25; // of it, while nobody has touched anything and the machine hovers
const HELD = 3; // s of flight, after which the ball leaves the hand
const MOST = 5; // s of flight, a score that wins
const CHEER = 4000; // ms for which a victory is shown
const BEAT = 200; // ms between two looks at the clock

const RULES = `Grab the ball and fling it. Score: the seconds until rod and drone are back in place. Make it take ${MOST} s, or crash it, and you win.`;
const HTML = `<p class="headline" role="status"></p><p class="rules">${RULES}</p><p class="best"></p>`;

/** Seconds until a page that is opened as a kiosk shows the swing-up again, from its address: ?kiosk or ?kiosk=20; null: it is none. */
export function asked({ search } = location) {
  const given = new URLSearchParams(search).get("kiosk");
  return given === null ? null : Number(given) > 0 ? Number(given) : QUIET;
}

export class Kiosk {
  /** Of the laboratory `lab`, which shows the swing-up again after so many `quiet` seconds; `leave` is called by its button, if there is one. */
  constructor(lab, { quiet = QUIET, leave = null } = {}) {
    Object.assign(this, { lab, quiet, best: null, game: "idle", touched: performance.now(), score: null });
    this.root = document.createElement("section");
    Object.assign(this.root, { className: "game", innerHTML: HTML, ariaLabel: "Beat the controller" });
    const find = (name) => this.root.querySelector(name);
    Object.assign(this, { headline: find(".headline"), high: find(".best") });
    if (leave) {
      const button = Object.assign(document.createElement("button"), { type: "button", className: "leave", textContent: "Leave kiosk" });
      button.addEventListener("click", leave);
      this.root.append(button);
    }
    lab.main.append(this.root);
    lab.main.classList.add("kiosk");
    this.touch = ({ target }) => !target.closest?.(".leave") && this.#touch();
    document.addEventListener("pointerdown", this.touch, true); // the ball tells nobody else
    this.timer = setInterval(() => this.#look(), BEAT);
    this.#play("idle");
    if (lab.flew) this.#idle(); // else it opens by itself
  }

  end() {
    const { lab } = this;
    document.removeEventListener("pointerdown", this.touch, true);
    clearInterval(this.timer);
    this.game = null;
    this.root.remove();
    lab.main.classList.remove("kiosk");
    delete lab.main.dataset.game;
  }

  #play(game) {
    this.game = this.lab.main.dataset.game = game; // idle, rises, ready, held, watch, won
    this.#write();
  }

  /** Show the swing-up of the setting, again and again. */
  #idle() {
    this.score = null;
    this.#play("idle");
    this.lab.repeat();
  }

  /** Somebody is here: the flight goes on from where the rod stands. */
  #touch() {
    const { lab } = this, { viewer } = lab;
    this.touched = performance.now();
    if (this.game !== "idle" || !lab.flew) return;
    viewer.take();
    if (!lab.running.on) {
      viewer.clock.seek((lab.verdict?.settling ?? viewer.clock.start) + 0.1);
      lab.running.go(true);
    }
    if (lab.running.on) this.#play("rises");
  }

  /** Pull the ball towards `place`, or let go (null): one fling at a time. */
  pull(place) {
    const { running } = this.lab;
    if (place && this.game === "ready") {
      this.held = running.flight.end;
      this.#play("held");
    }
    if (this.game !== "held") return;
    running.pull(place);
    if (!place) this.#release();
  }

  #release() {
    this.lab.running.pull(null);
    this.released = this.lab.running.flight.end;
    this.#play("watch");
  }

  /** See how the game stands, at every picture. */
  frame() {
    const { running } = this.lab, { flight } = running;
    if (!running.on || !flight) return;
    const { end } = flight;
    if (running.over) {
      if (this.game !== "won") this.#won(this.game === "watch" || this.game === "held");
    } else if (this.game === "rises" && flight.state(end) === "done") this.#play("ready");
    else if (this.game === "held" && end - this.held > HELD) this.#release();
    else if (this.game === "watch") this.#watch(flight);
    if (this.game === "held" || this.game === "watch") this.#write();
  }

  #watch(flight) {
    const { all, open } = flight.recoveries(), { end } = flight, last = all[all.length - 1];
    if (open) {
      this.score = Math.max((open.back ?? end) - this.released, 0);
      if (end - this.released > MOST && open.back === null) this.#won(true);
    } else if (end - this.released > flight.hold) {
      this.score = Math.max((last?.end ?? 0) - this.released, 0);
      this.#keep(this.score);
      this.#play("ready");
    }
  }

  #keep(score) {
    this.best = Math.max(this.best ?? 0, Math.min(score, MOST));
  }

  /** The flight is over, or as good as that; by a fling, or before anybody had a hand in it. */
  #won(flung) {
    if (flung) this.#keep(MOST);
    this.flung = flung;
    this.#play("won");
    this.lab.running.pull(null);
    setTimeout(() => {
      if (this.game !== "won") return;
      this.score = null;
      this.lab.running.restart();
      this.#play("rises");
    }, CHEER);
  }

  /** Whether it is time to show the swing-up again. */
  #look() {
    const { lab: { running, viewer: { clock } }, game } = this, now = performance.now();
    if ((clock.playing && ["held", "watch"].includes(game)) || (game === "idle" && !running.on)) this.touched = now;
    else if (now - this.touched > 1000 * (game === "idle" ? HOVER * this.quiet : this.quiet)) this.#idle();
  }

  #write() {
    const { game, score, best, lab: { running } } = this, seconds = (value) => `${value.toFixed(1)} s`;
    const words = {
      idle: "Beat the controller", rises: "It swings up: wait until it is balanced",
      ready: score === null ? "Grab the ball and fling it" : `Back in ${seconds(score)}. Fling it again`,
      held: `Let go: ${seconds(Math.max(HELD - ((running.flight?.end ?? 0) - (this.held ?? 0)), 0))}`, watch: seconds(score ?? 0),
      won: this.flung ? "You win" : "It fell",
    };
    write(this.headline, words[game]);
    write(this.high, best === null ? "" : `Best so far: ${best >= MOST ? "a win" : seconds(best)}`);
  }
}
