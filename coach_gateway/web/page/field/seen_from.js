// From which side the field is seen.

export const SEEN_FROM = [
  ["fixed", "as it lies"],
  ["turned", "turned round"],
  ["cyan", "cyan to the right"],
  ["magenta", "magenta to the right"],
];

/** −1 if the picture is turned by half a turn, otherwise 1. */
export function signOf(seenFrom, match) {
  if (seenFrom === "turned") return -1;
  return (seenFrom === "cyan" || seenFrom === "magenta") && match.attack(seenFrom) < 0 ? -1 : 1;
}
