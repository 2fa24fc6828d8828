// The line to the gateway: what comes is handed on, what is asked is answered, and a broken line is tied again.

const FIRST_WAIT_MS = 200;
const LONGEST_WAIT_MS = 3000;
const SENT_AWAY_MS = 5000;
const ANSWER_MS = 8000; // the host answers between two ticks; later than this, nobody will

export class Line {
  #socket = null;
  #wait = FIRST_WAIT_MS;
  #waiting = 0;
  #number = 0;
  #asked = new Map();
  #take;
  #changed;

  /** `take` is given each message, `changed` whether the line is up. */
  constructor(token, take, changed) {
    this.token = token;
    this.up = false;
    /** Why the gateway closed the line, or nothing. */
    this.sentAway = "";
    this.#take = take;
    this.#changed = changed;
    addEventListener("online", () => this.#open());
    document.addEventListener("visibilitychange", () => document.hidden || this.#open());
    this.#open();
  }

  /** Asks for a deed; the answer says whether it was accepted, and if not, why. */
  ask(deed, content = {}) {
    if (!this.up) return Promise.resolve({ accepted: false, reason: "the page has no connection to the gateway" });
    return new Promise((answer) => {
      const id = this.#send(deed, content);
      const late = setTimeout(() => this.#answer({ id, accepted: false, reason: "no answer came" }), ANSWER_MS);
      this.#asked.set(id, { answer, late });
    });
  }

  /** Says something that is answered only if it is refused; `refused` hears the reason. */
  tell(deed, content, refused) {
    if (!this.up) return;
    this.#asked.set(this.#send(deed, content), { answer: refused, late: 0 });
    for (const id of this.#asked.keys()) {
      if (id > this.#number - 200) break;
      if (this.#asked.get(id).late === 0) this.#asked.delete(id);
    }
  }

  /** Speaks with another token from now on. */
  speakAs(token) {
    this.token = token;
    return this.ask("token");
  }

  #send(deed, content) {
    this.#number += 1;
    this.#socket.send(JSON.stringify({ id: this.#number, token: this.token, deed, ...content }));
    return this.#number;
  }

  #open() {
    clearTimeout(this.#waiting);
    if (this.#socket !== null) return;
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/ws`);
    this.#socket = socket;
    socket.addEventListener("open", () => {
      this.up = true;
      this.sentAway = "";
      this.#changed(true);
    });
    socket.addEventListener("message", (event) => {
      const message = JSON.parse(event.data);
      if (message.kind === "reply") this.#answer(message);
      else if (message.kind === "refusal") this.sentAway = message.reason;
      else this.#hear(message);
    });
    socket.addEventListener("close", () => this.#closed());
  }

  #hear(message) {
    this.#wait = FIRST_WAIT_MS; // the line is up, and somebody speaks
    this.#take(message);
  }

  #closed() {
    this.#socket = null;
    this.up = false;
    for (const id of [...this.#asked.keys()]) {
      this.#answer({ id, accepted: false, reason: "the connection to the gateway broke" });
    }
    this.#changed(false);
    if (this.sentAway) this.#wait = SENT_AWAY_MS;
    this.#waiting = setTimeout(() => this.#open(), this.#wait);
    this.#wait = Math.min(1.6 * this.#wait, LONGEST_WAIT_MS);
  }

  #answer(reply) {
    const asked = this.#asked.get(reply.id);
    if (asked === undefined) return;
    this.#asked.delete(reply.id);
    clearTimeout(asked.late);
    asked.answer(reply);
  }
}
