"""Shoves: robots that another robot has hit, with the velocity that they had by their own drive.

For a moment after it was hit, a robot moves as the impact sent it, and not as it drives.
"""

from typing import NamedTuple

from sim_host.snapshot import Impact, Snapshot
from sim_host.soccer.referee.match_constants import MatchConstants

MEMORY = 1.0
"""s for which an impact explains the motion of a robot; by then its drive has made more of it."""
SHOVED = 0.5
"""s for which an opponent's impact explains where a robot goes."""
AGAIN = 0.2
"""s; two robots that touch again within this time have hit each other once."""


class Shove(NamedTuple):
    """One robot after an impact; robots by their indices in the roster."""

    robot: int
    by: int
    velocity: tuple[float, float]
    """m/s before the impact."""
    speed: float
    """m/s at which the other drove toward it."""
    age: float = 0.0
    """s since the impact."""


NO_SHOVES: tuple[Shove, ...] = ()


def shoves_after(before: tuple[Shove, ...], snapshot: Snapshot, dt: float) -> tuple[Shove, ...]:
    """The shoves after one more tick of `dt` in s, the oldest first."""
    kept = [shove._replace(age=shove.age + dt) for shove in before if shove.age + dt <= MEMORY]
    for impact in snapshot.impacts:
        kept += [shove for shove in _both(impact) if not _is_known(kept, shove)]
    return tuple(kept) if kept else NO_SHOVES


def own_speed(
    match: MatchConstants,
    shoves: tuple[Shove, ...],
    robot: int,
    velocity: tuple[float, float],
    toward: tuple[float, float],
) -> tuple[float, Shove | None]:
    """m/s at which a robot with this velocity drives in a direction by itself, and the shove that explains the rest.

    Since a shove, its drive can have added as much as its acceleration allows.
    """
    speed, cause = velocity[0] * toward[0] + velocity[1] * toward[1], None
    acceleration = match.roster.models[robot].drive.acceleration
    for shove in shoves:
        if shove.robot != robot:
            continue
        driven = max(0.0, shove.velocity[0] * toward[0] + shove.velocity[1] * toward[1]) + acceleration * shove.age
        if driven < speed:
            speed, cause = driven, shove
    return speed, cause


def is_pushed(match: MatchConstants, shoves: tuple[Shove, ...], snapshot: Snapshot, robot: int, spot: complex) -> bool:
    """Whether an opponent pushes a robot toward a spot, x + iy in m, or has just hit it."""
    sides, robots = match.roster.sides, snapshot.robots
    for pair in snapshot.contacts:
        if robot in pair and sides[pair[0]] is not sides[pair[1]]:
            other = pair[0] if pair[1] == robot else pair[1]
            if abs(complex(robots[other].x, robots[other].y) - spot) > abs(
                complex(robots[robot].x, robots[robot].y) - spot
            ):
                return True
    return any(one.robot == robot and one.age <= SHOVED and sides[one.by] is not sides[robot] for one in shoves)


def _both(impact: Impact) -> tuple[Shove, Shove]:
    return (
        Shove(impact.first, impact.second, impact.first_velocity, impact.second_speed),
        Shove(impact.second, impact.first, impact.second_velocity, impact.first_speed),
    )


def _is_known(shoves: list[Shove], new: Shove) -> bool:
    return any(old.robot == new.robot and old.by == new.by and old.age < AGAIN for old in shoves)
