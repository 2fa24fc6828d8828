"""Who touched the ball, which side is in control of it since where, and whether a pass was received.

A touch is a contact, a hold or a kick, as the world reports it. A side is in control since one of its robots held or
kicked the ball, or touched it while nobody was: a ball that bounces off an opponent has not changed sides.
"""

import math
from typing import NamedTuple

from schemas.side import Side
from sim_host.referee.match_constants import MatchConstants
from sim_host.snapshot import Snapshot


class Touch(NamedTuple):
    """One touch: by whom, when in s, and where the ball was, m."""

    robot: str
    time: float
    place: tuple[float, float]
    kicked: bool
    """By its kicking device, in that tick."""


class Play(NamedTuple):
    """Touches since START."""

    last: Touch | None = None
    """The newest touch of all."""
    before: str | None = None
    """The other robot that touched the ball before the last one did."""
    cyan: Touch | None = None
    """The newest touch of cyan's."""
    magenta: Touch | None = None
    """The newest touch of magenta's."""
    robots: tuple[str, ...] = ()
    """Everyone who has touched the ball, in the order of their first touches."""
    control: Side | None = None
    """The side that held or kicked the ball last."""
    won: tuple[float, float] | None = None
    """m; where the ball was when that side won it."""
    received: bool = False
    """Since then a teammate has received a pass in the opponents' half, after free roll as the rule book asks."""
    rolled: float = 0.0
    """m of free roll, straight, of the last pass that was received by a teammate, in whichever half."""

    def of(self, side: Side) -> Touch | None:
        """The newest touch of a side."""
        return self.cyan if side is Side.CYAN else self.magenta

    def touched_by(self, match: MatchConstants, side: Side) -> int:
        """How many robots of a side have touched the ball."""
        return sum(match.roster.side_of(name) is side for name in self.robots)


NO_TOUCHES = Play()
"""Nobody has touched the ball."""


def play_after(match: MatchConstants, before: Play, cyan_attacks: int, snapshot: Snapshot) -> Play:
    """The touches of one more tick, taken in one by one in the order of time."""
    now = before
    for name in snapshot.touches:
        now = _touched(match, now, cyan_attacks, snapshot, name)
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
