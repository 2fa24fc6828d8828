"""Positions before START: distances from the ball, own halves at a kick-off, areas at a penalty.

The taker is the robot of its side nearest to the ball. In its own penalty area, but outside the goal area, one defender
besides the goalkeeper may stand nearer than the others. No robot may stand on the ball's spot. Robots off the field are
ignored.

Section: restarts.
Measures: the distance between the ball's spot and the robot's hull, taken as the smallest circle around it.
Not judged: robots that move between START and the kick; they may encroach.
"""

import math
from collections.abc import Callable, Collection, Mapping
from typing import NamedTuple

from schemas.soccer.game import GameStage, Phase
from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.areas import in_goal_area, in_penalty_area
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.game.set_piece import PositionFault, SetPiece
from sim_host.soccer.referee.match_constants import MatchConstants

MAX_OVERLAP = 0.02
"""m that a hull may overlap the ball on its spot, since a taker may touch it."""


class Violation(NamedTuple):
    """A violation by one robot's position: a phrase, and the measured and the required value in m."""

    phrase: str
    measured: float | None = None
    limit: float | None = None

    @property
    def depth(self) -> float:
        """m between the measured and the required value."""
        return 0.0 if self.measured is None or self.limit is None else abs(self.limit - self.measured)


class LineUp(NamedTuple):
    """The positions of the robots before a restart; robots by their index in the roster."""

    match: MatchConstants
    state: RefereeState
    restart: Restart
    snapshot: Snapshot
    on_field: tuple[int, ...]
    """Robots on the field."""
    kicker: int | None
    """The robot of the taker's side nearest to the ball; None at a drop ball."""
    free: tuple[int, ...]
    """Defenders that may stand near the ball before their own goal."""
    waiting: Collection[str] = ()
    """Robots that will leave their places."""

    def own_end(self, index: int) -> int:
        """Sign of the x of the goal that a robot defends."""
        return -self.state.attack(self.match.roster.sides[index])

    def is_keeper(self, index: int) -> bool:
        """Whether a robot keeps its side's goal."""
        return self.match.keepers(self.state.participation.absences)[index]

    def takes(self, index: int) -> bool:
        """Whether a robot is on the side that takes the restart."""
        return self.match.roster.sides[index] is self.restart.side


def position_faults(
    match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot
) -> tuple[PositionFault, ...]:
    """The robots in wrong positions for the restart, each with its first fault, in the order of the roster."""
    line_up = line_up_of(match, state, restart, snapshot)
    checks = checks_of(state, restart)
    faults = []
    for index in line_up.on_field:
        for check in checks:
            violation = check(line_up, index)
            if violation is not None:
                name = match.roster.names[index]
                faults.append(
                    PositionFault(name, f"{name} stands {violation.phrase}", violation.measured, violation.limit)
                )
                break
    return tuple(faults)


def distance_violations(
    match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot
) -> dict[int, Violation]:
    """Robots nearer to the ball's spot than they may be, and at a kick-off those in the other half; not the taker.

    By their indices in the roster, in its order. Not for penalties, which have places of their own.
    """
    if not _may_be_too_near(match, restart, snapshot):
        return {}
    line_up = line_up_of(match, state, restart, snapshot)
    checks = (_in_other_half, _near_ball) if restart.phase is Phase.KICK_OFF else (_near_ball,)
    found = {}
    for index in line_up.on_field:
        if index == line_up.kicker:
            continue
        violations = [violation for check in checks if (violation := check(line_up, index)) is not None]
        if violations:
            found[index] = max(violations, key=lambda violation: violation.depth)
    return found


def _may_be_too_near(match: MatchConstants, restart: Restart, snapshot: Snapshot) -> bool:
    """Whether any robot but one may be too near; cheap, because it is asked in every tick until the ball is in play."""
    numbers, (x, y) = match.book.restarts, restart.spot
    sides, reaches, takers = match.roster.sides, match.reaches, 0
    for index, robot in enumerate(snapshot.robots):
        mine = sides[index] is restart.side
        room = (numbers.teammate_distance if mine else numbers.opponent_distance) + reaches[index]
        dx, dy = robot[0] - x, robot[1] - y
        if dx * dx + dy * dy < room * room:
            takers += mine
            if not mine or takers > 1:
                return True
    return restart.phase is Phase.KICK_OFF


