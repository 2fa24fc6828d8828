// The token that gives the page its role: it comes with the address once, and is kept for this tab alone.

import { keep, kept } from "../parts/storage.js";

const KEY = "touchline.token";

/** The token of the address or of this tab; it is removed from the address. */
export function tokenHere() {
  const words = new URLSearchParams(location.hash.slice(1));
  const given = words.get("token");
  if (given !== null) {
    keepToken(given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return kept("sessionStorage", KEY) ?? "";
}

/** Keeps a token for this tab; an empty one is forgotten. */
export const keepToken = (token) => keep("sessionStorage", KEY, token);
