"""Tie-breaks: the criteria that rank teams with as many points, in the order of a rule book."""

import hashlib
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby

from touchline.matches.cup.match_result import FixtureResult
from touchline.matches.cup.standings import Points, Standing, sums

LOT = "lot"
DIRECT = "direct match"
FEWEST_MATCHES = "fewest matches"
ORDERS: Mapping[str, tuple[str, ...]] = {
    "msl-2016": (FEWEST_MATCHES, "goal difference", "goals", DIRECT, "challenge", LOT),
    "china-sim-2020": ("fewest reds", "fewest yellows", "goal difference", LOT),
}
"""Rule book → its criteria, after points. The China simulation league names its order for knock-outs only."""
DEFAULT_ORDER = "msl-2016"


@dataclass(frozen=True, slots=True)
class Ranking:
    """How teams are ranked."""

    order: tuple[str, ...] = ORDERS[DEFAULT_ORDER]
    points: Points = field(default_factory=Points)
    challenge: Mapping[str, float] = field(default_factory=dict)
    """Points of the technical challenge, by team; 0 for others."""
    seed: int = 1
    """Seed of the lot."""


@dataclass(frozen=True, slots=True)
class _Tied:
    """The teams that are still level, and all that criteria look at."""

    teams: tuple[str, ...]
    rows: Mapping[str, Standing]
    results: Sequence[FixtureResult]
    ranking: Ranking


Key = Callable[[_Tied, str], tuple[float, ...]]


def _lot(tied: _Tied, team: str) -> tuple[float, ...]:
    digest = hashlib.blake2b(f"{tied.ranking.seed} {team}".encode(), digest_size=6).digest()
    return (int.from_bytes(digest, "big"),)


def _direct(tied: _Tied, team: str) -> tuple[float, ...]:
    """Points, goal difference and goals in the matches between the teams that are level."""
    row = sums(tied.teams, tied.results, tied.ranking.points)[team]
    return row.points, row.goal_difference, row.goals_for


CRITERIA: Mapping[str, Key] = {
    FEWEST_MATCHES: lambda tied, team: (-tied.rows[team].played,),
    "goal difference": lambda tied, team: (tied.rows[team].goal_difference,),
    "goals": lambda tied, team: (tied.rows[team].goals_for,),
    DIRECT: _direct,
    "challenge": lambda tied, team: (tied.ranking.challenge.get(team, 0.0),),
    "fewest reds": lambda tied, team: (-tied.rows[team].reds,),
    "fewest yellows": lambda tied, team: (-tied.rows[team].yellows,),
    LOT: _lot,
}
"""Criterion → its value for a team; the greater one is ranked first."""


def table(
    teams: Sequence[str],
    results: Sequence[FixtureResult],
    ranking: Ranking,
    byes: Sequence[str] = (),
    refused: Collection[str] = (),
) -> list[Standing]:
    """The ranked table of these teams; refused ones have played nothing, and are last."""
    rows = sums(teams, results, ranking.points, byes)

    def first_of_all(team: str) -> tuple[bool, int]:
        return team in refused, -rows[team].points

    ranked: list[Standing] = []
    for _, level in groupby(sorted(teams, key=first_of_all), key=first_of_all):
        ranked += _separated(_Tied(tuple(level), rows, results, ranking), ranking.order)
    for place, row in enumerate(ranked, start=1):
        row.place = place
    return ranked


def winner_of(result: FixtureResult, earlier: Sequence[FixtureResult], ranking: Ranking) -> tuple[str, str | None]:
    """The winner of a decisive fixture, and the criterion that decided if it is level.

    A level fixture is decided by what both teams have done in the cup, and then by lot.
    """
    if result.leader is not None:
        return result.leader, None
    teams = result.fixture.teams
    known = (*earlier, result)
    rows = sums([team for one in known for team in one.fixture.teams], known, ranking.points)
    order = tuple(name for name in ranking.order if name not in (FEWEST_MATCHES, DIRECT))
    first = _separated(_Tied(teams, rows, (), ranking), order)[0]
    return first.team, first.decided_by


def _separated(tied: _Tied, order: Sequence[str]) -> list[Standing]:
    """The rows of level teams, best first.

    A criterion that separates some of them leaves smaller groups, which go on with the next one. The direct match
    begins again within such a group: among fewer teams its small table is another one.
    """
    rows = [tied.rows[team] for team in tied.teams]
    if len(rows) == 1:
        return rows
    names = (*order, *(() if LOT in order else (LOT,)))
    for place, name in enumerate(names):
        keys = {team: CRITERIA[name](tied, team) for team in tied.teams}
        if len(set(keys.values())) == 1:
            continue
        rest = names[place if name == DIRECT else place + 1 :]
        ranked: list[Standing] = []
        for _, level in groupby(sorted(tied.teams, key=keys.__getitem__, reverse=True), key=keys.__getitem__):
            part = _Tied(tuple(level), tied.rows, tied.results, tied.ranking)
            if ranked:
                ranked[-1].decided_by = name
            ranked += _separated(part, rest)
        return ranked
    return rows
