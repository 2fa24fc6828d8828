"""How often a frame is told: fifty times a second, less often where telling all pages takes long. Pure."""

_LEAST_S = 0.02
_SHARE = 0.25
"""Of its time that the server spends on telling frames, at most: the host plays on the same machine."""
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
        return max(_LEAST_S, self._takes_s / _SHARE)

    def due(self, now: float) -> bool:
        """Whether a frame may be told at this wall time in s; if so the next is due a period later."""
        if now < self._next_at:
            return False
        self._next_at = max(self._next_at + self.period, now + self.period / 2)
        return True

    def took(self, seconds: float) -> None:
        """How long telling the last one took."""
        self._takes_s += _NEW * (seconds - self._takes_s)
