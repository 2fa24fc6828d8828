// Keyboard control: one row for each key.

/** Handles keys, unless the focused control uses them itself. */
export function listenForKeys(player, match, speed, jump) {
  const frame = 1 / match.rate;
  const actions = {
    " ": () => player.toggle(),
    k: () => player.toggle(),
    ArrowLeft: (withShift) => player.seek(player.time - (withShift ? 10 : 1)),
    ArrowRight: (withShift) => player.seek(player.time + (withShift ? 10 : 1)),
    ",": () => player.seek(player.time - frame),
    ".": () => player.seek(player.time + frame),
    ArrowUp: () => changeSpeed(speed, 1),
    ArrowDown: () => changeSpeed(speed, -1),
    n: () => jump(1),
    p: () => jump(-1),
    Home: () => player.seek(match.start),
    End: () => player.seek(match.end),
  };
  document.addEventListener("keydown", (event) => {
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const hasOwnUse = event.target.matches("select, .scroll") || (event.key === " " && event.target.matches("button"));
    if (!action || hasOwnUse || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action(event.shiftKey);
  });
}

function changeSpeed(speed, step) {
  const next = Math.min(Math.max(speed.selectedIndex + step, 0), speed.options.length - 1);
  speed.selectedIndex = next;
  speed.dispatchEvent(new Event("change"));
}