def kicker_of(match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot) -> str | None:
    """The robot that takes a restart: of its side, the nearest to the ball."""
    index = line_up_of(match, state, restart, snapshot).kicker
    return None if index is None else match.roster.names[index]


def penalty_faults(
    match: MatchConstants, state: RefereeState, piece: SetPiece, snapshot: Snapshot
) -> tuple[PositionFault, ...]:
    """The robots other than the kicker in wrong places for a started penalty, in the order of the roster."""
    line_up = line_up_of(match, state, piece.restart, snapshot)
    if piece.appointed in match.roster.names:
        line_up = line_up._replace(kicker=match.roster.names.index(piece.appointed))
    check = _wrong_at_shoot_out if state.stage is GameStage.SHOOT_OUT else _wrong_at_penalty
    faults = []
    for index in line_up.on_field:
        violation = None if index == line_up.kicker else check(line_up, index)
        if violation is not None:
            name = match.roster.names[index]
            text = f"{name} was {violation.phrase} before the kick"
            faults.append(PositionFault(name, text, violation.measured, violation.limit))
    return tuple(faults)


def is_spot_covered(match: MatchConstants, state: RefereeState, spot: Spot, snapshot: Snapshot) -> bool:
    """Whether a robot stands on a spot, so that the ball cannot be placed there."""
    line_up = line_up_of(match, state, Restart(state.phase, state.side, spot), snapshot)
    return any(_on_spot(line_up, index) for index in line_up.on_field)


def line_up_of(match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot) -> LineUp:
    """The line-up before a restart."""
    away = state.participation.absences
    on_field = tuple([index for index, name in enumerate(match.roster.names) if name not in away])
    line_up = LineUp(match, state, restart, snapshot, on_field, None, ())
    return line_up._replace(kicker=_kicker(line_up), free=_free_defenders(line_up))


def _kicker(line_up: LineUp) -> int | None:
    own = [index for index in line_up.on_field if line_up.takes(index)]
    return min(own, key=lambda index: _from_ball(line_up, index), default=None)


def _free_defenders(line_up: LineUp) -> tuple[int, ...]:
    """The goalkeeper in its penalty area (ours), one more defender outside the goal area (rule book, set pieces)."""
    match, robots = line_up.match, line_up.snapshot.robots
    inside = [
        index
        for index in line_up.on_field
        if not line_up.takes(index)
        and in_penalty_area(match.pitch, line_up.own_end(index), robots[index].x, robots[index].y)
    ]
    keepers = [index for index in inside if line_up.is_keeper(index)]
    others = [
        index
        for index in inside
        if index not in keepers
        and not in_goal_area(match.pitch, line_up.own_end(index), robots[index].x, robots[index].y)
    ]
    nearest = sorted(others, key=lambda index: _from_ball(line_up, index))[:1]
    return (*keepers, *nearest)


def _from_ball(line_up: LineUp, index: int) -> float:
    """m between the ball's spot and the robot's hull."""
    robot = line_up.snapshot.robots[index]
    return math.dist(line_up.restart.spot, (robot.x, robot.y)) - line_up.match.reaches[index]


def min_distance(line_up: LineUp, index: int) -> float:
    """m; required distance from the ball for a robot other than the kicker."""
    numbers = line_up.match.book.restarts
    if line_up.restart.phase is Phase.DROP_BALL:
        return numbers.drop_ball_distance
    is_mate = line_up.takes(index) and line_up.restart.phase is not Phase.PENALTY
    return numbers.teammate_distance if is_mate else numbers.opponent_distance


def _near_ball(line_up: LineUp, index: int) -> Violation | None:
    is_dropped = line_up.restart.phase is Phase.DROP_BALL
    if not is_dropped and (index == line_up.kicker or index in line_up.free):
        return None
    distance, required = _from_ball(line_up, index), min_distance(line_up, index)
    if distance >= required:
        return None
    return Violation(f"{distance:.2f} m from the ball, {required:.2f} m required", distance, required)


