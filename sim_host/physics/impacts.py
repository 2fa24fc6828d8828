"""Impacts: robots that hit each other in a tick, with the speeds that they had before.

After a tick, the velocities of two robots are already the rebound's, and they may have separated again. So the contacts
of each physics step are looked at, and the velocities are those at the beginning of the tick.
"""

from collections.abc import Sequence

from sim_host.physics.collision_candidates import MIN_IMPACT, IndexPairs
from sim_host.physics.engine import Engine
from sim_host.snapshot import Impact, RobotState


class ImpactDetector:
    """Collects the impacts of one tick."""

    def __init__(self, engine: Engine, robots: Sequence[RobotState], hits: IndexPairs) -> None:
        """`robots` as they were at the beginning of the tick; `hits` are the pairs that may hit each other in it."""
        self._engine = engine
        self._robots = robots
        self._hits = hits
        self._found: list[Impact] = []

    def after_step(self) -> None:
        """Look at the contacts of a physics step; a pair counts once, when it first touches."""
        left = []
        for pair in self._hits:
            direction = self._engine.contact_direction(*pair)
            if direction is None:
                left.append(pair)
                continue
            one, other = self._robots[pair[0]], self._robots[pair[1]]
            impact = Impact(*pair, direction, (one.vx, one.vy), (other.vx, other.vy))
            if impact.closing_speed > MIN_IMPACT:
                self._found.append(impact)
        self._hits = left

    def found(self) -> tuple[Impact, ...]:
        """The impacts so far, in the order of the roster."""
        return tuple(sorted(self._found))
