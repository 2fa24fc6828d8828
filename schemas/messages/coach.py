"""What a coach tells a side: the paper's coach record in SI units, sequence-numbered, and who has taken it in."""

import math
from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.faults import Fault, FaultError, FaultKind
from schemas.game import Point
from schemas.message import Message, Name
from schemas.messages.command import KickMode, KickSpeed, ShortText
from schemas.struct import StructMessage, check

MAX_SEQUENCE = 2**53 - 1
"""The largest whole number that every language reads exactly from JSON."""
MAX_SEQUENCE_STEP = 2**51
"""How far an order may be numbered beyond the one that stands: a clock in microseconds since 1970 fits in, a slip that
would leave no number for anybody's next order does not."""
MAX_DISTANCE = 100.0
"""m from the centre mark; a point farther away is a fault of the sender, perhaps of its units."""

Angle = Annotated[float, Meta(ge=-2.0 * math.pi, le=2.0 * math.pi, extra={"unit": "rad"})]
"""rad; more than a whole turn is a fault of the sender, perhaps of its units."""


class CoachMode(StrEnum):
    """What the team shall do while the game allows it."""

    PLAY = "play"
    HOLD = "hold"
    PARK = "park"
    TEST = "test"
    """One of the tests, by the robots that the order names; all others stand still."""


class CoachTest(StrEnum):
    """What robots do in test mode; `robot_a` acts, and in a pass `robot_b`, too."""

    STOP = "stop"
    """Everybody stands still."""
    MOVE = "move"
    """Drive to `point_a` and face `angle_a`, there and on the way."""
    LOCATION = "location"
    """Drive from `point_a` to `point_b` and back, over and over: what a robot takes for one place is seen to be one."""
    CIRCLE = "circle"
    """Drive round `point_a` at `radius`, counter-clockwise and facing ahead."""
    PASS = "pass"
    """Get the ball, with a `point_a` bring it there, and pass to `robot_b`, who waits at `point_b` or where it is."""
    CATCH = "catch"
    """Wait at `point_a`, or where one is, and stop a ball that comes."""
    SHOOT = "shoot"
    """Get the ball, with a `point_a` bring it there, and kick it at `point_b`, or at the middle of the goal."""
    MACHINE = "machine"
    """Run the paper's behaviour machine once; it dribbles to `point_a` and comes back to `point_b`, or to its own."""


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
"""Test → the fields of an order that it cannot do without."""


class CoachOrder(StructMessage, frozen=True, kw_only=True):
    """A standing order; the newest counts, and each robot acknowledges it by its number. All in the team frame.

    It carries the paper's coach record but for match mode and previous mode: what is played is the referee's to say,
    and every sight has it. The record's two static passes are tactics, its kick force is a speed.
    """

    sequence: Annotated[int, Meta(ge=1, le=MAX_SEQUENCE)]
    """Larger than that of every order before it, whoever gave that; the setup tells which stands."""
    mode: CoachMode = CoachMode.PLAY
    test: CoachTest | None = None
    """Which test; given in the mode `test`, and in no other."""
    tactic: ShortText = ""
    """A word that the team's own code understands."""
    point_a: Point | None = None
    """m, at most 100 from the centre mark, as `point_b`."""
    point_b: Point | None = None
    angle_a: Angle | None = None
    """rad; where to face at `point_a`."""
    angle_b: Angle | None = None
    """rad; where to face at `point_b`."""
    robot_a: Name | None = None
    """Who acts in a test."""
    robot_b: Name | None = None
    """Who receives a pass in a test."""
    radius: Annotated[float, Meta(gt=0, le=20, extra={"unit": "m"})] | None = None
    """m; of the circle in a test."""
    with_ball: bool = False
    """Tests of motion: get the ball first, and bring it along."""
    avoid: bool = False
    """Tests: go around whatever is in the way; otherwise straight on."""
    kick_speed: KickSpeed | None = None
    """m/s; otherwise as the distance of a pass asks for, and for a shot as fast as can be."""
    kick_mode: KickMode = KickMode.GROUND
    """How a test shoots."""
    max_speed: Annotated[float, Meta(gt=0, le=20, extra={"unit": "m/s"})] | None = None
    """m/s; what no robot of the side exceeds, in any mode; a circle is driven at it."""
    max_turn_rate: Annotated[float, Meta(gt=0, le=50, extra={"unit": "rad/s"})] | None = None
    """rad/s; likewise."""

    def refusal_after(self, active: "CoachOrder | None") -> str:
        """Why it does not take the place of the one that stands, or nothing."""
        before = active.sequence if active is not None else 0
        if self.sequence <= before:
            return f"sequence {self.sequence} is not after {before}, which stands; number orders from {before + 1} on"
        if self.sequence - before > MAX_SEQUENCE_STEP:
            return f"sequence {self.sequence} leaves no room for later orders; number them from {before + 1} on"
        return ""

    def __post_init__(self) -> None:
        check(self)
        broken = self._broken_rule()
        if broken:
            raise FaultError(Fault((), None, broken, FaultKind.RULE))

    def _broken_rule(self) -> str:
        """What about its fields does not go together, in one sentence; else nothing."""
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
    """A side's standing order, and which of its robots have taken it in."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    order: CoachOrder
    """The order in force."""
    acknowledged: dict[Name, bool]
    """Robot → whether its newest command acknowledges this very order; all robots of the side that an agent moves."""
