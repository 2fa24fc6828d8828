"""Durations of robots in goal areas where they may not stay, and of too many robots of a side in a penalty area."""

from typing import NamedTuple

from sim_host.referee.areas import in_goal_area, in_penalty_area
from sim_host.referee.evidence.zones import Zones
from sim_host.referee.match_constants import MatchConstants
from sim_host.snapshot import Snapshot


class Stay(NamedTuple):
    """A robot in a goal area, by its index in the roster; not a goalkeeper in its own goal area."""

    robot: int
    end: int
    """Sign of the x of the goal."""
    lasted: float
    """s."""


class Crowd(NamedTuple):
    """More robots of one side in a penalty area than allowed; a goalkeeper in its own area does not count."""

    robots: tuple[int, ...]
    """By their indices in the roster."""
    end: int
    """Sign of the x of the goal."""
    lasted: float
    """s for which there have been too many, even if the robots changed."""


class Stays(NamedTuple):
    """All stays and crowds, in the order of the roster."""

    robots: tuple[Stay, ...] = ()
    crowds: tuple[Crowd, ...] = ()


NO_STAYS = Stays()
"""No robot is in an area where it may not stay."""


def stays_after(match: MatchConstants, before: Stays, zones: Zones, snapshot: Snapshot, dt: float) -> Stays:
    """The stays after one more tick of `dt` in s."""
    pitch, robots, sides = match.pitch, snapshot.robots, match.roster.sides
    stays: list[Stay] = []
    crowds: dict[tuple[str, int], list[int]] = {}
    for index in zones.deep:
        x, y = robots[index].x, robots[index].y
        end = 1 if x > 0 else -1
        if not in_penalty_area(pitch, end, x, y):
            continue
        crowds.setdefault((sides[index], end), []).append(index)
        if in_goal_area(pitch, end, x, y):
            lasted = next((stay.lasted for stay in before.robots if stay.robot == index and stay.end == end), 0.0)
            stays.append(Stay(index, end, lasted + dt))
    too_many = [
        Crowd(tuple(crowd), end, _crowded(match, before, crowd, end) + dt)
        for (_, end), crowd in crowds.items()
        if len(crowd) > match.book.areas.penalty_area_robots
    ]
    return Stays(tuple(stays), tuple(too_many)) if stays or too_many else NO_STAYS


def _crowded(match: MatchConstants, before: Stays, crowd: list[int], end: int) -> float:
    """s for which the same side has had too many robots there before this tick."""
    side = match.roster.sides[crowd[0]]
    return next(
        (old.lasted for old in before.crowds if old.end == end and match.roster.sides[old.robots[0]] is side), 0.0
    )
