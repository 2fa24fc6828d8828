"""The coach's tests: what a robot does when an order has it show one skill; the same in every shipped team.

Pure: (situation, progress) → (action, progress). A robot that the order does not name stands still. The rules of the
match apply as in play: where a robot may not carry the ball that far, it releases it on the way.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

from robot_agent.sdk.bodies import Ball, DriveLimits
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.avoid import Circle, circles, go_around
from robot_agent.sdk.skills.circle import circle
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.soccer.skills.dribble_to import SPEED, TURN_RATE
from robot_agent.soccer.skills.intercept import meet, way_of
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.pass_to import pass_speed
from robot_agent.soccer.skills.receive import comes, receive
from robot_agent.soccer.skills.search import search_place
from robot_agent.soccer.skills.take_ball import HAS_IT, take_ball
from robot_agent.teams.action import Action
from schemas.config.rolling import Rolling
from schemas.frames import wrap
from schemas.messages.coach import CoachOrder, CoachTest
from schemas.messages.command import Drive, KickMode
from schemas.messages.setup import Setup
from schemas.soccer.game import Point

ROLE = "test"
ARRIVED = 0.1
"""m; a robot closer than this to a point has arrived."""
FACING = 0.1
"""rad; a robot closer than this to an angle faces it."""
RESTS = 1.0
"""s at each end of a path that is driven again and again."""
TURNS = 1.0
"""m before a point, where a robot with the ball begins to turn to the final angle; before, it faces ahead."""
ARRIVING = 2.0
"""m/s of a pass when it arrives: slower than in play, where opponents are in the way."""
PASS_ERROR, SHOT_ERROR = 0.1, 0.15
"""m beside the target, at most."""
LEAVES = 0.5
"""s after a kick; a ball that is still held then was not kicked: the kick was refused, and is tried again."""
HAS_LEFT = 1.0
"""m; a ball farther than this from its passer has left. The passer's message comes late, and the ball may swing."""
_RADIUS = 1.0
"""m; radius of the circle, if the order has none."""
_AIR = 0.1
"""m between two bodies that pass each other."""


Place = tuple[float, float]


class Situation(NamedTuple):
    """All that a robot knows in a test."""

    briefing: Briefing
    belief: WorldBelief
    order: CoachOrder
    limits: DriveLimits
    """The limits of the robot and of the order."""

    @property
    def setup(self) -> Setup:
        """The match, with this robot's own numbers."""
        return self.briefing.setup

    @property
    def me(self) -> str:
        """The robot's name."""
        return self.briefing.robot


class Progress(NamedTuple):
    """How far a robot has come with an order."""

    order: int = 0
    """Number of the order."""
    leg: int = 0
    """In `location`, the end that is driven to; for the receiver of a pass, 1 once the passer has had the ball."""
    rested: float = 0.0
    """s at that end."""
    place: Place = (0.0, 0.0)
    """m; where the robot was when the order came."""
    kicked: float | None = None
    """s since the kick; None before it."""
    passed: bool = False
    """The awaited ball has come, and this robot may get it."""


NOTHING_DONE = Progress()

StepResult = tuple[Action, Progress]
TestStep = Callable[[Situation, Progress], StepResult]


def step(now: Situation, progress: Progress) -> StepResult:
    """What this robot does in the order's test; a new order starts over."""
    if progress.order != now.order.sequence:
        progress = Progress(now.order.sequence, place=now.belief.me[:2])
    if progress.kicked is not None:
        progress = progress._replace(kicked=progress.kicked + now.belief.dt)
    test = now.order.test
    if now.me == now.order.robot_a and test in STEPS:
        return STEPS[test](now, progress)
    if now.me == now.order.robot_b and test is CoachTest.PASS:
        return _receive(now, progress)
    return _stand(now, progress)


def _stand(now: Situation, progress: Progress) -> StepResult:
    return Action(ROLE, "stand", Drive(), dribble=now.belief.holding), progress


def _move(now: Situation, progress: Progress) -> StepResult:
    order = now.order
    return _bring(now, "move", _at(order.point_a, progress), order.angle_a, with_ball=order.with_ball), progress


