"""Kicks and their outcomes: passes that were received or lost, shots that were goals, saved, blocked or missed.

A kick is one that the host carried out. It is followed until another robot touches the ball, the kicker has it again,
or play stops. The intent is not recorded: the direction of the ball and the next robot to touch it decide the outcome.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from recordings.soccer.stats.aim import Aim, aim
from recordings.soccer.stats.match_tick import MatchTick
from schemas.messages.command import KickMode
from schemas.messages.setup import Setup
from schemas.messages.world import BallTruth
from schemas.side import Side
from schemas.soccer.game import EventKind

MIN_PASS_M = 1.0
"""m between kick and receiver from which a pass counts, as in the rule book, scoring: a pass rolls for 1 m."""


class KickOutcome(StrEnum):
    """Outcome of a kick."""

    RECEIVED = "received"
    """A pass: a teammate was the next to touch the ball, at least `MIN_PASS_M` away."""
    LOST = "lost"
    """A failed pass: an opponent was next, or the ball left the pitch, or a teammate was next but too near."""
    GOAL = "goal"
    """A shot that went in, possibly off an opponent."""
    SAVED = "saved"
    """A shot on goal that the robot keeping the opponents' goal was next to touch, and that did not go in."""
    BLOCKED = "blocked"
    """A shot that another opponent was next to touch, and that did not go in."""
    MISSED = "missed"
    """A shot that went past or over the goal, or did not reach it."""
    KEPT = "kept"
    """The kicker was the next to touch the ball: neither pass nor shot."""
    OWN_GOAL = "own_goal"
    """The ball went into the kicker's own goal: neither pass nor shot."""
    UNDECIDED = "undecided"
    """Play was stopped, or the recording ended, before the outcome was clear: neither pass nor shot."""


PASSES = frozenset({KickOutcome.RECEIVED, KickOutcome.LOST})
SHOTS = frozenset({KickOutcome.GOAL, KickOutcome.SAVED, KickOutcome.BLOCKED, KickOutcome.MISSED})
ON_GOAL = frozenset({KickOutcome.GOAL, KickOutcome.SAVED})


@dataclass(frozen=True, slots=True)
class KickRecord:
    """One kick with its outcome; in m, m/s and s of simulated time, in the field frame."""

    time: float
    clock: float
    """Game clock in s."""
    robot: str
    side: Side
    mode: KickMode | None
    """Mode of the commanded kick; None if it was not recorded."""
    x: float
    y: float
    speed: float
    """Speed of the ball after the tick of the kick."""
    outcome: KickOutcome
    by: str | None = None
    """The next robot to touch the ball."""
    ended: float = 0.0
    """Time at which the outcome was clear."""


@dataclass(slots=True)
class _Flight:
    """A kick whose outcome is open."""

    match_tick: MatchTick
    robot: str
    side: Side
    ball: BallTruth
    aim: Aim
    released: bool = False
    """Whether the ball has left the kicker for a tick."""
    stopped_by: str | None = None
    """The opponent that touched a shot that can still go in."""
    stopped_by_keeper: bool = False
    """Whether that opponent kept its side's goal at that time."""


