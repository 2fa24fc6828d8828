"""How often a frame is sent: 25 times a second, less often if sending to all pages takes long. Pure."""

from coach_gateway.timing import FRAME_S

_SHARE = 0.25
"""Share of its time that the server spends on frames, at most: the host may run on the same machine."""
_NEW = 0.2
"""Weight of the newest measurement."""


class FramePace:
    """Knows when the next frame is due."""

    def __init__(self) -> None:
        self._takes_s = 0.0
        self._next_at = 0.0

    @property
    def period(self) -> float:
        """s of wall time between two frames."""
        return max(FRAME_S, self._takes_s / _SHARE)

    def due(self, now: float) -> bool:
        """Whether a frame may be sent at this wall time in s; if so, the next is due a period later."""
        if now < self._next_at:
            return False
        self._next_at = max(self._next_at + self.period, now + self.period / 2)
        return True

    def took(self, seconds: float) -> None:
        """Note how long the last frame took to send."""
        self._takes_s += _NEW * (seconds - self._takes_s)
