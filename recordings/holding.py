"""How long messages are held back to be put in order: until those of other topics that belong before them have come.

What was lost while the recorder stood still, or its link was broken, is fetched again topic by topic. Whoever wrote
meanwhile what has come would give it a place before what is still on its way.
"""

from recordings.awake import Awake

_HOLD_NS = 100_000_000
"""Simulated time that a message waits for those of other topics that belong before it."""
_STILL_S = 0.5
"""Wall time without a message after which the host stands still: what it said in every topic is complete."""
_CALM_S = 1.5
"""Wall time after a disturbance in which all topics have been seen to: Zenoh's writers say twice a second how far they
have counted, and what a reader lacks of that is fetched."""
_RESTLESS_S = 10.0
"""Wall time without calm after which messages are written all the same."""
_GIVE_UP_S = 30.0
"""Wall time in which nothing could be written after which everything is: a topic that came in every tick has ended."""


class Holding:
    """Says up to where messages can be written."""

    def __init__(self, now: float) -> None:
        self._awake = Awake(now)
        self._calm_at = self._came_at = self._written_at = 0.0

    def look(self, now: float, *, linked: bool, came: bool) -> None:
        """The recorder looks, at `now` in s of wall time: whether its link is there, and whether something came."""
        stood_still = self._awake.look(now)
        passed = self._awake.passed
        if stood_still or not linked:
            self._calm_at = passed + _CALM_S
        if came:
            self._came_at = passed

    def limit(self, settled_ns: int) -> int | None:
        """Simulated time in ns before which messages can be written; none where all of them can.

        Up to `settled_ns` all has come that comes in every tick.
        """
        passed = self._awake.passed
        waited = passed - self._written_at
        if waited > _GIVE_UP_S:
            return None
        if passed < self._calm_at and waited < _RESTLESS_S:
            return 0
        return settled_ns + 1 if passed - self._came_at > _STILL_S else settled_ns - _HOLD_NS

    def written(self) -> None:
        """Messages were written, or none is held."""
        self._written_at = self._awake.passed
