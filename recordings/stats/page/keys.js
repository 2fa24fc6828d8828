// The keyboard: one row for each key.

/** Listens for keys, unless they are typed into a control that has its own use for them. */
export function listenForKeys(player, match, speed, jump) {
  const picture = 1 / match.rate;
  const deeds = {
    " ": () => player.toggle(),
    k: () => player.toggle(),
    ArrowLeft: (far) => player.seek(player.time - (far ? 10 : 1)),
    ArrowRight: (far) => player.seek(player.time + (far ? 10 : 1)),
    ",": () => player.seek(player.time - picture),
    ".": () => player.seek(player.time + picture),
    ArrowUp: () => changeSpeed(speed, 1),
    ArrowDown: () => changeSpeed(speed, -1),
    n: () => jump(1),
    p: () => jump(-1),
    Home: () => player.seek(match.start),
    End: () => player.seek(match.end),
  };
  document.addEventListener("keydown", (event) => {
    const deed = deeds[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const taken = event.target.matches("select, .scroll") || (event.key === " " && event.target.matches("button"));
    if (!deed || taken || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    deed(event.shiftKey);
  });
}

function changeSpeed(speed, step) {
  const next = Math.min(Math.max(speed.selectedIndex + step, 0), speed.options.length - 1);
  speed.selectedIndex = next;
  speed.dispatchEvent(new Event("change"));
}