def _location(now: Situation, progress: Progress) -> StepResult:
    """Drive to one end, rest there, drive to the other end."""
    order, me = now.order, now.belief.me
    ends = ((_at(order.point_a, progress), order.angle_a), (_at(order.point_b, progress), order.angle_b))
    point, angle = ends[progress.leg]
    is_there = math.dist(point, me[:2]) < ARRIVED and (angle is None or abs(wrap(angle - me.heading)) < FACING)
    rested = progress.rested + now.belief.dt if is_there else 0.0
    progress = (
        progress._replace(rested=rested) if rested < RESTS else progress._replace(leg=1 - progress.leg, rested=0.0)
    )
    point, angle = ends[progress.leg]
    return _bring(now, f"move to {'ab'[progress.leg]}", point, angle, with_ball=order.with_ball), progress


def _circle(now: Situation, progress: Progress) -> StepResult:
    order = now.order
    if order.with_ball and not now.belief.holding:
        return _fetch(now), progress
    limits = now.limits.capped(SPEED, TURN_RATE) if order.with_ball else now.limits
    motion = circle(now.belief.me, _at(order.point_a, progress), order.radius or _RADIUS, limits)
    return Action(ROLE, "circle", motion, dribble=order.with_ball), progress


def _pass(now: Situation, progress: Progress) -> StepResult:
    """Get the ball, bring it to its point, and pass once."""
    order, receiver = now.order, now.order.robot_b or ""
    mate = now.belief.mates.get(receiver)
    target = _point(order.point_b) or (mate.body[:2] if mate is not None else None)
    ready = _ready_to_kick(now, progress)
    if ready is not None:
        return ready, progress
    if target is None:
        return Action(ROLE, f"wait for {receiver}", Drive(), dribble=True), progress
    speed = order.kick_speed or pass_speed(math.dist(target, now.belief.me[:2]), now.setup, ARRIVING)
    action, progress = _kick(now, progress, target, speed, PASS_ERROR, KickMode.GROUND)
    return action._replace(intention=f"pass to {receiver}", pass_to=receiver if action.kick else None), progress


def _shoot(now: Situation, progress: Progress) -> StepResult:
    """Get the ball, bring it to its point, and shoot once."""
    ready = _ready_to_kick(now, progress)
    if ready is not None:
        return ready, progress
    order, kicker = now.order, now.setup.kicker
    target = _point(order.point_b) or (now.setup.pitch.goal_line, 0.0)
    most = kicker.max_ground_speed if order.kick_mode is KickMode.GROUND else kicker.max_lob_speed
    return _kick(now, progress, target, order.kick_speed or most, SHOT_ERROR, order.kick_mode)


def _catch(now: Situation, progress: Progress) -> StepResult:
    return _await_ball(now, progress, _at(now.order.point_a, progress), now.order.angle_a)


def _receive(now: Situation, progress: Progress) -> StepResult:
    """Wait for the pass; while the other robot has the ball, do not move to it."""
    passer, ball = now.belief.mates.get(now.order.robot_a or ""), now.belief.ball
    away = math.dist(passer.body[:2], ball.now[:2]) if passer is not None and ball is not None else None
    if away is not None and away < HAS_IT:
        progress = progress._replace(leg=1)
    has_left = progress.leg == 1 and away is not None and away > HAS_LEFT
    return _await_ball(now, progress, _at(now.order.point_b, progress), now.order.angle_b, may_come=has_left)


def _await_ball(
    now: Situation, progress: Progress, point: Place, angle: float | None, *, may_come: bool = True
) -> StepResult:
    """Stand at the point and face the ball, or the angle; meet a ball that comes, get it if it stops short, keep it."""
    belief, me = now.belief, now.belief.me
    if belief.holding:
        return Action(ROLE, "caught", Drive(), dribble=True), progress
    ball = belief.ball.now if belief.ball is not None else None
    if ball is not None and may_come and comes(me, ball):
        return Action(ROLE, "catch", receive(me, ball, now.limits), dribble=True), progress._replace(passed=True)
    if progress.passed:
        return _fetch(now), progress
    if angle is None and ball is not None:
        angle = math.atan2(ball.y - me.y, ball.x - me.x)
    return Action(ROLE, "wait for the ball", _drive_to(now, point, angle, now.limits), dribble=True), progress


