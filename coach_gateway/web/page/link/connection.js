// The connection to the gateway: passes on messages, matches replies to requests, and reconnects.

const FIRST_WAIT_MS = 200;
const LONGEST_WAIT_MS = 3000;
const CLOSED_WAIT_MS = 5000;
const ANSWER_MS = 8000; // the host replies between two ticks; after this, no reply comes
const SILENT_MS = 1400; // the gateway sends a message every half second, at least `alive`; without one, the page shows it
const DEAD_MS = 5000; // after this, it connects anew
const LOOK_MS = 250;

export class Connection {
  #socket = null;
  #wait = FIRST_WAIT_MS;
  #waiting = 0;
  #number = 0;
  #asked = new Map();
  #receivedAt = 0;
  #lookedAt = 0;

  /**
   * `onMessage` is called with each message, `onChange` with whether the connection is up, `onSilence` when nothing
   * arrives any more, and when something does again.
   */
  constructor(token, onMessage, onChange, onSilence) {
    Object.assign(this, { token, onMessage, onChange, onSilence });
    this.up = false;
    /** Why the gateway closed the connection; empty where it has not. */
    this.closeReason = "";
    /** Nothing has arrived for a while: a lost network closes no socket. */
    this.silent = false;
    /** ms without a message after which the connection counts as broken. */
    this.patience = DEAD_MS;
    /** ms after which a request counts as unanswered. */
    this.answerWithin = ANSWER_MS;
    addEventListener("online", () => this.#open());
    document.addEventListener("visibilitychange", () => document.hidden || this.#open());
    setInterval(() => this.#look(), LOOK_MS);
    this.#open();
  }

  /** Requests a deed; resolves to its reply, `unanswered` where none came. */
  ask(deed, content = {}) {
    if (!this.up) return Promise.resolve(unanswered(0, "the page has no connection to the gateway"));
    return new Promise((answer) => {
      const id = this.#send(deed, content);
      const late = setTimeout(() => this.#answer(unanswered(id, "no reply came")), this.answerWithin);
      this.#asked.set(id, { answer, late });
    });
  }

  /** Sends a request that gets a reply only if it is refused; `refused` is called with that reply. */
  send(deed, content, refused) {
    if (!this.up) return;
    this.#asked.set(this.#send(deed, content), { answer: refused, late: 0 });
    for (const id of this.#asked.keys()) {
      if (id > this.#number - 200) break;
      if (this.#asked.get(id).late === 0) this.#asked.delete(id);
    }
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
    this.#receivedAt = performance.now();
    socket.addEventListener("open", () => {
      if (socket !== this.#socket) return;
      this.up = true;
      this.closeReason = "";
      this.onChange(true);
    });
    socket.addEventListener("message", (event) => {
      if (socket !== this.#socket) return;
      this.#receivedAt = performance.now();
      this.#note(false);
      const message = JSON.parse(event.data);
      if (message.kind === "reply") this.#answer(message);
      else if (message.kind === "refusal") this.closeReason = message.reason;
      else {
        this.#wait = FIRST_WAIT_MS; // the connection works
        this.onMessage(message);
      }
    });
    socket.addEventListener("close", () => this.#closed(socket));
  }

  /** Closes a silent connection; after a sleep of the page, messages that wait are read first. */
  #look() {
    const now = performance.now();
    if (now - this.#lookedAt > 1000 + LOOK_MS) this.#receivedAt = now;
    this.#lookedAt = now;
    const socket = this.#socket;
    this.#note(this.up && now - this.#receivedAt > SILENT_MS);
    if (socket === null || now - this.#receivedAt < this.patience) return;
    this.#closed(socket);
    socket.close();
  }

  #note(silent) {
    if (silent === this.silent) return;
    this.silent = silent;
    this.onSilence();
  }

  #closed(socket) {
    if (socket !== this.#socket) return;
    this.#socket = null;
    this.up = false;
    this.silent = false;
    for (const id of [...this.#asked.keys()]) this.#answer(unanswered(id, "the connection to the gateway broke"));
    this.onChange(false);
    if (this.closeReason) this.#wait = CLOSED_WAIT_MS;
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

const unanswered = (id, reason) => ({ id, accepted: false, reason, unanswered: true });
