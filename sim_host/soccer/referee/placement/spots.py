"""The spot of each restart, from the place of the incident.

`attack` is the sign of the x direction that the taker attacks. Places and spots are in m, field frame.
"""

import math
from collections.abc import Callable, Iterable, Mapping

from schemas.side import Side
from schemas.soccer.game import Phase
from sim_host.soccer.referee.areas import in_a_penalty_area
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.match_constants import MatchConstants


def restart_at(match: MatchConstants, state: RefereeState, phase: Phase, side: Side | None, place: Spot) -> Restart:
    """The restart after an incident at `place`."""
    attack = state.attack(side) if side is not None else 1
    return Restart(phase, side, SPOTS[phase](match, attack, place))


def _centre(_match: MatchConstants, _attack: int, _place: Spot) -> Spot:
    return 0.0, 0.0


def _penalty_mark(match: MatchConstants, attack: int, _place: Spot) -> Spot:
    return attack * (match.pitch.goal_line - match.pitch.penalty_mark), 0.0


def _corner(match: MatchConstants, attack: int, place: Spot) -> Spot:
    """The corner of the attacked end that is on the same side as the place."""
    inset = match.book.restarts.corner_inset
    return attack * (match.pitch.goal_line - inset), math.copysign(match.pitch.touch_line - inset, place[1])


def _throw_in(match: MatchConstants, _attack: int, place: Spot) -> Spot:
    """The nearer touch line, level with the place."""
    inset = match.book.restarts.touch_line_inset
    x = _within(place[0], match.pitch.goal_line - inset)
    return x, math.copysign(match.pitch.touch_line - inset, place[1])


def _goal_kick(match: MatchConstants, attack: int, place: Spot) -> Spot:
    """The nearest restart marker in the taker's own half."""
    return _nearest(place, (spot for spot in match.pitch.restart_spots if spot[0] * attack < 0))


def _in_field(match: MatchConstants, _attack: int, place: Spot) -> Spot:
    """The place itself, moved inside the lines; for a place in a penalty area, the nearest restart spot outside."""
    pitch, inset = match.pitch, match.book.restarts.field_inset
    x, y = _within(place[0], pitch.goal_line - inset), _within(place[1], pitch.touch_line - inset)
    if in_a_penalty_area(pitch, x, y):
        return _nearest((x, y), (spot for spot in pitch.restart_spots if not in_a_penalty_area(pitch, *spot)))
    return x, y


def _within(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))


def _nearest(place: Spot, spots: Iterable[Spot]) -> Spot:
    """The nearest spot; of two equally near spots, the one nearer to the long axis, then to the halfway line."""
    return min(spots, key=lambda spot: (math.dist(place, spot), abs(spot[1]), abs(spot[0])))


SPOTS: Mapping[Phase, Callable[[MatchConstants, int, Spot], Spot]] = {
    Phase.KICK_OFF: _centre,
    Phase.FREE_KICK: _in_field,
    Phase.GOAL_KICK: _goal_kick,
    Phase.THROW_IN: _throw_in,
    Phase.CORNER: _corner,
    Phase.PENALTY: _penalty_mark,
    Phase.DROP_BALL: _in_field,
}
"""Restart → the function from the place of the incident to its spot."""
