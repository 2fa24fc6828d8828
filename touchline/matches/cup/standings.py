"""A table: the sums of each team's results, ranked by points and the tie-breaks of a rule book."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from touchline.matches.cup.match_result import FixtureResult


@dataclass(frozen=True, slots=True)
class Points:
    """The points of a fixture."""

    win: int = 3
    draw: int = 1
    loss: int = 0


@dataclass(slots=True)
class Standing:
    """The row of a team in a table."""

    team: str
    played: int = 0
    """Fixtures; a bye is none."""
    won: int = 0
    drawn: int = 0
    lost: int = 0
    goals_for: int = 0
    goals_against: int = 0
    points: int = 0
    reds: int = 0
    yellows: int = 0
    byes: int = 0
    """Rounds without an opponent, with the points of a win."""
    place: int = 0
    """From 1; 0 before the table is ranked."""
    decided_by: str | None = field(default=None)
    """The tie-break that separates the team from the next one; None where points do."""

    @property
    def goal_difference(self) -> int:
        """Goals for less goals against."""
        return self.goals_for - self.goals_against


def sums(
    teams: Sequence[str], results: Iterable[FixtureResult], points: Points, byes: Sequence[str] = ()
) -> dict[str, Standing]:
    """The rows of these teams, not ranked; fixtures against other teams are left out."""
    rows = {team: Standing(team) for team in teams}
    for result in results:
        if not (set(result.fixture.teams) <= rows.keys() and result.is_over):
            continue
        leader, reds_and_yellows = result.leader, result.cards
        for place, team in enumerate(result.fixture.teams):
            row = rows[team]
            row.played += 1
            row.won += leader == team
            is_drawn = leader is None and not result.is_lost_by_both
            row.drawn += is_drawn
            row.lost += leader != team and not is_drawn
            row.points += points.win if leader == team else points.draw if is_drawn else points.loss
            row.goals_for += result.goals[place]
            row.goals_against += result.goals[1 - place]
            row.reds += reds_and_yellows[0][place]
            row.yellows += reds_and_yellows[1][place]
    for team in byes:
        rows[team].byes += 1
        rows[team].points += points.win
    return rows
