"""Ball in play, possession, and time with the ball."""

from collections import defaultdict

from recordings.soccer.stats.match_tick import MatchTick
from schemas.side import Side


class BallControl:
    """Follows which side is in control of the ball, and for how long.

    A side is in control from the time one of its robots holds or kicks the ball, or touches it while neither side is in
    control. STOP ends it. This is the referee's definition: a ball that bounces off an opponent does not change sides.
    """

    def __init__(self) -> None:
        self.side: Side | None = None
        """The side in control after the newest tick."""
        self.in_play = 0.0
        """Time in s for which the ball was in play."""
        self.seconds = dict.fromkeys(Side, 0.0)
        """Side → part of that time in which it was in control; in the rest, neither side was."""
        self.with_ball: dict[str, float] = defaultdict(float)
        """Robot → part of that time in which it held the ball."""

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick; it counts for the side in control at its beginning."""
        if match_tick.in_play:
            self.in_play += match_tick.dt
            if self.side is not None:
                self.seconds[self.side] += match_tick.dt
            holder = match_tick.before.possession if match_tick.before is not None else None
            if holder is not None:
                self.with_ball[holder] += match_tick.dt
        self.side = self._after(match_tick)

    def _after(self, match_tick: MatchTick) -> Side | None:
        if match_tick.state is None or not match_tick.state.running or not match_tick.running:
            return None
        world, side = match_tick.world, self.side if match_tick.before is not None else None
        for robot in touching(match_tick):
            own = match_tick.side(robot)
            if own is not None and (side is None or robot in (world.kicked, world.possession)):
                side = own
        return side


def touching(match_tick: MatchTick) -> list[str]:
    """Robots that touched the ball in this tick, in order of time; the holder if touches were not recorded."""
    world = match_tick.world
    if world.possession is not None and world.possession not in world.touches:
        return [*world.touches, world.possession]
    return world.touches
