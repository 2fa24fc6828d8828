"""The figures of a match, by side and by robot, and the number of messages they are based on."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from recordings.container.lineup import Lineup
from recordings.soccer.stats.ball_control import BallControl
from recordings.soccer.stats.crowding import Crowding
from recordings.soccer.stats.dribbles import DribbleStats
from recordings.soccer.stats.kicks import ON_GOAL, PASSES, SHOTS, KickOutcome, KickRecord
from recordings.soccer.stats.momentum import Momentum
from recordings.soccer.stats.motion import MotionStats
from recordings.soccer.stats.referee_calls import RefereeCalls, ScoredGoal
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from schemas.soccer.game import Card


@dataclass(frozen=True, slots=True)
class Coverage:
    """Numbers of messages that the figures are based on; if one is 0, the figures that need them are unknown."""

    worlds: int
    touched: int
    """Worlds in which a robot touched the ball."""
    held: int
    """Worlds in which a robot held the ball."""
    kicks: int
    states: int
    events: int
    missing: float
    """Time in s without a world; it counts in no figure but the duration."""
    unreadable: int
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


@dataclass(frozen=True, slots=True)
class FigureBuilder:
    """Arranges all that was counted, by side and robot."""

    setup: Setup
    lineup: Lineup
    extent: tuple[float, float]
    """Times of the first and the last world, in s."""
    coverage: Coverage
    control: BallControl
    crowding: Crowding
    motions: dict[str, MotionStats]
    dribbles: dict[str, DribbleStats]
    kicks: list[KickRecord]
    calls: RefereeCalls
    momentum: Momentum

    def figures(self) -> MatchFigures:
        """The figures of the match."""
        teams, (first, last), states = self.setup.teams, self.extent, self.coverage.states
        duration, in_play = last - first, self.control.in_play if states else None
        controlled = sum(self.control.seconds.values())
        return MatchFigures(
            match=self.setup.match,
            start=first,
            duration=duration,
            in_play_s=in_play,
            in_play=in_play / duration if in_play is not None and duration > 0 else None,
            free_s=max(0.0, in_play - controlled) if in_play is not None and self.knows_ball else None,
            crowded_s=self.crowding.seconds if states else None,
            longest_crowd_s=self.crowding.longest if states else None,
            drop_balls=sum(count for (side, _), count in self.calls.restarts.items() if side is None),
            sides={side: self.side(side, teams[side].name if side in teams else side.value) for side in Side},
            robots=[self.robot(name) for name in self.motions],
            goals=self.calls.goals,
            kicks=self.kicks,
            momentum_width=self.momentum.width,
            momentum=self.momentum.values(),
            coverage=self.coverage,
            events=self.calls.events,
        )

    @property
    def knows_ball(self) -> bool:
        """Whether possession is known: game states are recorded, and touches or holds of the ball."""
        return bool(self.coverage.states and (self.coverage.touched or self.coverage.held))

    @property
    def knows_kicks(self) -> bool:
        """Whether outcomes of kicks are known: game states and touches are recorded."""
        return bool(self.coverage.states and self.coverage.touched)

    def side(self, side: Side, team: str) -> SideFigures:
        """The figures of one side, with the name of its team."""
        names = [name for name in self.motions if self.lineup.side(name) is side]
        motions = [self.motions[name] for name in names]
        dribbles = [self.dribbles[name] for name in names if name in self.dribbles]
        in_play = sum(motion.in_play for motion in motions)
        in_play_distance = sum(motion.in_play_distance for motion in motions)
        controlled, score, shoot_out = sum(self.control.seconds.values()), self.calls.score, self.calls.shoot_out
        return SideFigures(
            team=team,
            goals=score.of(side) if score is not None else None,
            shoot_out=shoot_out.of(side) if shoot_out is not None else None,
            possession=self.control.seconds[side] / controlled if controlled > 0 else None,
            possession_s=self.control.seconds[side] if self.knows_ball else None,
            with_ball_s=sum(self.control.with_ball.get(name, 0.0) for name in names) if self.coverage.held else None,
            kicks=self._kicks([kick_record for kick_record in self.kicks if kick_record.side is side]),
            saves=self._saves(names),
            dribbles=sum(one.count for one in dribbles) if self.coverage.held else None,
            dribbled=sum(one.distance for one in dribbles) if self.coverage.held else None,
            distance=sum(motion.distance for motion in motions),
            in_play_distance=in_play_distance,
            top_speed=max((motion.top_speed for motion in motions), default=0.0),
            mean_speed=in_play_distance / in_play if in_play > 0 else None,
            fouls={rule: count for (of, rule), count in self.calls.fouls.items() if of is side},
            cards={card.value: self.calls.cards[side, card] for card in Card},
            restarts={phase.value: count for (of, phase), count in self.calls.restarts.items() if of is side},
        )

    def robot(self, name: str) -> RobotFigures:
        """The figures of one robot."""
        motion, dribbles, side = (
            self.motions[name],
            self.dribbles.get(name, DribbleStats()),
            self.lineup.side(name),
        )
        held = bool(self.coverage.held)
        goals = sum(goal.robot == name and goal.side is side for goal in self.calls.goals)
        return RobotFigures(
            name=name,
            side=side.value if side is not None else None,
            keeper=self.lineup.is_keeper(name),
            distance=motion.distance,
            clock_distance=motion.clock_distance,
            in_play_distance=motion.in_play_distance,
            top_speed=motion.top_speed,
            mean_speed=motion.mean_speed if motion.in_play > 0 else None,
            longest_stuck_s=motion.longest_stuck,
            with_ball_s=self.control.with_ball.get(name, 0.0) if held else None,
            kicks=self._kicks([kick_record for kick_record in self.kicks if kick_record.robot == name]),
            saves=self._saves([name]),
            dribbles=dribbles.count if held else None,
            dribbled=dribbles.distance if held else None,
            longest_dribble=dribbles.longest if held else None,
            goals=goals if self.coverage.events else None,
            fouls=self.calls.fouls_of[name],
            cards={card.value: self.calls.cards_of[name, card] for card in Card},
        )

    def _kicks(self, kicks: list[KickRecord]) -> KickCounts | None:
        return KickCounts.of(kicks) if self.knows_kicks else None

    def _saves(self, names: Sequence[str]) -> int | None:
        if not self.knows_kicks:
            return None
        return sum(kick_record.outcome is KickOutcome.SAVED and kick_record.by in names for kick_record in self.kicks)


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
