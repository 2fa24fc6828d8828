"""Where robots may stand before START: distances to the whole robot, own halves at a kick-off, areas at a penalty."""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from schemas.game import Phase
from sim_host.referee.areas import in_goal_area, in_penalty_area
from sim_host.referee.match import Match
from sim_host.referee.state import RefereeState, Restart
from sim_host.snapshot import Snapshot


class LineUp(NamedTuple):
    """The robots before a restart; robots by their index in the roster."""

    match: Match
    state: RefereeState
    restart: Restart
    snapshot: Snapshot
    kicker: int | None
    """The taker's robot nearest to the ball; a drop ball has none."""
    free: tuple[int, ...]
    """Defenders who may stand near the ball before their own goal."""

    def own_end(self, index: int) -> int:
        """Sign of the x of the goal that a robot defends."""
        return -self.state.attack(self.match.roster.sides[index])

    def is_keeper(self, index: int) -> bool:
        """Whether a robot is its side's goalkeeper."""
        roster = self.match.roster
        return roster.keepers.get(roster.sides[index]) == roster.names[index]


def standing_wrong(match: Match, state: RefereeState, restart: Restart, snapshot: Snapshot) -> str | None:
    """Who stands wrong for the restart and by how much, in one phrase; nothing when all stand legally."""
    line_up = LineUp(match, state, restart, snapshot, None, ())
    line_up = line_up._replace(kicker=_kicker(line_up), free=_free_defenders(line_up))
    for index, name in enumerate(match.roster.names):
        for check in CHECKS[restart.phase]:
            fault = check(line_up, index)
            if fault is not None:
                return f"{name} stands {fault}"
    return None


def _kicker(line_up: LineUp) -> int | None:
    sides, restart = line_up.match.roster.sides, line_up.restart
    own = [index for index, side in enumerate(sides) if side is restart.side]
    return min(own, key=lambda index: _from_ball(line_up, index), default=None)


def _free_defenders(line_up: LineUp) -> tuple[int, ...]:
    """The goalkeeper in its own penalty area (ours), one more there outside the goal area (rule book, set pieces)."""
    match, restart, robots = line_up.match, line_up.restart, line_up.snapshot.robots
    inside = [
        index
        for index, side in enumerate(match.roster.sides)
        if side is not restart.side
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


def _near_ball(line_up: LineUp, index: int) -> str | None:
    if index == line_up.kicker or index in line_up.free:
        return None
    restarts = line_up.match.book.restarts
    takes = line_up.match.roster.sides[index] is line_up.restart.side
    return _nearer_than(line_up, index, restarts.teammate_distance if takes else restarts.opponent_distance)


def _near_dropped_ball(line_up: LineUp, index: int) -> str | None:
    return _nearer_than(line_up, index, line_up.match.book.restarts.drop_ball_distance)


def _nearer_than(line_up: LineUp, index: int, asked: float) -> str | None:
    distance = _from_ball(line_up, index)
    return f"{distance:.2f} m from the ball, {asked:.2f} m asked" if distance < asked else None


def _in_other_half(line_up: LineUp, index: int) -> str | None:
    """The whole robot stays in its own half, of the kicker its centre."""
    hull = 0.0 if index == line_up.kicker else line_up.match.reaches[index]
    over = hull - line_up.snapshot.robots[index].x * line_up.own_end(index)
    return f"{over:.2f} m in the other half" if over > 0 else None


def _wrong_at_penalty(line_up: LineUp, index: int) -> str | None:
    """The defending goalkeeper waits in its goal area, all but the kicker out of the penalty area and away."""
    if index == line_up.kicker:
        return None
    pitch, robot = line_up.match.pitch, line_up.snapshot.robots[index]
    end = 1 if line_up.restart.spot[0] > 0 else -1
    if line_up.is_keeper(index) and line_up.own_end(index) == end:
        return None if in_goal_area(pitch, end, robot.x, robot.y) else "outside its goal area"
    if in_penalty_area(pitch, end, robot.x, robot.y, line_up.match.reaches[index]):
        return "in the penalty area"
    return _nearer_than(line_up, index, line_up.match.book.restarts.opponent_distance)


Check = Callable[[LineUp, int], str | None]

CHECKS: Mapping[Phase, tuple[Check, ...]] = {
    Phase.KICK_OFF: (_in_other_half, _near_ball),
    Phase.FREE_KICK: (_near_ball,),
    Phase.GOAL_KICK: (_near_ball,),
    Phase.THROW_IN: (_near_ball,),
    Phase.CORNER: (_near_ball,),
    Phase.PENALTY: (_wrong_at_penalty,),
    Phase.DROP_BALL: (_near_dropped_ball,),
}
"""Restart → what is asked of every robot."""
