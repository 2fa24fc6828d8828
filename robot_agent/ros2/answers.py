"""Which commands of ROS 2 nodes answer which sights of one robot. Pure.

A TwistStamped answers the sight of its stamp, a Twist the newest sight that has no answer. A robot brakes where no
valid command drives it: without a node, with two, and at a stamp from the future.
"""

import math
from collections import Counter
from collections.abc import Callable
from enum import StrEnum

from msgspec import Struct

from robot_agent.ros2.velocity import Velocity
from schemas.messages.command import Command, Drive, Kick
from schemas.messages.sight import Sight
from schemas.wire.faults import FaultError

_ROUNDING_NS = 1000
"""By which a stamp may be below the time of its tick: nodes may compute it from seconds as a float."""
_CONTEST_NS = 500_000_000
"""Simulated time for which a node that has sent a command counts as one that drives the robot."""
_REST = Command(answers_tick=0)


class Fault(StrEnum):
    """What was wrong with commands; each is counted, and reported once."""

    UNANSWERED = "unanswered"
    LATE = "late"
    EXCESS = "excess"
    FUTURE = "future stamp"
    INVALID = "invalid"
    CONTESTED = "two nodes"
    OTHER_TYPE = "other type"
    LEFT = "left"


class SightHead(Struct, frozen=True, gc=False):
    """The fields of a `Sight` that an answer needs; decoding skips the others."""

    tick: int
    time: float
    holding: bool
    kicker_ready: bool = True


class Answers:
    """The answers of one robot in one match."""

    def __init__(
        self,
        tick_s: float,
        report: Callable[[Fault, str], None],
        counts: Counter[str],
        *,
        is_lockstep: bool,
        every: int = 1,
    ) -> None:
        """`report` is told of the first fault of each kind, with a sentence; `counts` counts all.

        `every` as in `Ros2Settings`.
        """
        self.sight: Sight | SightHead | None = None
        """The newest sight."""
        self.counts = counts
        self.is_driven = False
        """Whether a node publishes commands."""
        self.dribble = False
        self._tick_ns = round(tick_s * 1e9)
        self._report = report
        self._is_lockstep, self._every = is_lockstep, every
        self._is_open = False
        """The newest sight has no answer yet."""
        self._answered = -1
        """Newest tick with an answer."""
        self._drive = Drive()
        self._kick: Kick | None = None
        self._driver, self._driven_at = b"", -math.inf
        self._contested_until = -math.inf

    def see(self, sight: Sight | SightHead) -> Command | None:
        """A new sight, and its answer if it has one without a node; None while it waits for one."""
        if self._is_lockstep and self._is_open and self.sight is not None:
            self._note(Fault.UNANSWERED, f"no command answers tick {self.sight.tick}")
        self.sight, self._is_open = sight, True
        if not self.is_driven:
            return self._brake()
        if self._is_lockstep and sight.tick % self._every:
            return self._answer(self._drive, sight.tick)
        return None

    def command(self, velocity: Velocity, driver: bytes, who: str) -> Command | None:
        """The answer that a node's command is; None if it is none.

        `driver` is the identity of the publisher, and `who` its name for reports.
        """
        sight = self.sight
        if sight is None:
            return None
        now = round(sight.time * 1e9)
        if self._driver not in (b"", driver) and now - self._driven_at <= _CONTEST_NS:
            self._contested_until = now + _CONTEST_NS
            self._note(Fault.CONTESTED, f"{who} drives it, and another node does; it brakes until one of them is left")
        self._driver, self._driven_at = driver, now
        stamp_ns = velocity.stamp_ns
        if stamp_ns < 0:
            return self.refuse(f"{who} stamps a command with a time before the start of the match")
        tick = (stamp_ns + _ROUNDING_NS) // self._tick_ns if stamp_ns else sight.tick
        if stamp_ns > now + _ROUNDING_NS:
            ahead = (stamp_ns - now) * 1e-9
            self._note(Fault.FUTURE, f"{who} stamps a command {ahead:.3f} s ahead of /clock; use_sim_time is off?")
            return self._brake()
        if now <= self._contested_until:
            return self._brake()
        if tick <= self._answered:
            self._note(Fault.EXCESS, f"{who} sends a command for tick {tick}, which has one; the first one counts")
            return None
        if self._is_lockstep and tick < sight.tick:
            self._note(Fault.LATE, f"{who} answers tick {tick}, and the match is at {sight.tick}")
        try:
            drive = Drive(vx=velocity.vx, vy=velocity.vy, omega=velocity.omega)
        except FaultError as error:
            return self.refuse(f"{who}: {error}")
        return self._answer(drive, tick)

    def refuse(self, reason: str) -> Command | None:
        """Count a message that is no command, and brake."""
        self._note(Fault.INVALID, reason)
        return self._brake()

    def kick(self, kick: Kick) -> str:
        """Kick with the next command; why that is impossible, or empty."""
        sight = self.sight
        if sight is None or not sight.holding:
            return "the robot does not hold the ball"
        if not sight.kicker_ready:
            return "the kicker is not charged"
        self._kick = kick
        return ""

    def driven(self, is_driven: bool) -> Command | None:
        """The first node that drives the robot has come, or the last one has left; the answer to a sight that waits."""
        was, self.is_driven = self.is_driven, is_driven
        if was and not is_driven:
            self._note(Fault.LEFT, "no node drives it any more")
            return self._brake()
        return None

    def _note(self, fault: Fault, sentence: str) -> None:
        self.counts[fault] += 1
        if self.counts[fault] == 1:
            self._report(fault, sentence)

    def _brake(self) -> Command | None:
        """The answer of a robot that brakes, if the newest sight waits for one."""
        if not self._is_open or self.sight is None:
            return None
        return self._answer(Drive(), self.sight.tick)

    def _answer(self, drive: Drive, tick: int) -> Command:
        self._is_open = self.sight is not None and tick < self.sight.tick
        self._answered, self._drive = tick, drive
        kick, self._kick = self._kick, None
        return _REST.replace(answers_tick=tick, drive=drive, dribble=self.dribble, kick=kick)  # all of them are checked
