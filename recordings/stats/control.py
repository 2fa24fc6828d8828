"""Ball in play, possession, and time with the ball."""

from collections import defaultdict

from recordings.stats.moment import Moment
from schemas.side import Side


class Control:
    """Which side is in control of the ball, and for how long each was.

    A side is in control since one of its robots held or kicked the ball, or touched it while nobody was; the referee's
    own definition, so that a ball that bounces off an opponent has not changed sides. A stop ends it.
    """

    def __init__(self) -> None:
        self.side: Side | None = None
        """In control after the newest moment."""
        self.in_play = 0.0
        """s for which the ball was in play."""
        self.seconds = dict.fromkeys(Side, 0.0)
        """s of them in which each side was in control; what is left was nobody's."""
        self.with_ball: dict[str, float] = defaultdict(float)
        """s of them in which each robot held the ball."""

    def take(self, moment: Moment) -> None:
        """One more tick: it belongs to whoever was in control at its beginning."""
        if moment.in_play:
            self.in_play += moment.dt
            if self.side is not None:
                self.seconds[self.side] += moment.dt
            holder = moment.before.possession if moment.before is not None else None
            if holder is not None:
                self.with_ball[holder] += moment.dt
        self.side = self._after(moment)

    def _after(self, moment: Moment) -> Side | None:
        if moment.state is None or not moment.state.running or not moment.running:
            return None
        world, side = moment.world, self.side if moment.before is not None else None
        for robot in touching(moment):
            own = moment.side(robot)
            if own is not None and (side is None or robot in (world.kicked, world.possession)):
                side = own
        return side


def touching(moment: Moment) -> list[str]:
    """Robots that touched the ball in this tick, in order of time; in recordings older than touches, the holder."""
    world = moment.world
    if world.possession is not None and world.possession not in world.touches:
        return [*world.touches, world.possession]
    return world.touches
