"""Every kick and what became of it: a pass that was received or not, a shot that went in, was saved, blocked or missed.

A kick is one that the host carried out. It is followed until another robot touches the ball, the kicker has it again,
or play stops; intent is not known, so where the ball was going and who had it next decide what it was.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from recordings.stats.aim import Aim, aim
from recordings.stats.moment import Moment
from schemas.command import KickMode
from schemas.game import EventKind
from schemas.host import Setup
from schemas.side import Side
from schemas.world import BallTruth

PASS_ROLL = 1.0
"""m between kick and receiver from which a pass counts; the league's own measure of a pass (reference 10)."""


class Outcome(StrEnum):
    """What became of a kick."""

    RECEIVED = "received"
    """A pass: a teammate was the next to touch the ball, at least `PASS_ROLL` away."""
    LOST = "lost"
    """A pass that failed: an opponent was next, or it left the pitch, or a teammate had it after less than that."""
    GOAL = "goal"
    """A shot that went in, off an opponent too."""
    SAVED = "saved"
    """A shot at the goal that whoever keeps the opponents' goal was the next to touch, and that did not go in."""
    BLOCKED = "blocked"
    """A shot that another opponent was the next to touch, and that did not go in."""
    MISSED = "missed"
    """A shot that went past, over, or did not arrive."""
    KEPT = "kept"
    """The kicker had the ball again: neither pass nor shot."""
    OWN_GOAL = "own_goal"
    """It went into the kicker's own goal: neither pass nor shot."""
    UNDECIDED = "undecided"
    """Play was stopped, or the recording ended, before anything came of it: neither pass nor shot."""


PASSES = frozenset({Outcome.RECEIVED, Outcome.LOST})
SHOTS = frozenset({Outcome.GOAL, Outcome.SAVED, Outcome.BLOCKED, Outcome.MISSED})
ON_GOAL = frozenset({Outcome.GOAL, Outcome.SAVED})


@dataclass(frozen=True, slots=True)
class KickStory:
    """One kick from beginning to end; m, m/s and s of simulated time, field frame."""

    time: float
    clock: float
    """Game clock."""
    robot: str
    side: Side
    mode: KickMode | None
    """As it was asked for; nothing where the recording does not tell."""
    x: float
    y: float
    speed: float
    """Of the ball after the tick of the kick."""
    outcome: Outcome
    by: str | None = None
    """Who had the ball next."""
    ended: float = 0.0
    """When it was decided."""


@dataclass(slots=True)
class _Flight:
    """A kick that nothing has come of yet."""

    moment: Moment
    robot: str
    side: Side
    ball: BallTruth
    aim: Aim
    released: bool = False
    """The kicker has not touched the ball for a tick."""
    stopped_by: str | None = None
    """The opponent that touched a shot, which can still go in."""
    stopped_by_keeper: bool = False
    """It kept its side's goal then."""


class Kicks:
    """Follows the ball from kick to kick."""

    def __init__(self, setup: Setup) -> None:
        self.stories: list[KickStory] = []
        self._setup = setup
        self._flight: _Flight | None = None

    def take(self, moment: Moment) -> None:
        """One more tick."""
        if moment.before is None:
            self._end(moment, Outcome.UNDECIDED)
        kicker = moment.world.kicked if moment.running else None
        touches = moment.world.touches
        if self._flight is not None and self._flight.robot not in touches:
            self._flight.released = True
        since = touches.index(kicker) if kicker in touches else len(touches)
        self._touched(moment, touches[:since] if kicker is not None else touches)
        if kicker is not None:
            self._kicked(moment, kicker, touches[since + 1 :])
        self._whistled(moment)

    def end(self, moment: Moment) -> None:
        """The recording ends with this moment."""
        flight = self._flight
        self._end(moment, _stopped(flight) if flight is not None and flight.stopped_by else Outcome.UNDECIDED)

    def _kicked(self, moment: Moment, kicker: str, touched_after: Sequence[str]) -> None:
        """A kick begins, and ends what was before: the kicker was the next to touch it."""
        self._touched(moment, [kicker])
        before = self._flight
        if before is not None:
            self._end(moment, _stopped(before) if before.stopped_by is not None else Outcome.KEPT)
        side = moment.side(kicker)
        if side is None:
            return
        ball = moment.world.ball
        if touched_after:
            ball = _as_kicked(moment, kicker)
        self._flight = _Flight(moment, kicker, side, ball, aim(ball, moment.attack(side), self._setup))
        self._touched(moment, touched_after)

    def _touched(self, moment: Moment, robots: Sequence[str]) -> None:
        flight = self._flight
        if flight is None:
            return
        for robot in robots:
            if robot == flight.stopped_by or (robot == flight.robot and not flight.released):
                continue
            if flight.stopped_by is not None:
                self._end(moment, _stopped(flight), flight.stopped_by)
            elif robot == flight.robot:
                self._end(moment, Outcome.KEPT)
            elif moment.side(robot) is flight.side:
                self._end(moment, _received(moment, flight), robot)
            elif flight.aim is Aim.ELSEWHERE:
                self._end(moment, Outcome.LOST, robot)
            else:
                flight.stopped_by, flight.stopped_by_keeper = robot, moment.keeps(robot)
                continue
            return

    def _whistled(self, moment: Moment) -> None:
        """What the referee says ends a flight."""
        flight = self._flight
        if flight is None:
            return
        goal = next((event for event in moment.events if event.kind is EventKind.GOAL), None)
        if goal is not None:
            self._end(moment, Outcome.GOAL if goal.side is flight.side else Outcome.OWN_GOAL, flight.stopped_by)
        elif moment.state is None or not moment.state.running:
            out = any(event.kind is EventKind.BALL_OUT for event in moment.events)
            if flight.stopped_by is not None:
                self._end(moment, _stopped(flight), flight.stopped_by)
            elif not out:
                self._end(moment, Outcome.UNDECIDED)
            else:
                self._end(moment, Outcome.LOST if flight.aim is Aim.ELSEWHERE else Outcome.MISSED)

    def _end(self, moment: Moment, outcome: Outcome, by: str | None = None) -> None:
        flight, self._flight = self._flight, None
        if flight is None:
            return
        began, ball = flight.moment, flight.ball
        self.stories.append(
            KickStory(
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
                ended=moment.world.time,
            )
        )


def _as_kicked(moment: Moment, kicker: str) -> BallTruth:
    """The ball as it left the kicker, along its heading, where somebody else has touched it in the same tick."""
    ball, robot = moment.world.ball, moment.world.robots.get(kicker)
    if robot is None:
        return ball
    speed = moment.kick.speed if moment.kick is not None else math.hypot(ball.vx, ball.vy)
    along = {"vx": speed * math.cos(robot.heading), "vy": speed * math.sin(robot.heading), "vz": 0.0}
    return ball.model_copy(update=along)


def _received(moment: Moment, flight: _Flight) -> Outcome:
    ball = moment.world.ball
    return (
        Outcome.RECEIVED if math.dist((ball.x, ball.y), (flight.ball.x, flight.ball.y)) >= PASS_ROLL else Outcome.LOST
    )


def _stopped(flight: _Flight) -> Outcome:
    """What a shot was that an opponent touched and that did not go in."""
    if not flight.stopped_by_keeper:
        return Outcome.BLOCKED
    return Outcome.SAVED if flight.aim is Aim.AT_GOAL else Outcome.MISSED
