"""Orders from a coach to its side, numbered in sequence, and which robots have acknowledged them."""

import math
from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.config.sections import Pitch
from schemas.messages.command import KickMode, KickSpeed
from schemas.soccer.game import Point
from schemas.wire.checked import Checked
from schemas.wire.message import Message, Name, ShortText
from schemas.wire.units import MAX_WHOLE

MAX_SEQUENCE_STEP = 2**51
"""How far an order's number may exceed the number of the order in force. A clock in microseconds since 1970 fits in; a
mistake that would leave no number for the next order does not."""
MAX_DISTANCE = 100.0
"""m from the centre mark; a point farther away is an error of the sender, perhaps of its units."""

Angle = Annotated[float, Meta(ge=-2.0 * math.pi, le=2.0 * math.pi, extra={"unit": "rad"})]
"""rad; more than a whole turn is an error of the sender, perhaps of its units."""


class CoachMode(StrEnum):
    """What the team does while the game allows it."""

    PLAY = "play"
    HOLD = "hold"
    PARK = "park"
    TEST = "test"
    """Run a test with the robots that the order names; all others stand still."""


class CoachTest(StrEnum):
    """What robots do in test mode; `robot_a` acts, and in a pass `robot_b` as well."""

    STOP = "stop"
    """All robots stand still."""
    MOVE = "move"
    """Drive to `point_a`, facing `angle_a` on the way and there."""
    LOCATION = "location"
    """Drive between `point_a` and `point_b` repeatedly, which shows how well the robot localizes itself."""
    CIRCLE = "circle"
    """Drive around `point_a` at `radius`, counter-clockwise, facing ahead."""
    PASS = "pass"
    """Get the ball, bring it to `point_a` where that is given, and pass to `robot_b`, which waits at `point_b` or where
    it is."""
    CATCH = "catch"
    """Wait at `point_a`, or where the robot is, and stop an approaching ball."""
    SHOOT = "shoot"
    """Get the ball, bring it to `point_a` where that is given, and kick it at `point_b`, by default at the middle of
    the goal."""
    MACHINE = "machine"
    """Run the paper's behaviour machine once; it dribbles to `point_a` and returns to `point_b`, by default to points
    of its own."""


REQUIRED_FIELDS: dict[CoachTest, tuple[str, ...]] = {
    CoachTest.STOP: (),
    CoachTest.MOVE: ("robot_a", "point_a"),
    CoachTest.LOCATION: ("robot_a", "point_a", "point_b"),
    CoachTest.CIRCLE: ("robot_a", "point_a", "radius"),
    CoachTest.PASS: ("robot_a", "robot_b"),
    CoachTest.CATCH: ("robot_a",),
    CoachTest.SHOOT: ("robot_a",),
    CoachTest.MACHINE: ("robot_a",),
}
"""Test → the fields of an order that it requires."""


