"""The result of one match of a tournament, and of a fixture of several matches."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from touchline.matches.statistics.ratings import Scored

Pair = tuple[int, int]
"""A number of each team, in the order of the fixture."""


@dataclass(frozen=True, slots=True)
class MatchResult:
    """One match that is over; pairs are in the order of `teams`."""

    teams: tuple[str, str]
    goals: Pair
    """Goals without the penalty shoot-out's."""
    penalties: Pair | None = None
    """Goals of the penalty shoot-out; None without one."""
    yellows: Pair = (0, 0)
    """Yellow cards."""
    reds: Pair = (0, 0)
    """Red cards."""
    forfeited_by: tuple[str, ...] = ()
    """The team that forfeited the match; both where neither could play it."""

    @property
    def winner(self) -> str | None:
        """The team with more goals, or with more penalties after as many; None for a draw."""
        for first, second in (self.goals, self.penalties or (0, 0)):
            if first != second:
                return self.teams[0 if first > second else 1]
        return None


def scored(results: Iterable[MatchResult]) -> list[Scored]:
    """What ratings count: the goals of all matches without a forfeit."""
    return [Scored(one.teams, one.goals) for one in results if not one.forfeited_by]


def score_text(result: MatchResult, of: str | None = None) -> str:
    """The score as `2 : 1`, with penalties as `1 : 1 (4 : 3)`; `of` names the team whose goals come first."""
    turn = of is not None and result.teams[0] != of
    pairs = [pair[::-1] if turn else pair for pair in (result.goals, result.penalties) if pair is not None]
    goals, *penalties = [f"{first} : {second}" for first, second in pairs]
    return f"{goals} ({penalties[0]})" if penalties else goals


@dataclass(frozen=True, slots=True)
class Fixture:
    """Two teams that meet in one or more matches, on swapped sides in each second one."""

    name: str
    """Unique in the tournament: `league 3`, `semi-final 1`."""
    stage: str
    """The part of the tournament: `league`, `group A`, `semi-final`."""
    round: int
    """Round within the stage, from 1."""
    teams: tuple[str, str]
    """The first team plays the first match in cyan."""
    best_of: int = 1
    """Most matches."""
    decisive: bool = False
    """The fixture needs a winner: it ends as soon as one team cannot be caught up with."""

    def sides(self, leg: int) -> tuple[str, str]:
        """The teams in cyan and in magenta in a match of the fixture, counted from 0."""
        return self.teams if leg % 2 == 0 else (self.teams[1], self.teams[0])


@dataclass(frozen=True, slots=True)
class FixtureResult:
    """A fixture and its matches that are over, in order."""

    fixture: Fixture
    matches: tuple[MatchResult, ...] = field(default=())

    @property
    def wins(self) -> Pair:
        """Matches won by each team."""
        winners = [match.winner for match in self.matches]
        first, second = self.fixture.teams
        return winners.count(first), winners.count(second)

    @property
    def goals(self) -> Pair:
        """Goals of each team in all matches."""
        return _sum(match.goals for match in self.matches)

    @property
    def cards(self) -> tuple[Pair, Pair]:
        """Red cards and yellow cards."""
        return _sum(match.reds for match in self.matches), _sum(match.yellows for match in self.matches)

    @property
    def legs_to_play(self) -> range:
        """Matches, counted from 0, that are certain to be played and are not over.

        In a fixture that needs a winner these are only as many as the leading team still needs.
        """
        played, most = len(self.matches), self.fixture.best_of
        if not self.fixture.decisive:
            return range(played, most)
        missing = most // 2 + 1 - max(self.wins)
        return range(played, min(most, played + max(0, missing)))

    @property
    def is_over(self) -> bool:
        """Whether no further match is to be played."""
        return not self.legs_to_play

    @property
    def is_lost_by_both(self) -> bool:
        """Whether both teams have forfeited all matches."""
        return bool(self.matches) and all(len(one.forfeited_by) == 2 for one in self.matches)

    @property
    def leader(self) -> str | None:
        """The team that won more matches, or scored more goals in a decisive fixture with as many; None if level."""
        for first, second in (self.wins, self.goals if self.fixture.decisive else (0, 0)):
            if first != second:
                return self.fixture.teams[0 if first > second else 1]
        return None


def _sum(pairs: Iterable[Pair]) -> Pair:
    listed = list(pairs)
    return sum(pair[0] for pair in listed), sum(pair[1] for pair in listed)
