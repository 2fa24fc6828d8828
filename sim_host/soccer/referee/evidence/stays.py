"""Clocks of robots in goal areas and penalty areas, and of too many robots of a side in a penalty area.

A clock runs while its robots are inside. Outside it runs down, so that a step out of the area for a moment gives no new
time.
"""

from collections.abc import Iterable
from typing import NamedTuple

from schemas.side import Side
from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.areas import in_goal_area, in_penalty_area
from sim_host.soccer.referee.evidence.shoves import Shove, is_pushed
from sim_host.soccer.referee.evidence.zones import Zones
from sim_host.soccer.referee.match_constants import MatchConstants


class Stay(NamedTuple):
    """The clock of one robot, by its index in the roster, for one area; a goalkeeper has none for its own areas."""

    robot: int
    end: int
    """Sign of the x of the goal."""
    lasted: float
    """s."""
    inside: bool = True
    """The robot is in the area in this tick; otherwise the clock runs down."""


class Crowd(NamedTuple):
    """More robots of one side in a penalty area than allowed; a goalkeeper in its own area does not count."""

    robots: tuple[int, ...]
    """By their indices in the roster; those of the last tick with too many."""
    end: int
    """Sign of the x of the goal."""
    lasted: float
    """s for which there have been too many, even if the robots changed."""
    inside: bool = True
    """There are too many in this tick; otherwise the clock runs down."""


class Stays(NamedTuple):
    """All clocks: those that run in the order of the roster, then those that run down."""

    robots: tuple[Stay, ...] = ()
    """Robots and goal areas."""
    crowds: tuple[Crowd, ...] = ()
    visits: tuple[Stay, ...] = ()
    """Robots and penalty areas, where the rule book limits the time of one robot."""


NO_STAYS = Stays()
"""No clock runs or runs down."""


def stays_after(
    match: MatchConstants, before: Stays, zones: Zones, shoves: tuple[Shove, ...], snapshot: Snapshot, dt: float
) -> Stays:
    """The stays after one more tick of `dt` in s. No clock begins for a robot that an opponent pushes in."""
    pitch, robots, sides, areas = match.pitch, snapshot.robots, match.roster.sides, match.book.areas
    in_goal: list[tuple[int, int]] = []
    in_penalty: list[tuple[int, int]] = []
    crowds: dict[tuple[Side, int], list[int]] = {}
    for index in zones.deep:
        x, y = robots[index].x, robots[index].y
        end = 1 if x > 0 else -1
        if not in_penalty_area(pitch, end, x, y):
            continue
        if is_pushed(match, shoves, snapshot, index, complex(end * pitch.goal_line, 0.0)):
            continue
        in_penalty.append((index, end))
        crowds.setdefault((sides[index], end), []).append(index)
        if in_goal_area(pitch, end, x, y):
            in_goal.append((index, end))
    after = Stays(
        _clocks(before.robots, in_goal, areas.goal_area_duration, dt),
        _crowds(match, before.crowds, crowds, dt),
        _clocks(before.visits, in_penalty, areas.penalty_area_stay, dt) if areas.penalty_area_stay else (),
    )
    return after if any(after) else NO_STAYS


def _clocks(before: Iterable[Stay], inside: list[tuple[int, int]], limit: float, dt: float) -> tuple[Stay, ...]:
    """The clocks of the robots and ends in `inside`, and those that still run down."""
    known = {(stay.robot, stay.end): stay.lasted for stay in before}
    running = [Stay(index, end, known.pop((index, end), 0.0) + dt) for index, end in inside]
    rest = [
        Stay(index, end, left, False)
        for (index, end), lasted in known.items()
        if (left := min(lasted, limit) - dt) > 0.0
    ]
    return (*running, *rest)


def _crowds(
    match: MatchConstants, before: Iterable[Crowd], now: dict[tuple[Side, int], list[int]], dt: float
) -> tuple[Crowd, ...]:
    """The clocks of sides with too many robots in a penalty area, and those that still run down."""
    areas, sides = match.book.areas, match.roster.sides
    known = {(sides[crowd.robots[0]], crowd.end): crowd for crowd in before}
    running = []
    for (side, end), robots in now.items():
        if len(robots) > areas.penalty_area_robots:
            old = known.pop((side, end), None)
            running.append(Crowd(tuple(robots), end, (old.lasted if old is not None else 0.0) + dt))
    limit = areas.penalty_area_duration
    rest = [
        crowd._replace(lasted=left, inside=False)
        for crowd in known.values()
        if (left := min(crowd.lasted, limit) - dt) > 0.0
    ]
    return (*running, *rest)
