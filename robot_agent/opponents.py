"""Opponents as a robot follows them from picture to picture: moved on to now, and remembered while they are hidden."""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

Point = tuple[float, float]

REMEMBERED = 0.6
"""s; an opponent that was not seen for longer may be anywhere."""
_NEAR = 0.6
"""m; what is seen this close to where an opponent should be is that opponent."""
_TRUST = 0.6
"""Share of a new position that is believed at once; the rest stays with what was expected."""
_TRUST_VELOCITY = 0.2
"""Likewise of what a new position says of the velocity."""
_STILL = 0.3
"""m/s; a slower velocity is as likely noise."""


class _Track(NamedTuple):
    """One opponent at the time of the newest picture: m, m/s, and for how many s it has not been seen."""

    x: float
    y: float
    vx: float = 0.0
    vy: float = 0.0
    unseen: float = 0.0


def _after(tracks: Iterable[_Track], time: float) -> list[Point]:
    """Where they are `time` s later."""
    return [(x, y) if math.hypot(vx, vy) < _STILL else (x + vx * time, y + vy * time) for x, y, vx, vy, _ in tracks]


class Opponents:
    """Takes in what each picture shows."""

    def __init__(self) -> None:
        self._tracks: list[_Track] = []
        self._pictured = -math.inf
        """s; when the newest picture was taken."""

    def is_newer(self, pictured: float) -> bool:
        """Whether a picture that was taken at that time, s, is newer than what was taken in."""
        return pictured > self._pictured + 1e-6

    def now(self, age: float) -> list[Point]:
        """Where they are `age` s after the newest picture."""
        return _after(self._tracks, age)

    def update(self, seen: Sequence[Point], pictured: float) -> None:
        """The opponents of a new picture, taken at that time, in its order; then those that are remembered."""
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