def _on_spot(line_up: LineUp, index: int) -> Violation | None:
    """No hull may cover the ball's spot, not even the kicker's."""
    room = line_up.match.ball.radius - MAX_OVERLAP
    distance = _from_ball(line_up, index)
    return Violation("on the ball's spot", distance, room) if distance < room else None


def _in_other_half(line_up: LineUp, index: int) -> Violation | None:
    """A robot has to be in its own half with its whole hull, the kicker with its centre."""
    hull = 0.0 if index == line_up.kicker else line_up.match.reaches[index]
    over = hull - line_up.snapshot.robots[index].x * line_up.own_end(index)
    return Violation(f"{over:.2f} m in the other half", over, 0.0) if over > 0 else None


def _wrong_at_penalty(line_up: LineUp, index: int) -> Violation | None:
    """The defending goalkeeper has to be in its goal area, others outside the penalty area, away from the ball and
    behind it; the kicker anywhere."""
    if index == line_up.kicker:
        return None
    pitch, robot = line_up.match.pitch, line_up.snapshot.robots[index]
    end = 1 if line_up.restart.spot[0] > 0 else -1
    if line_up.is_keeper(index) and line_up.own_end(index) == end:
        return None if in_goal_area(pitch, end, robot.x, robot.y) else Violation("outside its goal area")
    if in_penalty_area(pitch, end, robot.x, robot.y, line_up.match.reaches[index]):
        return Violation("in the penalty area")
    ahead = robot.x * end + line_up.match.reaches[index] - line_up.restart.spot[0] * end
    if line_up.match.book.restarts.penalty_behind and ahead > 0.0:
        return Violation(f"{ahead:.2f} m ahead of the ball", ahead, 0.0)
    return _near_ball(line_up, index)


def _wrong_at_shoot_out(line_up: LineUp, index: int) -> Violation | None:
    """The kicker has to be in the centre circle, the goalkeeper in its goal area, others beyond the halfway line."""
    pitch, robot = line_up.match.pitch, line_up.snapshot.robots[index]
    end = 1 if line_up.restart.spot[0] > 0 else -1
    away = math.hypot(robot.x, robot.y)
    if index == line_up.kicker:
        radius = pitch.centre_circle_radius
        return None if away <= radius else Violation(f"{away:.2f} m from the centre mark", away, radius)
    if line_up.is_keeper(index) and line_up.own_end(index) == end:
        return None if in_goal_area(pitch, end, robot.x, robot.y) else Violation("outside its goal area")
    over = robot.x * end + line_up.match.reaches[index]
    if over > 0:
        return Violation(f"{over:.2f} m over the halfway line", over, 0.0)
    clear = away - line_up.match.reaches[index]
    if clear < pitch.centre_circle_radius:
        return Violation("in the centre circle", clear, pitch.centre_circle_radius)
    return None


def checks_of(state: RefereeState, restart: Restart) -> "tuple[Check, ...]":
    """The checks of every robot before a restart."""
    return SHOOT_OUT if state.stage is GameStage.SHOOT_OUT else CHECKS[restart.phase]


Check = Callable[[LineUp, int], Violation | None]

CHECKS: Mapping[Phase, tuple[Check, ...]] = {
    Phase.KICK_OFF: (_on_spot, _in_other_half, _near_ball),
    Phase.FREE_KICK: (_on_spot, _near_ball),
    Phase.GOAL_KICK: (_on_spot, _near_ball),
    Phase.THROW_IN: (_on_spot, _near_ball),
    Phase.CORNER: (_on_spot, _near_ball),
    Phase.PENALTY: (_on_spot, _wrong_at_penalty),
    Phase.DROP_BALL: (_on_spot, _near_ball),
}
"""Restart → the checks of every robot."""
SHOOT_OUT: tuple[Check, ...] = (_wrong_at_shoot_out,)
