"""Swiss: in each round teams with as many points meet, and no two teams meet twice."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache

from touchline.matches.cup.match_result import Fixture, FixtureResult

STAGE = "swiss"
Ranked = Callable[[Sequence[FixtureResult], Sequence[str]], list[str]]
"""The teams, best first, after these results, and with these byes: one entry for each."""


@dataclass(slots=True)
class SwissRounds:
    """A Swiss tournament as far as it is known."""

    fixtures: list[Fixture] = field(default_factory=list)
    byes: list[str] = field(default_factory=list)
    """The team of each round that rests and gets the points of a win, where the number of teams is odd."""


def most_rounds(teams: int) -> int:
    """The number of rounds that can be paired for certain without a repetition, whatever the results."""
    return (teams + 1) // 2


def swiss(
    teams: Sequence[str], rounds: int, results: Mapping[str, FixtureResult], ranked: Ranked, *, best_of: int = 1
) -> SwissRounds:
    """All rounds whose pairs are known: each follows from the results of all before it."""
    known = SwissRounds()
    for number in range(1, rounds + 1):
        before = [results[one.name] for one in known.fixtures if one.name in results]
        if len(before) < len(known.fixtures) or not all(one.is_over for one in before):
            break
        order: list[str | None] = list(teams) if number == 1 else list(ranked(before, known.byes))
        met = {frozenset[str | None](one.teams) for one in known.fixtures}
        if len(order) % 2:
            order.append(None)
            met |= {frozenset((team, None)) for team in known.byes}
        if number == 1:  # the upper half meets the lower half
            half = len(order) // 2
            order = [team for pair in zip(order[:half], order[half:], strict=True) for team in pair]
        for pair in _pairs(order, met):
            first, second = _by_sides(pair, known.fixtures)
            if second is None:
                known.byes.append(first)
                continue
            name = f"{STAGE} {len(known.fixtures) + 1}"
            known.fixtures.append(Fixture(name, STAGE, number, (first, second), best_of))
    return known


def _pairs(order: Sequence[str | None], met: Collection[frozenset[str | None]]) -> list[tuple[str | None, str | None]]:
    """Pairs of neighbours in the order, as near as possible, none of which has met; None rests a team."""

    @cache  # many ways to pair the first teams leave the same others
    def pairs(first: str | None, *others: str | None) -> list[tuple[str | None, str | None]]:
        for place, second in enumerate(others):
            rest = (*others[:place], *others[place + 1 :])
            if frozenset((first, second)) not in met and (not rest or pairs(*rest)):
                return [(first, second), *(pairs(*rest) if rest else ())]
        return []

    return pairs(*order)


def _by_sides(pair: tuple[str | None, str | None], before: Sequence[Fixture]) -> tuple[str, str | None]:
    """The team that was in cyan less often first; a rest is second."""
    first, second = pair if pair[0] is not None else (pair[1], pair[0])
    assert first is not None
    if second is None:
        return first, None
    times = [sum(one.teams[0] == team for one in before) for team in (first, second)]
    return (first, second) if times[0] <= times[1] else (second, first)
