// Decisions that wait for people, in a place that is reserved for them: nothing else moves when one comes or goes.

import { byId, setText, show } from "../shared/elements.js";
import { proposalOf } from "../parts/proposal.js";
import { APART_MS, onPress } from "./presses.js";
import { RobotQuestion } from "./question.js";

const ANSWERS = ["confirm", "overrule"];

export class Pending {
  #proposal = null;
  #ready = 0;

  constructor(match, requests, buttons) {
    Object.assign(this, { match, requests, buttons });
    for (const id of ANSWERS) onPress(byId(id), () => requests.ask(byId(id), byId(id).textContent, "action", { action: { action: id } }));
    this.questions = ["cyan", "magenta"].map((side) => new RobotQuestion(side, match, requests, buttons));
    match.on("welcome host state event refbox", () => this.update());
  }

  /** Shows the proposal of the referee, and the question to each side, if there are any. */
  update() {
    const { match } = this, proposal = match.live ? (match.state?.proposal ?? null) : null, words = proposalOf(match);
    const asked = this.questions.filter((question) => question.update());
    if (proposal !== this.#proposal) this.#replace(proposal);
    const boxed = Boolean(match.state?.refbox);
    byId("pending").classList.toggle("officiated", boxed || asked.length > 0);
    show(byId("proposal"), proposal !== null && !(boxed && asked.length > 0)); // it could not be answered, and takes room
    setText(byId("proposed"), words?.question ?? "");
    setText(byId("proposed-why"), words?.reason ?? "");
    show(byId("nothing-pending"), proposal === null && asked.length === 0);
    this.#lock();
  }

  /** A press that was meant for the proposal before does not answer the new one. */
  #replace(proposal) {
    this.#proposal = proposal;
    this.#ready = performance.now() + APART_MS;
    setTimeout(() => this.#lock(), APART_MS + 20);
  }

  #lock() {
    const early = this.#proposal === null || performance.now() < this.#ready;
    for (const id of ANSWERS) {
      const why = this.buttons.why({ action: id });
      byId(id).disabled = early || why !== null;
      byId(id).title = why ?? "";
    }
  }
}
