"""What a robot believes of the pitch: its own sights fused with its teammates' radio messages.

Positions are smoothed over a few pictures. A jump (a kick, a robot that was placed, a change of sides) is taken over at
once. What a picture shows is extrapolated by its age, and what it does not show any more is remembered for a while.
Everything is in the team frame.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.opponents import Opponents
from schemas.config.rolling import Rolling
from schemas.frames import wrap
from schemas.messages.radio import Motion
from schemas.messages.sight import BallSight, ReceivedRadio, Sight
from schemas.messages.soccer.game import GameView

FRESH = 0.2
"""s; a ball seen longer ago than this by the robot itself may have been seen later by a teammate."""
LOST = 3.0
"""s; a ball that no robot of the team has seen for longer is lost, and has to be searched for."""
STALE = 1.2
"""s; a teammate's radio message older than this is ignored (NuBot's world model: 1200 ms)."""
SAME = 0.5
"""m; an obstacle this close to where a teammate should be is that teammate."""
_TRUST = 0.4
"""Weight of a new position, against the expected one."""
_TRUST_VELOCITY = 0.5
_JUMP = 0.25
"""m; a position farther from the expected one than this is not noise."""
_JUMP_SPEED = 0.8
"""m/s; a velocity of the ball that differs more from the expected one is not noise."""


class Teammate(NamedTuple):
    """A teammate by its newest radio message, extrapolated to now."""

    body: Body
    role: str
    intention: str
    pass_to: str | None


class SeenBall(NamedTuple):
    """The ball as believed now, and how many s ago any robot of the team saw it."""

    now: Ball
    age: float


class WorldBelief(NamedTuple):
    """Everything a robot believes at one tick."""

    tick: int
    dt: float
    """Simulated time in s since the sight before; 0 at the first."""
    me: Body
    holding: bool
    ball: SeenBall | None
    mates: dict[str, Teammate]
    """Teammates with recent radio messages, in the order of the team."""
    opponents: list[tuple[float, float]]
    game: GameView
    kicker_ready: bool = True

    @property
    def others(self) -> list[tuple[float, float]]:
        """Places of all other robots of both teams."""
        return [*self.opponents, *[mate.body[:2] for mate in self.mates.values()]]


def places_of(mates: Mapping[str, Teammate]) -> dict[str, tuple[float, float]]:
    """Place of each teammate."""
    return {name: mate.body[:2] for name, mate in mates.items()}


class WorldModel:
    """Takes in sights one after the other."""

    def __init__(self, briefing: Briefing) -> None:
        self._teammates = briefing.teammates
        self._rolling = Rolling.of(briefing.setup.ball)
        self._gap = briefing.setup.dribble.gap
        self._time: float | None = None
        self._me: Body | None = None
        self._ball: Ball | None = None
        self._pictured = -math.inf
        """s; when the picture was taken that the ball was last seen in."""
        self._opponents = Opponents()

    def update(self, sight: Sight) -> WorldBelief:
        """The belief after one more sight."""
        dt = sight.time - self._time if self._time is not None else 0.0
        self._time = sight.time
        self._me = me = _smooth_body(self._me, sight.self, dt)
        mates = self._mates(sight.radio, sight.game)
        ball = self._believed_ball(sight, me, dt)
        age, opponents = sight.obstacles_age, self._opponents
        if opponents.is_newer(sight.time - age):
            opponents.update(_opponents(sight, mates), sight.time - age)
        return WorldBelief(
            sight.tick, dt, me, sight.holding, ball, mates, opponents.now(age), sight.game, sight.kicker_ready
        )

    def _mates(self, radio: dict[str, ReceivedRadio], game: GameView) -> dict[str, Teammate]:
        """Teammates on the field with recent radio messages."""
        mates = {}
        records = game.robots
        for name in self._teammates:
            if name in records and records[name].off_field is not None:
                continue
            received = radio.get(name)
            if received is None or (age := received.age) > STALE or (motion := received.self) is None:
                continue
            vx, vy, omega = motion.vx, motion.vy, motion.omega
            body = Body(motion.x + vx * age, motion.y + vy * age, motion.heading + omega * age, vx, vy, omega)
            mates[name] = Teammate(body, received.role or "", received.intention or "", received.pass_to)
        return mates

    def _believed_ball(self, sight: Sight, me: Body, dt: float) -> SeenBall | None:
        own = sight.ball
        if sight.holding:
            c, s = math.cos(me.heading), math.sin(me.heading)
            self._ball = Ball(me.x + self._gap * c, me.y + self._gap * s, me.vx, me.vy)
            return SeenBall(self._ball, 0.0)
        if own is not None and own.age <= FRESH:
            self._ball = self._smooth_ball(own, sight.time, dt)
            return SeenBall(self._ball, own.age)
        self._ball = None
        last = self._freshest(own, sight.radio)
        if last is None or last.age > FRESH:
            spot = sight.game.spot
            if spot is not None:  # the referee has placed it there
                return SeenBall(Ball(spot.x, spot.y), 0.0)
        return last if last is not None and last.age <= LOST else None

    def _freshest(self, own: BallSight | None, radio: dict[str, ReceivedRadio]) -> SeenBall | None:
        """The ball as last seen by the robot or a teammate, extrapolated to now.

        A teammate sends where it believes the ball to be at the time of its message.
        """
        found: tuple[float, float, Ball] | None = None
        if own is not None:
            found = own.age, own.age, Ball(own.x, own.y, own.vx, own.vy)
        for name in self._teammates:
            received = radio.get(name)
            if received is None or received.ball is None:
                continue
            seen, age = received.ball, received.age + received.ball.age
            if found is None or age < found[0]:
                found = age, received.age, Ball(seen.x, seen.y, seen.vx, seen.vy)
        if found is None:
            return None
        age, time, ball = found
        return SeenBall(ball.after(time, self._rolling), age)

    def _smooth_ball(self, seen: BallSight, time: float, dt: float) -> Ball:
        """The own ball at `time`, s: a new picture is fused with the expected ball, an old one adds nothing."""
        pictured = time - seen.age
        is_new = pictured > self._pictured + 1e-6
        self._pictured = pictured
        if self._ball is not None and not is_new:
            return self._ball.after(dt, self._rolling)
        now = Ball(seen.x, seen.y, seen.vx, seen.vy).after(seen.age, self._rolling)
        if self._ball is None:
            return now
        expected = self._ball.after(dt, self._rolling)
        dvx, dvy = now.vx - expected.vx, now.vy - expected.vy
        dx, dy = now.x - expected.x, now.y - expected.y
        if math.hypot(dx, dy) > _JUMP or math.hypot(dvx, dvy) > _JUMP_SPEED:
            return now
        return Ball(
            expected.x + _TRUST * dx,
            expected.y + _TRUST * dy,
            expected.vx + _TRUST_VELOCITY * dvx,
            expected.vy + _TRUST_VELOCITY * dvy,
        )


def _body(motion: Motion) -> Body:
    return Body(motion.x, motion.y, motion.heading, motion.vx, motion.vy, motion.omega)


def _smooth_body(before: Body | None, seen: Motion, dt: float) -> Body:
    if before is None:
        return _body(seen)
    vx, vy, omega = seen.vx, seen.vy, seen.omega
    x, y = before.x + 0.5 * (before.vx + vx) * dt, before.y + 0.5 * (before.vy + vy) * dt
    dx, dy, turned = seen.x - x, seen.y - y, wrap(seen.heading - before.heading - omega * dt)
    if math.hypot(dx, dy) > _JUMP or abs(turned) > _JUMP:
        return _body(seen)
    return Body(x + _TRUST * dx, y + _TRUST * dy, wrap(seen.heading - (1.0 - _TRUST) * turned), vx, vy, omega)


def _opponents(sight: Sight, mates: dict[str, Teammate]) -> list[tuple[float, float]]:
    """The obstacles that are not teammates: each teammate accounts for the obstacle nearest to it, if near enough."""
    left = [(obstacle.x, obstacle.y) for obstacle in sight.obstacles]
    for mate in mates.values():
        at_x, at_y = mate.body[:2]
        best, least = -1, SAME
        for index, (x, y) in enumerate(left):
            if -least <= x - at_x <= least and (away := math.hypot(x - at_x, y - at_y)) <= least:
                best, least = index, away
        if best >= 0:
            del left[best]
    return left
