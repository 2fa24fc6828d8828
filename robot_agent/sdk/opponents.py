"""Opponents tracked from picture to picture: extrapolated to now, and remembered while they are hidden."""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from schemas.frames import Point

REMEMBERED = 0.6
"""s; an opponent that was not seen for longer is forgotten."""
_NEAR = 0.6
"""m; an obstacle this close to where an opponent should be is that opponent."""
_TRUST = 0.6
"""Weight of a new position, against the expected one."""
_TRUST_VELOCITY = 0.2
"""Weight of the velocity that a new position implies."""
_STILL = 0.3
"""m/s; a lower velocity is as likely noise."""


class _Track(NamedTuple):
    """One opponent at the time of the newest picture: m, m/s, and for how many s it has not been seen."""

    x: float
    y: float
    vx: float = 0.0
    vy: float = 0.0
    unseen: float = 0.0


def _after(tracks: Iterable[_Track], time: float) -> list[Point]:
    """Their places `time` s later."""
    return [(x, y) if math.hypot(vx, vy) < _STILL else (x + vx * time, y + vy * time) for x, y, vx, vy, _ in tracks]


class Opponents:
    """Tracks the opponents of each picture."""

    def __init__(self) -> None:
        self._tracks: list[_Track] = []
        self._pictured = -math.inf
        """s; time of the newest picture."""

    def is_newer(self, pictured: float) -> bool:
        """Whether a picture of this time, s, is newer than the newest so far."""
        return pictured > self._pictured + 1e-6

    def now(self, age: float) -> list[Point]:
        """Their places `age` s after the newest picture."""
        return _after(self._tracks, age)

    def update(self, seen: Sequence[Point], pictured: float) -> None:
        """Take in a picture of the time `pictured`, s. Its opponents come first, in its order, then remembered ones."""
        dt = pictured - self._pictured
        self._pictured = pictured
        before = [track for track in self._tracks if track.unseen + dt <= REMEMBERED]
        expected = _after(before, dt)
        tracks = []
        for x, y in seen:
            away = [math.dist((x, y), place) for place in expected]
            least = min(away, default=math.inf)
            if least > _NEAR:
                tracks.append(_Track(x, y))
                continue
            nearest = away.index(least)
            known, (at_x, at_y) = before.pop(nearest), expected.pop(nearest)
            dx, dy, gain = x - at_x, y - at_y, _TRUST_VELOCITY / dt
            tracks.append(_Track(at_x + _TRUST * dx, at_y + _TRUST * dy, known.vx + gain * dx, known.vy + gain * dy))
        hidden = [
            _Track(x, y, track.vx, track.vy, track.unseen + dt) for track, (x, y) in zip(before, expected, strict=True)
        ]
        self._tracks = tracks + hidden
