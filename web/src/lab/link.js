// The socket to the server: numbered questions, the last of each kind asked again when the line was cut.

const AGAIN = 700; // ms

export class Link {
  /** `told` is called with every reply, `state` with true and false as the line comes and goes. */
  constructor(told, state) {
    Object.assign(this, { told, state, number: 0, last: new Map() });
    this.#open();
  }

  /** A number for a question that is asked later. */
  reserve() {
    return ++this.number;
  }

  /** Ask for something of a `kind`; returns its number. */
  ask(kind, content = {}, number = this.reserve()) {
    const message = { kind, number, ...content };
    if (kind === "stop") this.last.delete("map");
    else this.last.set(kind, message);
    this.#send(message);
    return message.number;
  }

  #send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  #open() {
    const address = new URL("socket", location.href);
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    address.hash = "";
    this.socket = new WebSocket(address);
    this.socket.addEventListener("open", () => {
      this.state(true);
      for (const message of this.last.values()) this.#send(message);
    });
    this.socket.addEventListener("message", (event) => this.told(JSON.parse(event.data)));
    this.socket.addEventListener("close", () => {
      this.state(false);
      setTimeout(() => this.#open(), AGAIN);
    });
  }
}
