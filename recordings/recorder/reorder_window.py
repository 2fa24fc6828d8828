"""How long messages are held back to be put in order: until those of other topics that belong before them have come.

What was lost while the recorder stood still, or its link was broken, is fetched again topic by topic. Whoever wrote
meanwhile what has come would give it a place before what is still on its way.
"""

from recordings.recorder.active_clock import ActiveClock

_HOLD_NS = 100_000_000
"""Simulated time that a message waits for those of other topics that belong before it."""
_IDLE_S = 0.5
"""Wall time without a message after which the host stands still: what it said in every topic is complete."""
_CALM_S = 1.5
"""Wall time after a disturbance in which all topics have been seen to: Zenoh's writers say twice a second how far they
have counted, and what a reader lacks of that is fetched."""
_MAX_DISTURBED_S = 10.0
"""Wall time without calm after which messages are written all the same."""
_GIVE_UP_S = 30.0
"""Wall time in which nothing could be written after which everything is: a topic that came in every tick has ended."""


class ReorderWindow:
    """Says up to where messages can be written."""

    def __init__(self, now: float) -> None:
        self._clock = ActiveClock(now)
        self._calm_at = self._received_at = self._written_at = 0.0

    def update(self, now: float, *, linked: bool, received: bool) -> None:
        """The recorder looks, at `now` in s of wall time: whether its link is there, and whether something came."""
        stood_still = self._clock.update(now)
        elapsed = self._clock.elapsed
        if stood_still or not linked:
            self._calm_at = elapsed + _CALM_S
        if received:
            self._received_at = elapsed

    def limit(self, complete_ns: int) -> int | None:
        """Simulated time in ns before which messages can be written; none where all of them can.

        Up to `complete_ns` all has come that comes in every tick.
        """
        elapsed = self._clock.elapsed
        waited = elapsed - self._written_at
        if waited > _GIVE_UP_S:
            return None
        if elapsed < self._calm_at and waited < _MAX_DISTURBED_S:
            return 0
        return complete_ns + 1 if elapsed - self._received_at > _IDLE_S else complete_ns - _HOLD_NS

    def mark_written(self) -> None:
        """Messages were written, or none is held."""
        self._written_at = self._clock.elapsed
