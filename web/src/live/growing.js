// A flight that goes on: it has the last seconds of what has been flown, and takes more.

import { angles, Flight } from "../flight.js";
import { phase } from "../phases.js";
import { Recoveries } from "../recoveries.js";

const KEPT = 20; // s that stay

export class Growing extends Flight {
  /** Like a flight of `record`, whose columns are the first piece. */
  constructor(record) {
    super(record);
    this.room = {};
    this.count = 0;
    this.counted = new Recoveries(this.hold);
    this.take(record.columns, record);
  }

  /** Take the columns of another piece, and the verdict so far. */
  take(columns, { verdict, completed }) {
    const added = columns.t.length, drop = this.#old(columns.t[added - 1]);
    for (const [name, values] of Object.entries(columns)) {
      const width = values.length / added, wanted = (this.count - drop + added) * width;
      let room = this.room[name];
      if (!room || room.length < wanted) room = new Float64Array(Math.max(2 * wanted, 1024 * width));
      const kept = (this.room[name] ?? room).subarray(drop * width, this.count * width);
      if (room !== this.room[name] || drop) room.set(kept);
      room.set(values, (this.count - drop) * width);
      this.room[name] = room;
      this.columns[name] = room.subarray(0, wanted);
    }
    this.counted.next = this.count - drop;
    this.count += added - drop;
    this.t = this.columns.t;
    this.counted.read(this, Infinity);
    this.turned = angles(this, this.turned.slice(drop, drop + this.count - added));
    Object.assign(this, { verdict, completed, found: null });
  }

  /** As it looks at that moment: what comes next is not known yet. */
  phase(t) {
    return phase(this, this.at(t));
  }

  /** Its recoveries until now, whatever time is shown: of what has left nothing can be counted again. */
  recoveries() {
    return this.counted;
  }

  /** How many samples are to go: half of all that may stay, whenever there are too many. */
  #old(now) {
    if (this.count === 0 || now - this.t[0] < 2 * KEPT) return 0;
    return this.t.findIndex((time) => time >= now - KEPT);
  }
}
