"""Who plays the ball, and who takes which place: an assignment with hysteresis that all robots compute alike."""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import NamedTuple

from robot_agent.sdk.bodies import Body
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.simple.assignment import cheapest_assignment
from schemas.frames import Point


class Role(StrEnum):
    """The role of a robot, as it sends it."""

    KEEPER = "keeper"
    ATTACKER = "attacker"
    GUARD = "guard"
    BLOCKER = "blocker"
    MARKER = "marker"
    SUPPORTER = "supporter"


class Candidate(NamedTuple):
    """A field robot as all robots of the team know it."""

    body: Body
    arrival: float
    """s until it could be at the ball."""
    role: str
    is_receiver: bool = False
    """A teammate has promised it a pass."""


class Place(NamedTuple):
    """A place of the formation."""

    role: Role
    at: Point


def attacker_of(candidates: Mapping[str, Candidate], parameters: Parameters) -> str:
    """The robot that is first at the ball, in favour of the one that plays it or was promised it; ties by name."""

    def cost(name: str) -> tuple[float, str]:
        _, arrival, role, is_receiver = candidates[name]
        if role == Role.ATTACKER:
            arrival -= parameters.stays
        return arrival - (parameters.receives if is_receiver else 0.0), name

    return min(candidates, key=cost)


def share_places(
    candidates: Mapping[str, Candidate], places: Sequence[Place], parameters: Parameters
) -> dict[str, Place]:
    """The assignment with the least sum of distances; the first places are taken where robots are few."""
    names, wanted = sorted(candidates), places[: len(candidates)]

    def cost(name: str, place: Place) -> float:
        has_it = candidates[name].role == place.role
        return math.dist(candidates[name].body[:2], place.at) - (parameters.keeps_place if has_it else 0.0)

    best = cheapest_assignment([[cost(name, place) for name in names] for place in wanted])
    return {names[robot]: place for robot, place in zip(best, wanted, strict=True)}
