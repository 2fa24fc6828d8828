// Presses of buttons that change a match: no double click counts twice, and what cannot be undone is pressed twice or held.

import { mark, setText } from "../shared/elements.js";

/** ms after a press in which another one of the same button does nothing: it belongs to a double click. */
export const APART_MS = 400;
const SURE_MS = 3000;
/** ms for which a button is held down until it counts. */
export const HOLD_MS = 1000;

/** Calls `does` for each press, but once for a double click or a key that is held down. */
export function onPress(button, does) {
  let last = -Infinity;
  ignoreRepeats(button);
  button.addEventListener("click", (event) => {
    const now = performance.now(), apart = now - last >= APART_MS;
    last = now;
    if (apart && event.detail < 2) does();
  });
}

/** Calls `does` when the button is pressed again, no sooner than 400 ms and no later than 3 s after the first press. */
export function onSecondPress(button, does) {
  const text = button.textContent;
  let first = null, ending = 0;
  const calm = () => {
    clearTimeout(ending);
    first = null;
    mark(button, "sure", false);
    setText(button, text);
  };
  ignoreRepeats(button);
  button.addEventListener("click", (event) => {
    const now = performance.now();
    if (first === null) {
      first = now;
      mark(button, "sure", true);
      setText(button, "Press again");
      ending = setTimeout(calm, SURE_MS);
    } else if (now - first >= APART_MS && event.detail < 2) {
      calm();
      does();
    }
  });
}

/** Calls `does` once the button has been held down for a second, with a mouse, a finger, or Enter. */
export function onHold(button, does) {
  const text = button.textContent;
  let waiting = 0;
  const release = () => {
    clearTimeout(waiting);
    waiting = 0;
    mark(button, "held", false);
    setText(button, text);
  };
  const hold = () => {
    if (waiting || button.disabled) return;
    mark(button, "held", true);
    setText(button, "Keep holding");
    waiting = setTimeout(() => {
      release();
      does();
    }, HOLD_MS);
  };
  mark(button, "to-hold", true);
  button.style.setProperty("--hold", `${HOLD_MS}ms`);
  button.addEventListener("pointerdown", (event) => event.button === 0 && hold());
  for (const end of ["pointerup", "pointerleave", "pointercancel", "blur"]) button.addEventListener(end, release);
  button.addEventListener("contextmenu", (event) => event.preventDefault()); // a finger that rests opens one
  button.addEventListener("keydown", (event) => event.key === "Enter" && !event.repeat && hold());
  button.addEventListener("keyup", (event) => event.key === "Enter" && release());
}

/** A key that is held down presses a button once. */
function ignoreRepeats(button) {
  button.addEventListener("keydown", (event) => event.repeat && event.preventDefault());
}
