// The token that says who sits here: it comes with the address once, and is kept for this tab alone.

const KEY = "touchline.token";

/** The token of the address or of this tab; the address keeps none. */
export function tokenHere() {
  const words = new URLSearchParams(location.hash.slice(1));
  const given = words.get("token");
  if (given !== null) {
    keepToken(given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return sessionStorage.getItem(KEY) ?? "";
}

/** Keeps a token for this tab; an empty one is forgotten. */
export function keepToken(token) {
  if (token) sessionStorage.setItem(KEY, token);
  else sessionStorage.removeItem(KEY);
}
