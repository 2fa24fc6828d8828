"""The result of one match of a series, as plain numbers."""

from collections.abc import Mapping
from dataclasses import dataclass

from recordings.soccer.stats.figures import MatchFigures
from schemas.side import Side
from touchline.matches.engine.outcome import Failed, Outcome
from touchline.matches.series.plan import SeedMatch, SeriesPlan


@dataclass(frozen=True, slots=True)
class TeamRow:
    """The figures of one team in a match, in m and s."""

    goals: int
    passes: int
    passes_completed: int
    shots: int
    shots_on_goal: int
    saves: int
    fouls: int
    cards: int
    possession_s: float
    field_robots: int
    """Robots without the goalkeeper."""
    field_distance: float
    """Sum of their distances while the game clock ran, in m."""


@dataclass(frozen=True, slots=True)
class MatchRow:
    """A match that was played; times in s of simulated time."""

    number: int
    identity: str
    seed: int
    swapped: bool
    """Whether the first team played in magenta."""
    teams: tuple[TeamRow, TeamRow]
    """The first team and the second."""
    playing_time: float
    """Game clock at the end less that at the beginning."""
    in_play_s: float
    crowded_s: float
    longest_crowd_s: float
    longest_stuck_s: float
    chain: str
    """The hash chain over all states: equal for equal matches."""


@dataclass(frozen=True, slots=True)
class FailedMatch:
    """A match that was not played to its end."""

    number: int
    identity: str
    seed: int
    swapped: bool
    reason: str
    """One line that names robot, tick, file and line where they are known."""


Row = MatchRow | FailedMatch


def row_of(number: int, match: SeedMatch, outcome: Outcome) -> Row:
    """The row of a match that ended so; `number` is its place in the series."""
    if isinstance(outcome, Failed):
        return FailedMatch(number, outcome.identity, match.seed, match.swapped, outcome.reason)
    figures = outcome.of_soccer
    first, second = (_team_row(figures, side) for side in match.sides)
    return MatchRow(
        number=number,
        identity=outcome.identity,
        seed=match.seed,
        swapped=match.swapped,
        teams=(first, second),
        playing_time=outcome.playing_time,
        in_play_s=figures.in_play_s or 0.0,
        crowded_s=figures.crowded_s or 0.0,
        longest_crowd_s=figures.longest_crowd_s or 0.0,
        longest_stuck_s=max((robot.longest_stuck_s for robot in figures.robots), default=0.0),
        chain=outcome.chain,
    )


def rows_of(plan: SeriesPlan, outcomes: Mapping[str, Outcome]) -> list[Row]:
    """The rows of all matches that have ended, in the order of the plan."""
    numbered = enumerate(plan.matches, start=1)
    return [row_of(number, one, outcomes[one.identity]) for number, one in numbered if one.identity in outcomes]


def _team_row(figures: MatchFigures, side: Side) -> TeamRow:
    team = figures.sides[side]
    field = [robot for robot in figures.robots if robot.side == side and not robot.keeper]
    kicked = ("passes", "passes_completed", "shots", "shots_on_goal")
    return TeamRow(
        goals=team.goals or 0,
        **{name: getattr(team.kicks, name, 0) for name in kicked},
        saves=team.saves or 0,
        fouls=sum(team.fouls.values()),
        cards=sum(team.cards.values()),
        possession_s=team.possession_s or 0.0,
        field_robots=len(field),
        field_distance=sum(robot.clock_distance for robot in field),
    )
