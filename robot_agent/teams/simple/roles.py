"""Role assignment: the field robot that is first at the ball plays it, the others share the places of the formation.

Every robot decides for itself, from its own pose and the radio; the same beliefs give the same decision. A robot's
present role counts a little in its favour, so that two of them do not swap each tick.
"""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import NamedTuple

from robot_agent.sdk.bodies import Ball, Body, DriveLimits
from robot_agent.soccer.skills.intercept import meeting_time, way_of
from robot_agent.teams.simple.assignment import cheapest_assignment
from schemas.config.rolling import Rolling


class Role(StrEnum):
    """The role of a robot."""

    KEEPER = "keeper"
    STRIKER = "striker"
    DEFENDER = "defender"
    LEFT = "left supporter"
    RIGHT = "right supporter"
    LEFT_BACK = "left back"
    RIGHT_BACK = "right back"
    CENTRE = "centre"
    LEFT_WING = "left wing"
    RIGHT_WING = "right wing"
    FORWARD = "forward"


class Candidate(NamedTuple):
    """A field robot, with the role that it sends."""

    body: Body
    role: str
    is_receiver: bool = False
    """A teammate has promised it a pass."""


STAYS = 0.35
"""s by which another robot must be at the ball earlier than the striker, to become the striker."""
RECEIVES = 0.8
"""s in favour of the robot that was promised the ball."""
KEEPS_PLACE = 0.8
"""m by which another robot must be nearer to a place than the one that has it."""
_TIE = 1e-6
"""s; more than rounding can change."""


def striker_of(
    candidates: Mapping[str, Candidate], ball: Ball, rolling: Rolling, reach: float, limits: DriveLimits
) -> str:
    """The robot that is first at the ball, and so plays it; ties by name."""
    way = way_of(ball, rolling)
    first, least = "", math.inf
    for name in sorted(candidates, key=lambda name: candidates[name].role != Role.STRIKER):
        body, role, is_receiver = candidates[name]
        stays, receives = STAYS if role == Role.STRIKER else 0.0, RECEIVES if is_receiver else 0.0
        time = meeting_time(body, way, reach, limits, by=least + stays + receives + _TIE) - stays - receives
        if time < least or (time == least and name < first):
            first, least = name, time
    return first


def share_places(
    candidates: Mapping[str, Candidate], places: Sequence[tuple[Role, tuple[float, float]]]
) -> dict[str, Role]:
    """The assignment with the least sum of distances, first places first; surplus robots get no place."""
    names = sorted(candidates)
    open_places = places[: len(names)]
    far = [[_far(candidates[name], role, place) for name in names] for role, place in open_places]
    best = cheapest_assignment(far)
    return {names[robot]: role for robot, (role, _) in zip(best, open_places, strict=True)}


def _far(candidate: Candidate, role: Role, place: tuple[float, float]) -> float:
    """m from a place, less for the robot that has it."""
    return math.dist(candidate.body[:2], place) - (KEEPS_PLACE if candidate.role == role else 0.0)