class CoachOrder(Message, metaclass=Checked):
    """A standing order to a side, in its team frame; the newest is in force, and each robot acknowledges its number.

    It carries the coach record of the paper in SI units, except match mode and previous mode: the referee decides what
    is played, and every sight has it. The record's two static passes are tactics here, its kick force is a speed.
    """

    sequence: Annotated[int, Meta(ge=1, le=MAX_WHOLE)]
    """Larger than the number of every earlier order to the side, from any sender; the setup has the number in force."""
    mode: CoachMode = CoachMode.PLAY
    """What the team does while the game allows it."""
    test: CoachTest | None = None
    """Which test to run; required in the mode `test`, None in every other."""
    tactic: ShortText = ""
    """Name of a tactic; the team's own code defines the values."""
    point_a: Point | None = None
    """First point of a test, in the team frame, in m; at most 100 m from the centre mark."""
    point_b: Point | None = None
    """Second point of a test, in the team frame, in m; at most 100 m from the centre mark."""
    angle_a: Angle | None = None
    """Heading at `point_a` in the team frame, in rad."""
    angle_b: Angle | None = None
    """Heading at `point_b` in the team frame, in rad."""
    robot_a: Name | None = None
    """The robot that acts in a test."""
    robot_b: Name | None = None
    """The robot that receives a pass in a test."""
    radius: Annotated[float, Meta(gt=0, le=20, extra={"unit": "m"})] | None = None
    """Radius of the circle in a test, in m."""
    with_ball: bool = False
    """Tests of motion: get the ball first, and dribble it along."""
    avoid: bool = False
    """Tests: drive around obstacles; otherwise straight on."""
    kick_speed: KickSpeed | None = None
    """Speed of a test's pass or shot, in m/s; None for a speed that suits the distance of a pass, and for the fastest
    shot."""
    kick_mode: KickMode = KickMode.GROUND
    """How a test kicks."""
    max_speed: Annotated[float, Meta(gt=0, le=20, extra={"unit": "m/s"})] | None = None
    """Speed that no robot of the side exceeds, in any mode, in m/s; a circle is driven at it. None for no limit."""
    max_turn_rate: Annotated[float, Meta(gt=0, le=50, extra={"unit": "rad/s"})] | None = None
    """Turn rate that no robot of the side exceeds, in any mode, in rad/s; None for no limit."""

    def refusal_after(self, active: "CoachOrder | None") -> str:
        """Why this order cannot replace the one in force; empty where it can."""
        before = active.sequence if active is not None else 0
        if self.sequence <= before:
            start = before + 1
            return f"sequence {self.sequence} is not above {before}, which is in force; number orders from {start} on"
        if self.sequence - before > MAX_SEQUENCE_STEP:
            return f"sequence {self.sequence} leaves no room for later orders; number them from {before + 1} on"
        return ""

    def refusal_on(self, pitch: Pitch) -> str:
        """Why this order cannot be carried out on that pitch; empty where it can."""
        x, y = pitch.goal_line + pitch.border, pitch.touch_line + pitch.border
        circled = self.radius or 0.0 if self.test is CoachTest.CIRCLE else 0.0
        for name, point, around in (("point_a", self.point_a, circled), ("point_b", self.point_b, 0.0)):
            if point is not None and (abs(point.x) + around > x or abs(point.y) + around > y):
                what = f"a circle of {around:g} m around {name}" if around else name
                return (
                    f"{what} at ({point.x:g}, {point.y:g}) is outside the field and its border; "
                    f"|x| is at most {x:g} m, |y| at most {y:g} m"
                )
        return ""

    def __post_init__(self) -> None:
        broken = self._broken_rule()
        if broken:
            raise ValueError(broken)

    def _broken_rule(self) -> str:
        """Which fields contradict each other, in one sentence; empty where none do."""
        if (self.test is not None) != (self.mode is CoachMode.TEST):
            known = ", ".join(CoachTest)
            what = f"needs a test, one of {known}" if self.test is None else f"has no test; leave out {self.test.value}"
            return f"the mode {self.mode.value} {what}"
        missing = (
            [name for name in REQUIRED_FIELDS.get(self.test, ()) if getattr(self, name) is None] if self.test else []
        )
        if self.test is not None and missing:
            return f"the test {self.test.value} needs {' and '.join(missing)}"
        if self.test is CoachTest.PASS and self.robot_a == self.robot_b:
            return f"the test pass needs two robots, and both are {self.robot_a}"
        for name, point in (("point_a", self.point_a), ("point_b", self.point_b)):
            if point is not None and math.hypot(point.x, point.y) > MAX_DISTANCE:
                return f"{name} is {point.x:g}, {point.y:g}, farther than {MAX_DISTANCE:g} m from the centre mark"
        return ""


class ActiveOrder(Message):
    """A side's order in force, and which of its robots have acknowledged it."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    order: CoachOrder
    """The order in force."""
    acknowledged: dict[Name, bool]
    """Robot → whether its newest command acknowledges this order; all robots of the side that have an agent."""
    refused: dict[Name, ShortText] = {}
    """Robot that has acknowledged this order and does not carry it out → the reason."""
