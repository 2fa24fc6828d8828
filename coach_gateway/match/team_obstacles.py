"""Opponents and other bodies as a team believes them: what its robots have sent of them, fused. Pure."""

import math
from collections.abc import Mapping

from schemas.messages.radio import Belief
from schemas.wire.message import Name
from schemas.wire.part import Part

OLD = 1.0
"""Simulated time in s after which a belief no longer counts. Chosen here: robots send one each tick, or each tenth."""
_SAME = 0.5
"""m; two robots that believe a body within this distance mean the same one (ours: about a robot's width)."""


class TeamObstacle(Part):
    """An opponent or another body that is no robot of the team, as the team believes it, in its team frame."""

    x: float
    """x in the team frame, in m, as the nearest of the robots believes it."""
    y: float
    """y in the team frame, in m."""
    age: float
    """Simulated time since that robot has sent it, in s."""
    seen_by: list[Name]
    """The robots that believe it, the nearest first."""


def team_obstacles(beliefs: Mapping[str, Belief], time: float) -> list[TeamObstacle]:
    """The obstacles of a team at this simulated time, from the newest belief of each of its robots.

    A robot that is near to a body knows best where it is. A body where a teammate believes itself to be is that
    teammate, which the sender has not heard of.
    """
    recent = {name: belief for name, belief in beliefs.items() if abs(time - belief.time) <= OLD}
    selves = {name: belief.radio.self for name, belief in recent.items() if belief.radio.self is not None}
    seen: list[tuple[float, str, float, float]] = []
    for name, belief in recent.items():
        own = selves.get(name)
        for place in belief.radio.obstacles:
            if all(math.hypot(mate.x - place.x, mate.y - place.y) > _SAME for mate in selves.values()):
                away = math.inf if own is None else math.hypot(own.x - place.x, own.y - place.y)
                seen.append((away, name, place.x, place.y))
    found: list[TeamObstacle] = []
    for _, name, x, y in sorted(seen):
        for index, known in enumerate(found):
            if name not in known.seen_by and math.hypot(known.x - x, known.y - y) <= _SAME:
                found[index] = known.replace(seen_by=[*known.seen_by, name])
                break
        else:
            age = round(max(0.0, time - recent[name].time), 3)
            found.append(TeamObstacle(x=x, y=y, age=age, seen_by=[name]))
    return found
