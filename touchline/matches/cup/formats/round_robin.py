"""Round robin: each team meets each other one, in as few rounds as possible."""

from collections.abc import Sequence

from touchline.matches.cup.match_result import Fixture


def round_robin(
    teams: Sequence[str], stage: str, *, double: bool = False, best_of: int = 1, repeats: int = 1
) -> list[Fixture]:
    """All fixtures by round; in a double one the second half repeats the first on swapped sides.

    `repeats` is the number of times that the whole is played, on sides swapped from one to the next.
    """
    rounds = _rounds(teams)
    times = (2 if double else 1) * repeats
    fixtures: list[Fixture] = []
    for time in range(times):
        for number, pairs in enumerate(rounds, start=1 + time * len(rounds)):
            for first, second in pairs:
                both = (first, second) if time % 2 == 0 else (second, first)
                fixtures.append(Fixture(f"{stage} {len(fixtures) + 1}", stage, number, both, best_of))
    return fixtures


def _rounds(teams: Sequence[str]) -> list[list[tuple[str, str]]]:
    """Berger's tables: the last place stays, the others move; sides are balanced to one."""
    places: list[str | None] = list(teams)
    if len(places) % 2:
        places.append(None)  # the opponent of a team that rests
    size = len(places)
    rounds = []
    for number in range(size - 1):
        order = [(number * size // 2 + step) % (size - 1) for step in range(size - 1)]
        fixed, first = places[-1], places[order[0]]
        pairs = [(first, fixed) if number % 2 == 0 else (fixed, first)]
        pairs += [(places[order[step]], places[order[-step]]) for step in range(1, size // 2)]
        rounds.append([(one, other) for one, other in pairs if one is not None and other is not None])
    return rounds
