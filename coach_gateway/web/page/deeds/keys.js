// The keys of the page. The space bar stops wherever the focus is, except where a text is typed.

import { byId } from "../shared/elements.js";

/** Keys and what they do, for the help. */
export const KEYS = [
  ["space", "stop: the match, or your own side; in a recording, pause and play; in a text, a space"],
  ["?", "this list"],
  ["v", "see the field from another side", "of-match"],
  ["[ ]", "choose the previous or next robot", "of-match"],
  ["esc", "cancel picking, dragging and driving", "of-match"],
  ["n p", "recording: next event, previous event", "of-match"],
  ["← →", "recording: 1 s back or forward, with shift 10 s"],
  [", .", "recording: one frame back or forward"],
  ["w a s d, arrows", "driving: ahead, left, back, right", "of-match"],
  ["q e", "driving: turn left, turn right", "of-match"],
  ["z", "driving: dribbler on or off", "of-soccer"],
  ["k l", "driving: kick along the ground, lob", "of-soccer"],
  ["enter", "press the button, or switch the box, that has the focus"],
];
const FRAME_S = 0.02;

export function listenForKeys({ match, buttons, manualControl, drag, replay, layers, selection }) {
  const typed = {
    "?": () => byId("help").showModal(),
    v: () => layers.turn(),
    "[": () => chooseNext(match, selection, -1),
    "]": () => chooseNext(match, selection, 1),
  };
  const replayed = {
    n: () => replay.jump(1),
    p: () => replay.jump(-1),
    ".": () => replay.step(),
    ",": () => replay.seek(replay.time - FRAME_S),
    ArrowLeft: (event) => replay.seek(replay.time - (event.shiftKey ? 10 : 1)),
    ArrowRight: (event) => replay.seek(replay.time + (event.shiftKey ? 10 : 1)),
  };
  const stops = () => (match.live ? match.may("stop") || match.may("order", match.role) : match.may("replay"));

  addEventListener("keydown", (event) => {
    if (event.code === "Space" && stops() && !isWriting(event.target)) {
      event.preventDefault();
      if (event.repeat) return;
      manualControl.giveBack();
      if (match.live) buttons.stop();
      else replay.toggle();
      return;
    }
    if (event.key === "Escape") {
      drag.cancel();
      manualControl.giveBack();
      return;
    }
    if (event.key === "Enter" && event.target.type === "checkbox") event.target.click();
    if (isTyping(event.target)) return;
    if (manualControl.key(event, true)) return event.preventDefault();
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const winds = !match.live && match.may("replay") && event.target.type !== "range";
    const does = typed[event.key] ?? (winds ? replayed[event.key] : undefined);
    if (does === undefined) return;
    event.preventDefault();
    does(event);
  }, { capture: true });
  addEventListener("keyup", (event) => {
    if (event.code === "Space" && stops() && !isWriting(event.target)) event.preventDefault(); // otherwise a button with the focus would be pressed, too
    manualControl.key(event, false);
  }, { capture: true });
}

/** Whether keys are typed into a field. */
const isTyping = (target) => target.matches?.("input:not([type=checkbox]):not([type=range]), select, textarea") ?? false;

/** Whether a space is typed into a text. A number has none: there the space bar stops. */
const isWriting = (target) => target.matches?.("input[type=text]:not([inputmode=decimal]), input[type=search], input[type=password], textarea") ?? false;

function chooseNext(match, selection, step) {
  const all = match.robots;
  const place = all.indexOf(selection.robot);
  selection.choose(all[place < 0 ? (step > 0 ? 0 : all.length - 1) : (place + step + all.length) % all.length] ?? null);
}
