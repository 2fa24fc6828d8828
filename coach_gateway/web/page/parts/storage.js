// What the browser keeps for this page: for a tab alone, or for the next visit.

const unkept = new Map(); // where storage is forbidden, until the page is closed

/** A text that was kept in `sessionStorage` or `localStorage`; null where none is. */
export function kept(storage, key) {
  try {
    return globalThis[storage].getItem(key);
  } catch {
    return unkept.get(key) ?? null;
  }
}

/** Keeps a text. */
export function keep(storage, key, text) {
  try {
    globalThis[storage].setItem(key, text);
  } catch {
    unkept.set(key, text);
  }
}
