// Requests for deeds: each reply is shown beside its button or field, and kept in a log with the requests of others.

import { byId, element } from "../shared/elements.js";
import { clockText } from "../parts/text.js";

const ACCEPTED_MS = 2500;
const REFUSED_MS = 9000;
const MOST = 200; // lines of the log

export class Requests {
  #bubbles = new Map();
  #own = []; // actions of this page whose events have not come yet
  #heard = new Set();

  constructor(connection, match) {
    Object.assign(this, { connection, match });
    match.on("event", () => this.#hear(match.events.at(-1)));
    addEventListener("scroll", () => this.#follow(), { capture: true, passive: true });
    addEventListener("resize", () => this.#follow());
  }

  /** Requests a deed that people know as `words`; the verdict is shown beside the element `source`, if there is one. */
  async ask(source, words, deed, content) {
    source?.classList.add("asking");
    if (deed === "action") this.#own.push(content.action.action);
    const reply = await this.connection.ask(deed, content);
    source?.classList.remove("asking");
    if (deed === "action" && !reply.accepted) this.#forget(content.action.action);
    this.show(source, words, reply);
    return reply;
  }

  /** Shows a verdict. */
  show(source, words, { accepted, reason }) {
    const verdict = accepted ? "accepted" : `refused: ${reason}`;
    this.#note(words, verdict, accepted, this.match.frames.newest?.clock ?? 0);
    if (source?.isConnected) this.#bubble(source, `${accepted ? "✓" : "✗"} ${verdict}`, accepted);
  }

  /** Lists an action that the referee has accepted, unless this page requested it; events come again with each welcome. */
  #hear({ kind, tick, rule, clock, text }) {
    const key = `${tick} ${text}`;
    if (!this.match.live || kind !== "action" || !text.includes(" requests: ") || this.#heard.has(key)) return;
    this.#heard.add(key);
    if (!this.#forget(rule)) this.#note(text, "accepted", true, clock).classList.add("of-others");
  }

  /** Forgets an action of this page; whether there was one. Another page's equal action may have come before it. */
  #forget(action) {
    const place = this.#own.indexOf(action);
    if (place >= 0) this.#own.splice(place, 1);
    return place >= 0;
  }

  #note(words, verdict, accepted, clock) {
    const log = byId("log"), looks = { class: accepted ? "accepted" : "refused" };
    const row = element("li", looks, element("time", {}, clockText(clock)), element("b", {}, words), ` ${verdict}`);
    log.prepend(row);
    while (log.childElementCount > MOST) log.lastElementChild.remove();
    return row;
  }

  #bubble(source, text, accepted) {
    this.#remove(source);
    const bubble = element("div", { class: `verdict ${accepted ? "accepted" : "refused"}`, aria: { hidden: "true" } }, text);
    document.body.append(bubble);
    lay(bubble, source);
    const gone = setTimeout(() => this.#remove(source), accepted ? ACCEPTED_MS : REFUSED_MS);
    this.#bubbles.set(source, { bubble, gone });
  }

  #remove(source) {
    const there = this.#bubbles.get(source);
    if (there === undefined) return;
    clearTimeout(there.gone);
    there.bubble.remove();
    this.#bubbles.delete(source);
  }

  /** Moves the verdicts with their elements, and removes the verdicts of hidden ones. */
  #follow() {
    for (const [source, { bubble }] of [...this.#bubbles]) {
      if (source.offsetParent === null) this.#remove(source);
      else lay(bubble, source);
    }
  }
}

/** Places a bubble below its element, or above it for lack of room, and within the window. */
function lay(bubble, source) {
  const place = source.getBoundingClientRect(), size = bubble.getBoundingClientRect();
  const below = place.bottom + size.height + 8 < innerHeight;
  bubble.style.left = `${Math.max(6, Math.min(place.left, innerWidth - size.width - 6))}px`;
  bubble.style.top = `${below ? place.bottom + 4 : place.top - size.height - 4}px`;
}