def _ready_to_kick(now: Situation, progress: Progress) -> Action | None:
    """The action before the kick, or after it; None when the ball is held at its point."""
    belief, point = now.belief, _point(now.order.point_a)
    if progress.kicked is not None and (progress.kicked < LEAVES or not belief.holding):
        return Action(ROLE, "kicked", Drive())
    if not belief.holding:
        return _fetch(now)
    if point is not None and math.dist(point, belief.me[:2]) > ARRIVED:
        return _bring(now, "bring the ball", point, now.order.angle_a, with_ball=True)
    return None


def _kick(now: Situation, progress: Progress, target: Place, speed: float, error: float, mode: KickMode) -> StepResult:
    motion, kick = kick_at(now.belief.me, target, speed, error, now.limits, mode)
    kick = kick if now.belief.kicker_ready else None
    return Action(ROLE, "shoot", motion, dribble=True, kick=kick), progress._replace(kicked=0.0 if kick else None)


def _bring(now: Situation, intention: str, point: Place, angle: float | None, *, with_ball: bool) -> Action:
    """Drive to a point, with the ball if `with_ball`."""
    if with_ball and not now.belief.holding:
        return _fetch(now)
    me = now.belief.me
    limits = now.limits.capped(SPEED, TURN_RATE) if with_ball else now.limits
    if with_ball and math.dist(point, me[:2]) > TURNS:
        angle = math.atan2(point[1] - me.y, point[0] - me.x)
    return Action(ROLE, intention, _drive_to(now, point, angle, limits), dribble=with_ball)


def _fetch(now: Situation) -> Action:
    """Get the ball, or search for it."""
    belief = now.belief
    if belief.ball is None:
        place = search_place(now.briefing.number, belief.game.clock, now.setup.pitch)
        return Action(ROLE, "look for the ball", _drive_to(now, place, None, now.limits))
    return Action(ROLE, "get the ball", _take(now, belief.ball.now), dribble=True)


def _take(now: Situation, ball: Ball) -> Drive:
    me, gap = now.belief.me, now.setup.dribble.gap
    meeting = meet(me, way_of(ball, Rolling.of(now.setup.ball)), gap, now.limits)
    clearance = 2.0 * now.setup.robot.reach + _AIR / 2.0
    opponents = now.belief.opponents if now.order.avoid else ()
    return take_ball(me, ball, meeting, gap, opponents, clearance, now.limits)


def _drive_to(now: Situation, point: Place, angle: float | None, limits: DriveLimits) -> Drive:
    """Drive straight or around obstacles; without an angle the heading is kept."""
    me = now.belief.me
    heading = me.heading if angle is None else angle
    return go_around(me, *point, heading, _in_the_way(now) if now.order.avoid else (), limits)


def _point(point: Point | None) -> Place | None:
    return (point.x, point.y) if point is not None else None


def _at(point: Point | None, progress: Progress) -> Place:
    """A point of the order, or where the robot was when the order came."""
    return _point(point) or progress.place


def _in_the_way(now: Situation) -> list[Circle]:
    """All other robots, and the ball while this robot does not hold it."""
    reach, ball = now.setup.robot.reach, now.belief.ball
    bodies = circles(now.belief.others, 2.0 * reach + _AIR)
    if ball is None or now.belief.holding:
        return bodies
    return [*bodies, Circle(*ball.now[:2], reach + now.setup.ball.radius + _AIR)]


STEPS: dict[CoachTest, TestStep] = {
    CoachTest.MOVE: _move,
    CoachTest.LOCATION: _location,
    CoachTest.CIRCLE: _circle,
    CoachTest.PASS: _pass,
    CoachTest.CATCH: _catch,
    CoachTest.SHOOT: _shoot,
}
"""Test → what robot A does in it; in other tests all robots stand still."""