class KickTracker:
    """Follows the ball from kick to kick."""

    def __init__(self, setup: Setup) -> None:
        self.kicks: list[KickRecord] = []
        self._setup = setup
        self._flight: _Flight | None = None

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        if match_tick.before is None:
            self._end(match_tick, KickOutcome.UNDECIDED)
        kicker = match_tick.world.kicked if match_tick.running else None
        touches = match_tick.world.touches
        if self._flight is not None and self._flight.robot not in touches:
            self._flight.released = True
        since = touches.index(kicker) if kicker in touches else len(touches)
        self._on_touch(match_tick, touches[:since] if kicker is not None else touches)
        if kicker is not None:
            self._on_kick(match_tick, kicker, touches[since + 1 :])
        self._on_referee(match_tick)

    def end(self, match_tick: MatchTick) -> None:
        """Decide the open kick: the recording ends with this tick."""
        flight = self._flight
        self._end(
            match_tick, _stopped_outcome(flight) if flight is not None and flight.stopped_by else KickOutcome.UNDECIDED
        )

    def _on_kick(self, match_tick: MatchTick, kicker: str, touched_after: Sequence[str]) -> None:
        """Begin a kick; it decides the one before, as the kicker was the next to touch the ball."""
        self._on_touch(match_tick, [kicker])
        before = self._flight
        if before is not None:
            self._end(match_tick, _stopped_outcome(before) if before.stopped_by is not None else KickOutcome.KEPT)
        side = match_tick.side(kicker)
        if side is None:
            return
        ball = match_tick.world.match_ball
        if touched_after:
            ball = _ball_as_kicked(match_tick, kicker)
        self._flight = _Flight(match_tick, kicker, side, ball, aim(ball, match_tick.attack(side), self._setup))
        self._on_touch(match_tick, touched_after)

    def _on_touch(self, match_tick: MatchTick, robots: Sequence[str]) -> None:
        flight = self._flight
        if flight is None:
            return
        for robot in robots:
            if robot == flight.stopped_by or (robot == flight.robot and not flight.released):
                continue
            if flight.stopped_by is not None:
                self._end(match_tick, _stopped_outcome(flight), flight.stopped_by)
            elif robot == flight.robot:
                self._end(match_tick, KickOutcome.KEPT)
            elif match_tick.side(robot) is flight.side:
                self._end(match_tick, _pass_outcome(match_tick, flight), robot)
            elif flight.aim is Aim.ELSEWHERE:
                self._end(match_tick, KickOutcome.LOST, robot)
            else:
                flight.stopped_by, flight.stopped_by_keeper = robot, match_tick.keeps(robot)
                continue
            return

    def _on_referee(self, match_tick: MatchTick) -> None:
        """Decide the open kick if the referee has called a goal or STOP."""
        flight = self._flight
        if flight is None:
            return
        goal = next((event for event in match_tick.events if event.kind is EventKind.GOAL), None)
        if goal is not None:
            self._end(
                match_tick, KickOutcome.GOAL if goal.side is flight.side else KickOutcome.OWN_GOAL, flight.stopped_by
            )
        elif match_tick.state is None or not match_tick.state.running:
            out = any(event.kind is EventKind.BALL_OUT for event in match_tick.events)
            if flight.stopped_by is not None:
                self._end(match_tick, _stopped_outcome(flight), flight.stopped_by)
            elif not out:
                self._end(match_tick, KickOutcome.UNDECIDED)
            else:
                self._end(match_tick, KickOutcome.LOST if flight.aim is Aim.ELSEWHERE else KickOutcome.MISSED)

    def _end(self, match_tick: MatchTick, outcome: KickOutcome, by: str | None = None) -> None:
        flight, self._flight = self._flight, None
        if flight is None:
            return
        began, ball = flight.match_tick, flight.ball
        self.kicks.append(
            KickRecord(
                time=began.world.time,
                clock=began.world.clock,
                robot=flight.robot,
                side=flight.side,
                mode=began.kick.mode if began.kick is not None else None,
                x=ball.x,
                y=ball.y,
                speed=math.hypot(ball.vx, ball.vy, ball.vz),
                outcome=outcome,
                by=by if by is not None else flight.stopped_by,
                ended=match_tick.world.time,
            )
        )


def _ball_as_kicked(match_tick: MatchTick, kicker: str) -> BallTruth:
    """The ball as it left the kicker, along its heading, if another robot touched it in the same tick."""
    ball, robot = match_tick.world.match_ball, match_tick.world.robots.get(kicker)
    if robot is None:
        return ball
    speed = match_tick.kick.speed if match_tick.kick is not None else math.hypot(ball.vx, ball.vy)
    return ball.replace(vx=speed * math.cos(robot.heading), vy=speed * math.sin(robot.heading), vz=0.0)


def _pass_outcome(match_tick: MatchTick, flight: _Flight) -> KickOutcome:
    ball = match_tick.world.match_ball
    return (
        KickOutcome.RECEIVED
        if math.dist((ball.x, ball.y), (flight.ball.x, flight.ball.y)) >= MIN_PASS_M
        else KickOutcome.LOST
    )


def _stopped_outcome(flight: _Flight) -> KickOutcome:
    """Outcome of a shot that an opponent touched and that did not go in."""
    if not flight.stopped_by_keeper:
        return KickOutcome.BLOCKED
    return KickOutcome.SAVED if flight.aim is Aim.AT_GOAL else KickOutcome.MISSED
