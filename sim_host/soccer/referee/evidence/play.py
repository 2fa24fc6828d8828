"""The play since START: touches of the ball, the side in control, and received passes.

A touch is a contact, a hold or a kick, as the world reports it, in the order of time and force. A side gains control
when one of its robots holds or kicks the ball, or touches it while no side has control. A ball that bounces off an
opponent does not change control.
"""

import math
from typing import NamedTuple

from schemas.side import Side
from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.match_constants import MatchConstants


class Touch(NamedTuple):
    """One touch: the robot, the time in s, and the place of the ball in m."""

    robot: str
    time: float
    place: tuple[float, float]
    kicked: bool
    """The robot kicked the ball in that tick."""


class Play(NamedTuple):
    """Touches since START."""

    last: Touch | None = None
    """The last touch by any robot."""
    before: str | None = None
    """The last other robot that touched the ball before the robot of the last touch."""
    cyan: Touch | None = None
    """Cyan's last touch."""
    magenta: Touch | None = None
    """Magenta's last touch."""
    robots: tuple[str, ...] = ()
    """All robots that have touched the ball, in the order of their first touches."""
    control: Side | None = None
    """The side in control of the ball."""
    won: tuple[float, float] | None = None
    """m; place of the ball when that side gained control."""
    received: bool = False
    """Since then, a teammate has received a pass in the opponents' half, after the free roll that the book requires."""
    rolled: float = 0.0
    """m; straight free roll of the last pass that a teammate has received, in either half."""
    level: tuple[str, ...] = ()
    """Robots of both sides whose last touches were at the same time and equally hard; empty if one was the last."""

    def of(self, side: Side) -> Touch | None:
        """The last touch of a side."""
        return self.cyan if side is Side.CYAN else self.magenta


NO_TOUCHES = Play()
"""No robot has touched the ball."""


def play_after(match: MatchConstants, before: Play, cyan_attacks: int, snapshot: Snapshot) -> Play:
    """The play after the touches of one more tick, in the order of time."""
    now = before
    for name in snapshot.touches:
        now = _touched(match, now, cyan_attacks, snapshot, name)
    if snapshot.level and len({match.roster.side_of(name) for name in snapshot.level}) > 1:
        return now._replace(level=snapshot.level)
    return now


def _touched(match: MatchConstants, before: Play, cyan_attacks: int, snapshot: Snapshot, name: str) -> Play:
    ball, side = snapshot.ball, match.roster.side_of(name)
    place = (ball.x, ball.y)
    kicked = snapshot.kicked == name
    touch = Touch(name, snapshot.time, place, kicked)
    control, won, received, rolled = before.control, before.won, before.received, before.rolled
    if control is not side and (control is None or kicked or snapshot.possession == name):
        control, won, received, rolled = side, place, False, 0.0
    elif control is side:
        own = before.of(side)
        if own is not None and own.robot != name:
            roll = math.dist(own.place, place)
            if roll >= match.book.scoring.pass_roll:
                rolled = roll
                received = received or place[0] * side.attack(cyan_attacks) > 0
    last, other = before.last, before.before
    return Play(
        last=touch,
        before=last.robot if last is not None and last.robot != name else other,
        cyan=touch if side is Side.CYAN else before.cyan,
        magenta=touch if side is Side.MAGENTA else before.magenta,
        robots=before.robots if name in before.robots else (*before.robots, name),
        control=control,
        won=won,
        received=received,
        rolled=rolled,
    )
