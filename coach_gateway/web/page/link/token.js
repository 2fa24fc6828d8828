// The token that gives the page its role: it comes with the address once, and is kept for this tab alone.

const KEY = "touchline.token";
let unkept = ""; // where storage is forbidden

/** The token of the address or of this tab; it is removed from the address. */
export function tokenHere() {
  const words = new URLSearchParams(location.hash.slice(1));
  const given = words.get("token");
  if (given !== null) {
    keepToken(given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return storage()?.getItem(KEY) ?? unkept;
}

/** Keeps a token for this tab; an empty one is forgotten. */
export function keepToken(token) {
  unkept = token;
  if (token) storage()?.setItem(KEY, token);
  else storage()?.removeItem(KEY);
}

/** The storage of this tab; null where it is forbidden. */
function storage() {
  try {
    return sessionStorage;
  } catch {
    return null;
  }
}
