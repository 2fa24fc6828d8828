"""Knock-out: the winner of each fixture goes on; where teams are missing for a full bracket, the first have a bye."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum

from touchline.matches.cup.match_result import Fixture, FixtureResult

WinnerOf = Callable[[FixtureResult, Iterable[FixtureResult]], tuple[str, str | None]]
"""The winner of a decisive fixture that is over, and the criterion that decided if it is level.

Gets the results of all earlier rounds.
"""
THIRD_PLACE = "third place"
_STAGES = {2: "final", 4: "semi-final", 8: "quarter-final"}


class Vacancy(Enum):
    """A place of a bracket without a team."""

    BYE = "bye"
    """No team: the opponent goes on."""
    OPEN = "open"
    """The team is not known yet."""


Place = str | Vacancy


@dataclass(slots=True)
class Bracket:
    """A knock-out as far as it is known."""

    rounds: list[list[tuple[Place, Place]]] = field(default_factory=list)
    """Pairs of each round from top to bottom; the last round is the final."""
    fixtures: list[Fixture] = field(default_factory=list)
    """All fixtures whose teams are known."""
    third_place: Fixture | None = None
    third: Place = Vacancy.OPEN
    """The winner of the match for third place."""
    winner: Place = Vacancy.OPEN
    decided_by: dict[str, str] = field(default_factory=dict)
    """Name of a level fixture → the criterion that decided it."""


def stage_of(size: int) -> str:
    """The name of the round with as many places: `final`, `semi-final`, `quarter-final`, `round of 16`."""
    return _STAGES.get(size, f"round of {size}")


def name_of(size: int, pair: int) -> str:
    """The name of a fixture in the round with as many places; `pair` counts from 0."""
    return stage_of(size) if size == 2 else f"{stage_of(size)} {pair + 1}"


def seeded_places(number: int) -> list[int | None]:
    """Places of a bracket from top to bottom, as seeds from 0; None for the opponent of a team with a bye.

    The first two seeds can meet in the final only, the first four in the semi-finals only.
    """
    places = [0]
    while len(places) < number:
        size = 2 * len(places)
        places = [seed for one in places for seed in (one, size - 1 - one)]
    return [seed if seed < number else None for seed in places]


def knock_out(
    seeded: Sequence[Place],
    results: Mapping[str, FixtureResult],
    winner_of: WinnerOf,
    *,
    best_of: int = 1,
    third_place: bool = False,
    before: Iterable[FixtureResult] = (),
) -> Bracket:
    """The bracket; `seeded` begins with the strongest team, `before` are results of an earlier part of the cup.

    Where both teams have forfeited, neither goes on.
    """
    bracket, earlier = Bracket(), list(before)
    line: list[Place] = [Vacancy.BYE if seed is None else seeded[seed] for seed in seeded_places(len(seeded))]

    def played(name: str, stage: str, number: int, pair: tuple[Place, Place]) -> tuple[Place, Place | None]:
        """The winner and the loser of a pair, open while it is not over; no loser where there is no match."""
        first, second = pair
        if isinstance(first, Vacancy) or isinstance(second, Vacancy):
            return _unopposed(first, second), None
        bracket.fixtures.append(Fixture(name, stage, number, (first, second), best_of, decisive=True))
        result = results.get(name)
        if result is None or not result.is_over:
            return Vacancy.OPEN, Vacancy.OPEN
        if result.is_lost_by_both:
            return Vacancy.BYE, Vacancy.BYE
        winner, criterion = winner_of(result, earlier)
        if criterion is not None:
            bracket.decided_by[name] = criterion
        return winner, second if winner == first else first

    while (size := len(line)) > 1:
        pairs, number = list(zip(line[::2], line[1::2], strict=True)), len(bracket.rounds) + 1
        bracket.rounds.append(pairs)
        ended = [played(name_of(size, place), stage_of(size), number, pair) for place, pair in enumerate(pairs)]
        earlier += [results[one.name] for one in bracket.fixtures if one.round == number and one.name in results]
        losers = [loser for _, loser in ended if loser is not None]
        if size == 4 and third_place and len(losers) == 2:
            bracket.third, _ = played(THIRD_PLACE, THIRD_PLACE, number + 1, (losers[0], losers[1]))
            bracket.third_place = next((one for one in bracket.fixtures if one.name == THIRD_PLACE), None)
        line = [winner for winner, _ in ended]
    bracket.winner = line[0]
    return bracket


def _unopposed(first: Place, second: Place) -> Place:
    """The team that goes on without a match; open while it is not known."""
    if second is Vacancy.BYE:
        return first
    return second if first is Vacancy.BYE else Vacancy.OPEN
