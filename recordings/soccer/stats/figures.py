"""The figures of a match, by side and by robot, and the number of messages they are based on."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from recordings.soccer.stats.kicks import ON_GOAL, PASSES, SHOTS, KickOutcome, KickRecord
from recordings.soccer.stats.referee_calls import ScoredGoal
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side


@dataclass(slots=True)
class Coverage:
    """Numbers of messages that the figures are based on; if one is 0, the figures that need them are unknown."""

    worlds: int = 0
    touched: int = 0
    """Worlds in which a robot touched the ball."""
    held: int = 0
    """Worlds in which a robot held the ball."""
    kicks: int = 0
    states: int = 0
    events: int = 0
    missing: float = 0.0
    """Time in s without a world; it counts in no figure but the duration."""
    inferred: bool = False
    """Kicks are inferred from the positions in a log, so that those which were not found are unknown."""
    unreadable: int = 0
    """Messages that could not be decoded, and are left out."""


@dataclass(frozen=True, slots=True)
class KickCounts:
    """Outcomes of the kicks of one robot or side."""

    kicks: int
    passes: int
    passes_completed: int
    shots: int
    shots_on_goal: int
    shots_blocked: int
    goals: int
    """Goals from shots; balls that were carried or deflected into the goal are only in the score."""

    @classmethod
    def of(cls, kicks: Sequence[KickRecord]) -> "KickCounts":
        """The counts of these kicks."""
        outcomes = [kick_record.outcome for kick_record in kicks]
        return cls(
            kicks=len(outcomes),
            passes=sum(outcome in PASSES for outcome in outcomes),
            passes_completed=outcomes.count(KickOutcome.RECEIVED),
            shots=sum(outcome in SHOTS for outcome in outcomes),
            shots_on_goal=sum(outcome in ON_GOAL for outcome in outcomes),
            shots_blocked=outcomes.count(KickOutcome.BLOCKED),
            goals=outcomes.count(KickOutcome.GOAL),
        )


@dataclass(frozen=True, slots=True)
class SideFigures:
    """Figures of one side, in m, s and m/s. What the recording does not show is None."""

    team: str
    goals: int | None
    shoot_out: int | None
    """Goals of the penalty shoot-out; None without one."""
    possession: float | None
    """Fraction of the time in which either side was in control of the ball."""
    possession_s: float | None
    with_ball_s: float | None
    kicks: KickCounts | None
    saves: int | None
    dribbles: int | None
    dribbled: float | None
    distance: float
    in_play_distance: float
    top_speed: float
    mean_speed: float | None
    fouls: dict[str, int]
    """Rule → fouls."""
    cards: dict[str, int]
    restarts: dict[str, int]
    """Phase → restarts that the side took."""


@dataclass(frozen=True, slots=True)
class RobotFigures:
    """Figures of one robot, in m, s and m/s. What the recording does not show is None."""

    name: str
    side: str | None
    keeper: bool
    distance: float
    clock_distance: float
    """The part of it while the game clock ran."""
    in_play_distance: float
    top_speed: float
    mean_speed: float | None
    """While the ball was in play."""
    longest_stuck_s: float
    """Longest time for which it moved much slower than commanded, beyond the time after which the host reports that."""
    with_ball_s: float | None
    kicks: KickCounts | None
    saves: int | None
    dribbles: int | None
    dribbled: float | None
    longest_dribble: float | None
    goals: int | None
    """Goals of its own side before which it was the last to touch the ball."""
    fouls: int
    cards: dict[str, int]


@dataclass(frozen=True, slots=True)
class MatchFigures:
    """Figures of a match; times in s of simulated time."""

    match: str
    start: float
    duration: float
    in_play_s: float | None
    in_play: float | None
    """Fraction of the duration."""
    free_s: float | None
    """Time for which the ball was in play and neither side was in control."""
    crowded_s: float | None
    """Time for which three or more robots were within 1 m of the ball in play."""
    longest_crowd_s: float | None
    """The longest such time without an interruption."""
    drop_balls: int
    sides: dict[Side, SideFigures]
    robots: list[RobotFigures]
    goals: list[ScoredGoal]
    kicks: list[KickRecord]
    momentum_width: float
    """Width of one value of `momentum`, in s."""
    momentum: list[float]
    """Values from −1, all magenta's, to 1, all cyan's."""
    coverage: Coverage
    events: list[GameEvent]
    """All events of referee and host, as recorded."""

    def to_json(self) -> dict[str, Any]:
        """The figures as plain lists, numbers and strings."""
        plain: dict[str, Any] = _plain(self)
        return plain


def _plain(value: Any) -> Any:
    """Dataclasses as dictionaries, keys as strings, numbers rounded to a millionth."""
    if isinstance(value, float):
        return round(value, 6)
    if isinstance(value, GameEvent):
        return value.plain("version")
    if dataclasses.is_dataclass(value):
        return {field.name: _plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_plain(one) for one in value]
    return value
