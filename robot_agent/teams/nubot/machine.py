"""The paper's behaviour state machine (figure 5): its states, its transition table, and what each state does.

Knows one robot, one ball and a goal: no teammates, no opponents, no rules. Time advances by the ticks' durations, not
by a constant.
"""

import math
from collections.abc import Callable
from enum import StrEnum
from typing import NamedTuple

from robot_agent.sdk.bodies import Body
from robot_agent.teams.nubot.trajectory import ROTATION, TRANSLATION
from schemas.config.sections import Pitch
from schemas.frames import wrap
from schemas.messages.command import Kick, KickMode

REACH = 0.40
"""m, centre to centre; CHASE_BALL ends here."""
ARRIVED = 0.1
"""m; a robot closer than this to a point has arrived."""
FACING = math.radians(0.5)
"""rad in total, half of it to either side; a robot within it faces a direction."""
MOVED = 0.5
"""m; a target that has moved farther than this is planned for again."""
KICK = Kick(mode=KickMode.LOB, speed=20.0)
"""m/s; the paper's kick_ball_vel."""
_KEEP = 4.0
"""1/s; how strongly the heading is kept while translating."""


class State(StrEnum):
    """The behaviour states; DRIBBLE_BALL has two sub-states."""

    CHASE_BALL = "CHASE_BALL"
    MOVE_BALL = "DRIBBLE_BALL/MOVE_BALL"
    ROTATE_BALL = "DRIBBLE_BALL/ROTATE_BALL"
    KICK_BALL = "KICK_BALL"
    RESET = "RESET"
    HOME = "HOME"


class Points(NamedTuple):
    """Where the machine goes and shoots, m, team frame; by default the paper's, on its pitch of 18 × 12 m."""

    dribble: tuple[float, float] = (4.0, -2.0)
    goal: tuple[float, float] = (9.0, 0.0)
    reset: tuple[float, float] = (-4.0, -2.0)

    def on(self, pitch: Pitch) -> "Points":
        """The same points on another pitch."""
        along, across = pitch.length / 18.0, pitch.width / 12.0
        return Points(*((x * along, y * across) for x, y in self))


class Situation(NamedTuple):
    """The input of the machine at one tick."""

    me: Body
    ball: tuple[float, float]
    holding: bool
    dt: float
    """s since the tick before."""
    world_reset: bool = False
    kicker_ready: bool = True


class MachineOutput(NamedTuple):
    """The output of the machine at one tick: velocity in the team frame, m/s and rad/s."""

    vx: float = 0.0
    vy: float = 0.0
    omega: float = 0.0
    dribble: bool = False
    kick: Kick | None = None


Condition = Callable[[Situation, Points], bool]


def ball_in_reach(now: Situation, points: Points) -> bool:
    """The ball is within the paper's distance, or held: robots wider than the threshold touch the ball before."""
    del points
    return now.holding or math.dist(now.ball, now.me[:2]) <= REACH


def hold_lost(now: Situation, points: Points) -> bool:
    """The hold condition is not met, or another robot has the ball."""
    del points
    return not now.holding


def at_dribble_point(now: Situation, points: Points) -> bool:
    """The robot has brought the ball to the point of its shot."""
    return math.dist(points.dribble, now.me[:2]) <= ARRIVED


def facing_goal(now: Situation, points: Points) -> bool:
    """The kick axis points at the goal's centre, and the kicker is charged (the paper's always is)."""
    return now.kicker_ready and abs(_error(now.me, points.goal)) <= FACING / 2.0


def at_once(now: Situation, points: Points) -> bool:
    """Always, without waiting."""
    del now, points
    return True


def at_reset_point(now: Situation, points: Points) -> bool:
    """The robot is back at its reset point."""
    return math.dist(points.reset, now.me[:2]) <= ARRIVED


def world_reset(now: Situation, points: Points) -> bool:
    """The world was reset: in Gazebo by Reset World, in a match when the ball is the robot's own again."""
    del points
    return now.world_reset


class Transition(NamedTuple):
    """One transition."""

    state: State
    condition: Condition
    next: State


TRANSITIONS = (
    Transition(State.CHASE_BALL, ball_in_reach, State.MOVE_BALL),
    Transition(State.MOVE_BALL, hold_lost, State.CHASE_BALL),
    Transition(State.MOVE_BALL, at_dribble_point, State.ROTATE_BALL),
    Transition(State.ROTATE_BALL, hold_lost, State.CHASE_BALL),
    Transition(State.ROTATE_BALL, facing_goal, State.KICK_BALL),
    Transition(State.KICK_BALL, at_once, State.RESET),
    Transition(State.RESET, at_reset_point, State.HOME),
    Transition(State.HOME, world_reset, State.CHASE_BALL),
)
"""All transitions; the first row of a state whose condition holds is taken, one per tick."""


class Machine:
    """One run through the states, tick by tick."""

    def __init__(self, points: Points) -> None:
        self.points = points
        self._enter(State.CHASE_BALL)

    def restart(self) -> None:
        """Go back to CHASE_BALL from any state."""
        self._enter(State.CHASE_BALL)

    def step(self, now: Situation) -> MachineOutput:
        """Take the transition that is due, and do what the state does."""
        for row in TRANSITIONS:
            if row.state is self.state and row.condition(now, self.points):
                self._enter(row.next)
                break
        match self.state:
            case State.CHASE_BALL:
                return self._chase(now)
            case State.MOVE_BALL:
                return MachineOutput(*self._translate(now, self.points.dribble), dribble=True)
            case State.ROTATE_BALL:
                return MachineOutput(omega=self._turn(now, self.points.goal), dribble=True)
            case State.KICK_BALL:
                return MachineOutput(dribble=True, kick=KICK)
            case State.RESET:
                return MachineOutput(*self._translate(now, self.points.reset))
            case State.HOME:
                return MachineOutput()

    def _enter(self, state: State) -> None:
        self.state = state
        self._target = (math.inf, math.inf)
        self._speed = self._rate = 0.0
        self._faced = False

    def _chase(self, now: Situation) -> MachineOutput:
        """Rotate toward the ball, then translate to it; start over, keeping the speeds, when the ball has moved."""
        if not math.dist(now.ball, self._target) <= MOVED:
            self._target, self._faced = now.ball, False
        self._faced = self._faced or abs(_error(now.me, now.ball)) <= FACING / 2.0
        if not self._faced:
            self._speed = 0.0
            return MachineOutput(omega=self._turn(now, now.ball), dribble=True)
        vx, vy = self._translate(now, now.ball)
        keep = max(-ROTATION.top, min(ROTATION.top, _KEEP * _error(now.me, now.ball)))
        return MachineOutput(vx, vy, keep, dribble=True)

    def _turn(self, now: Situation, target: tuple[float, float]) -> float:
        error = _error(now.me, target)
        if abs(error) <= FACING / 2.0:
            self._rate = 0.0
            return 0.0
        self._rate = ROTATION.next_speed(self._rate, abs(error), now.dt)
        return math.copysign(self._rate, error)

    def _translate(self, now: Situation, target: tuple[float, float]) -> tuple[float, float]:
        dx, dy = target[0] - now.me.x, target[1] - now.me.y
        left = math.hypot(dx, dy)
        if left < 1e-6:
            return 0.0, 0.0
        self._speed = TRANSLATION.next_speed(self._speed, left, now.dt)
        return self._speed * dx / left, self._speed * dy / left


def _error(me: Body, target: tuple[float, float]) -> float:
    """How far to turn to face a point, rad."""
    return wrap(math.atan2(target[1] - me.y, target[0] - me.x) - me.heading)
