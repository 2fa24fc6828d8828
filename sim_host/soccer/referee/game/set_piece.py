"""A restart from its START until the taker's side may score: touches of the ball, and its free roll.

The evidence is the snapshot's touches, kick and possession. A touch within `KICK_DURATION` after a kick belongs to the
kick: the ball is leaving the hull.
"""

import math
from typing import NamedTuple

from schemas.config.soccer.rule_book import RuleBook
from schemas.side import Side
from schemas.soccer.game import Phase
from sim_host.snapshot import Roster, Snapshot
from sim_host.soccer.referee.game.restart import Restart, Spot

KICK_DURATION = 0.1
"""s."""


class Intrusion(NamedTuple):
    """A robot that is nearer to a restart than it may be, or in the other half at a kick-off."""

    robot: int
    """Index in the roster."""
    depth: float
    """m by which it is too near, or in the other half."""
    least: float
    """m; the smallest depth so far, from which it retreats."""
    lasted: float = 0.0
    """s, without the time in which an opponent pushes it."""
    excused: bool = False
    """It was there at START, or an opponent pushed it there: it has time to retreat."""


class PositionFault(NamedTuple):
    """A robot in a wrong position."""

    robot: str
    text: str
    """The robot and its fault, as one clause."""
    measured: float | None = None
    """m."""
    limit: float | None = None
    """m; the required value."""


class SetPiece(NamedTuple):
    """One started restart; the phase of the game shows whether the ball is in play."""

    restart: Restart
    roll_start: Spot
    """Start of the ball's free roll: its spot, or the place of its last touch."""
    rolled: float = 0.0
    """m; the longest free roll of the ball."""
    moved: float = 0.0
    """m; distance between the ball and its spot."""
    touched: tuple[str, ...] = ()
    """Robots that have touched the ball since START, each once, in order."""
    now: tuple[str, ...] = ()
    """Robots that touch the ball in this tick."""
    kicker: str | None = None
    """The robot of the taker's side that has kicked the ball."""
    since_kick: float = 0.0
    """s."""
    intrusions: tuple[Intrusion, ...] | None = None
    """Robots that are too near until the ball is in play, in the order of the roster; None before the first look."""
    appointed: str | None = None
    """At a penalty, the robot that was nearest to the ball at START, and takes it."""
    strays: tuple[PositionFault, ...] = ()
    """At a penalty, robots that were in wrong places before the kick, each once, in order."""

    @property
    def taker(self) -> str | None:
        """The first robot that touched the ball."""
        return self.touched[0] if self.touched else None

    def touchers(self, roster: Roster, side: Side) -> int:
        """Number of robots of a side that have touched the ball."""
        return sum(roster.side_of(name) is side for name in self.touched)


def started(restart: Restart) -> SetPiece:
    """The set piece at START."""
    return SetPiece(restart, restart.spot)


def set_piece_after(piece: SetPiece | None, snapshot: Snapshot, in_play: bool, dt: float) -> SetPiece | None:
    """The set piece after one more tick of `dt` s; once the ball is in play, only touches change it."""
    if piece is None or (in_play and not snapshot.touches):
        return piece
    ball, touches = (snapshot.ball.x, snapshot.ball.y), snapshot.touches
    kicker = piece.kicker or _kicker(piece, snapshot)
    new = tuple([name for name in touches if name not in piece.touched])
    return piece._replace(
        roll_start=ball if touches else piece.roll_start,
        rolled=max(piece.rolled, math.dist(piece.roll_start, ball)),
        moved=math.dist(piece.restart.spot, ball),
        touched=piece.touched + new if new else piece.touched,
        now=touches,
        kicker=kicker,
        since_kick=piece.since_kick + dt if piece.kicker is not None else 0.0,
    )


def _kicker(piece: SetPiece, snapshot: Snapshot) -> str | None:
    name = snapshot.kicked
    return name if name is not None and snapshot.roster.side_of(name) is piece.restart.side else None


def is_settled(piece: SetPiece, book: RuleBook, snapshot: Snapshot) -> bool:
    """Whether, with the ball in play, the rules of the restart no longer restrict any robot.

    Enough robots have touched the ball for a goal, or the other side has won the ball. A mere touch by the other side,
    such as a shot that grazes a defender, is not enough. A penalty at which robots strayed is settled by its outcome.
    """
    side, roster = piece.restart.side, snapshot.roster
    if side is None:
        return len(piece.touched) >= book.restarts.drop_robots_to_score
    if piece.restart.phase is Phase.PENALTY:
        return not piece.strays
    holder = snapshot.possession
    won = holder is not None and roster.side_of(holder) is not side
    return won or piece.touchers(roster, side) >= _asked(book)


def why_no_goal(piece: SetPiece | None, book: RuleBook, roster: Roster, side: Side) -> tuple[int, int] | None:
    """Robots that have touched the ball since the restart, and those that a goal of `side` requires; None if enough.

    A penalty may be scored directly. The side that does not take the restart is not restricted.
    """
    if piece is None or piece.restart.side is side.opponent or piece.restart.phase is Phase.PENALTY:
        return None
    if piece.restart.side is None:
        touched, asked = len(piece.touched), book.restarts.drop_robots_to_score
    else:
        touched, asked = piece.touchers(roster, side), _asked(book)
    return (touched, asked) if touched < asked else None


def _asked(book: RuleBook) -> int:
    """Number of robots of the taker's side that have to touch the ball before a goal counts."""
    return 1 if book.fouls.direct_goal == "off" else book.scoring.robots_touched
