"""Formats the figures for a terminal: a headline, tables of sides and robots, and remarks."""

from collections.abc import Callable

from recordings.soccer.stats.figures import KickCounts, MatchFigures, RobotFigures, SideFigures
from schemas.side import Side

UNKNOWN = "–"
"""Stands for a figure that the recording does not show."""

Row = tuple[str, ...]


def headline(figures: MatchFigures) -> str:
    """Teams, score, duration, and time in play."""
    cyan, magenta = figures.sides[Side.CYAN], figures.sides[Side.MAGENTA]
    played = f"{figures.duration:.1f} s recorded"
    if figures.in_play_s is not None:
        played += f", ball in play {figures.in_play_s:.1f} s ({_percent(figures.in_play)})"
    if figures.crowded_s:
        played += f", three or more robots within 1 m of it {figures.crowded_s:.1f} s"
    if cyan.shoot_out is not None:
        played = f"penalties {cyan.shoot_out} : {_whole(magenta.shoot_out)}, {played}"
    return f"{cyan.team} {_whole(cyan.goals)} : {_whole(magenta.goals)} {magenta.team}   {played}"


def side_rows(figures: MatchFigures) -> list[Row]:
    """Rows of name, cyan's value and magenta's value."""
    rows = [(name, *(format_value(figures.sides[side]) for side in Side)) for name, format_value in _SIDE]
    if figures.coverage.inferred:
        rows = [(name, *(UNKNOWN if name in _OF_KICKS and one in _NONE else one for one in row)) for name, *row in rows]
    if any(side.shoot_out is not None for side in figures.sides.values()):
        rows.insert(1, ("penalties", *(_whole(figures.sides[side].shoot_out) for side in Side)))
    for kind in _COUNTED:
        counts = [getattr(figures.sides[side], kind) for side in Side]
        for name in dict.fromkeys(name for count in counts for name in count):
            if any(count.get(name) for count in counts):
                label = _COUNTED[kind].format(name.replace("_", " "))
                rows.append((label, *(str(count.get(name, 0)) for count in counts)))
    return rows


ROBOT_HEADINGS = ("robot", "m", "top m/s", "mean m/s", "ball s", "passes", "shots", "saves", "dribbles", "stuck s")
"""Column headings for `robot_rows`."""


def robot_rows(figures: MatchFigures) -> list[Row]:
    """One row for each robot, with the columns `ROBOT_HEADINGS`."""
    return [_robot(robot) for robot in figures.robots]


def remarks(figures: MatchFigures) -> list[str]:
    """One line for each kind of evidence that is missing."""
    coverage = figures.coverage
    remarks_ = [
        (not coverage.states, "no game states recorded: ball in play, possession, passes and shots are not known"),
        (not coverage.touched, "no touches recorded: passes, shots and saves are not known"),
        (
            coverage.inferred,
            "kicks are inferred from positions: passes, shots and saves that were not found are not known",
        ),
        (not coverage.held, "no robot holds the ball: time with the ball and dribbles are not known"),
        (not coverage.events, "no events recorded: goals by robot, fouls and cards are not known"),
        (bool(coverage.missing), f"{coverage.missing:.1f} s were not recorded and are in no figure but the duration"),
        (bool(coverage.unreadable), f"{coverage.unreadable} messages could not be decoded and are in no figure"),
    ]
    return [text for holds, text in remarks_ if holds]


def _percent(share: float | None) -> str:
    return UNKNOWN if share is None else f"{100 * share:.0f} %"


def _whole(number: int | None) -> str:
    return UNKNOWN if number is None else str(number)


def _tenths(number: float | None) -> str:
    return UNKNOWN if number is None else f"{number:.1f}"


def _passes(counts: KickCounts | None, of: str = " of ") -> str:
    return UNKNOWN if counts is None else f"{counts.passes_completed}{of}{counts.passes}"


def _shots(counts: KickCounts | None, of: str = " of ") -> str:
    return UNKNOWN if counts is None else f"{counts.shots_on_goal}{of}{counts.shots}"


_SIDE: tuple[tuple[str, Callable[[SideFigures], str]], ...] = (
    ("goals", lambda side: _whole(side.goals)),
    ("possession", lambda side: _percent(side.possession)),
    ("possession, s", lambda side: _tenths(side.possession_s)),
    ("ball in hand, s", lambda side: _tenths(side.with_ball_s)),
    ("passes completed", lambda side: _passes(side.kicks)),
    ("shots on goal", lambda side: _shots(side.kicks)),
    ("shots blocked", lambda side: UNKNOWN if side.kicks is None else str(side.kicks.shots_blocked)),
    ("saves", lambda side: _whole(side.saves)),
    ("dribbles", lambda side: _whole(side.dribbles)),
    ("dribbled, m", lambda side: _tenths(side.dribbled)),
    ("distance, m", lambda side: _tenths(side.distance)),
    ("top speed, m/s", lambda side: _tenths(side.top_speed)),
    ("mean speed in play, m/s", lambda side: _tenths(side.mean_speed)),
)
"""Rows of the table of sides: name, and how its value is formatted."""
_OF_KICKS = ("passes completed", "shots on goal", "shots blocked", "saves")
_NONE = ("0", "0 of 0")
_COUNTED = {"fouls": "foul: {}", "cards": "{} cards", "restarts": "restart: {}"}
"""Fields that count by name, and the label of a row."""


def _robot(robot: RobotFigures) -> Row:
    return (
        f"{robot.name} GK" if robot.keeper else robot.name,
        _tenths(robot.distance),
        _tenths(robot.top_speed),
        _tenths(robot.mean_speed),
        _tenths(robot.with_ball_s),
        _passes(robot.kicks, "/"),
        _shots(robot.kicks, "/"),
        _whole(robot.saves),
        _whole(robot.dribbles),
        _tenths(robot.longest_stuck_s),
    )
