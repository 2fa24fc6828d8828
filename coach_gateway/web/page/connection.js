// The line to the gateway: what comes is handed on, what is asked is answered, and a broken line is tied again.

const FIRST_WAIT_MS = 200;
const LONGEST_WAIT_MS = 3000;
const SENT_AWAY_MS = 5000;
const ANSWER_MS = 8000; // the host answers between two ticks; later than this, nobody will
const SILENT_MS = 7000; // the gateway says something every second, if only that it is there
const LOOK_MS = 1000;

export class Connection {
  #socket = null;
  #wait = FIRST_WAIT_MS;
  #waiting = 0;
  #number = 0;
  #asked = new Map();
  #heardAt = 0;
  #lookedAt = 0;
  #onMessage;
  #onChange;

  /** `onMessage` is given each message, `onChange` whether the line is up. */
  constructor(token, onMessage, onChange) {
    this.token = token;
    this.up = false;
    /** Why the gateway closed the line, or nothing. */
    this.sentAway = "";
    /** ms without a word after which the line is taken for broken: whose network went does not hear it close. */
    this.patience = SILENT_MS;
    /** ms after which an answer comes no more. */
    this.answerWithin = ANSWER_MS;
    this.#onMessage = onMessage;
    this.#onChange = onChange;
    addEventListener("online", () => this.#open());
    document.addEventListener("visibilitychange", () => document.hidden || this.#open());
    setInterval(() => this.#look(), LOOK_MS);
    this.#open();
  }

  /** Asks for a deed; the answer says whether it was accepted, and if not, why; `unanswered` where nobody said so. */
  ask(deed, content = {}) {
    if (!this.up) return Promise.resolve(unanswered(0, "the page has no connection to the gateway"));
    return new Promise((answer) => {
      const id = this.#send(deed, content);
      const late = setTimeout(() => this.#answer(unanswered(id, "no answer came")), this.answerWithin);
      this.#asked.set(id, { answer, late });
    });
  }

  /** Says something that is answered only if it is refused; `refused` hears the reason. */
  send(deed, content, refused) {
    if (!this.up) return;
    this.#asked.set(this.#send(deed, content), { answer: refused, late: 0 });
    for (const id of this.#asked.keys()) {
      if (id > this.#number - 200) break;
      if (this.#asked.get(id).late === 0) this.#asked.delete(id);
    }
  }

  /** Speaks with another token from now on. */
  useToken(token) {
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
    this.#heardAt = performance.now();
    socket.addEventListener("open", () => {
      if (socket !== this.#socket) return;
      this.up = true;
      this.sentAway = "";
      this.#onChange(true);
    });
    socket.addEventListener("message", (event) => {
      if (socket !== this.#socket) return;
      this.#heardAt = performance.now();
      const message = JSON.parse(event.data);
      if (message.kind === "reply") this.#answer(message);
      else if (message.kind === "refusal") this.sentAway = message.reason;
      else this.#receive(message);
    });
    socket.addEventListener("close", () => this.#closed(socket));
  }

  /** Whether the line still holds; a page that slept gives what came meanwhile time to be read. */
  #look() {
    const now = performance.now();
    if (now - this.#lookedAt > 3 * LOOK_MS) this.#heardAt = now;
    this.#lookedAt = now;
    const socket = this.#socket;
    if (socket === null || now - this.#heardAt < this.patience) return;
    this.#closed(socket);
    socket.close();
  }

  #receive(message) {
    this.#wait = FIRST_WAIT_MS; // the line is up, and somebody speaks
    this.#onMessage(message);
  }

  #closed(socket) {
    if (socket !== this.#socket) return;
    this.#socket = null;
    this.up = false;
    for (const id of [...this.#asked.keys()]) this.#answer(unanswered(id, "the connection to the gateway broke"));
    this.#onChange(false);
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

const unanswered = (id, reason) => ({ id, accepted: false, reason, unanswered: true });
