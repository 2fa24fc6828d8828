// Helpers to create, find and change elements.

export const byId = (id) => document.getElementById(id);

/** An element with properties (`class`, `on`, `data`, `aria` and attributes by name) and children, texts among them. */
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === "on") for (const [event, does] of Object.entries(value)) made.addEventListener(event, does);
    else if (name === "data") Object.assign(made.dataset, value);
    else if (name === "aria") for (const [word, says] of Object.entries(value)) made.setAttribute(`aria-${word}`, says);
    else made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children);
  return made;
}

/** Sets the text of an element, unless it has that text already. */
export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

/** Shows an element, or hides it. */
export function show(node, shown) {
  if (node.hidden === shown) node.hidden = !shown;
}

/** Adds a class to an element, or removes it. */
export function mark(node, name, marked) {
  if (node.classList.contains(name) !== marked) node.classList.toggle(name, marked);
}

/** A `select` with these [value, text] pairs. */
export function choice(options, properties = {}) {
  return element("select", properties, ...options.map(([value, text]) => element("option", { value }, text)));
}

/** Puts these [value, text] pairs into a `select`, and keeps what is chosen if it is still there. */
export function offer(select, options) {
  const wanted = JSON.stringify(options);
  if (select.dataset.offers === wanted) return;
  const chosen = select.value;
  select.dataset.offers = wanted;
  select.replaceChildren(...options.map(([value, text]) => element("option", { value }, text)));
  if (options.some(([value]) => value === chosen)) select.value = chosen;
}

/** What does the work once and soon, however often it is called: many events come together at the beginning. */
export function together(does, soon = requestAnimationFrame) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    soon(() => {
      waiting = false;
      does();
    });
  };
}
