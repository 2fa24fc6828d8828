"""Search for a lost ball: each robot in one quarter of the pitch, every few seconds in the next."""

from schemas.config.sections import Pitch

STAYS = 6.0
"""s in each quarter: enough to drive to the next and look around."""
_AROUND = ((1, 1), (-1, 1), (-1, -1), (1, -1))
_BESIDE = (0.0, 0.12, -0.12)
"""Shares of the pitch's length from the middle of a quarter toward its end."""


def search_place(number: int, time: float, pitch: Pitch) -> tuple[float, float]:
    """Where the robot with this number searches at a time, s: the middle of a quarter, m.

    From there a camera that reaches half a quarter's diagonal, 6.5 m on 22 × 14 m, sees all of it. Robots 2 to 5 have
    the middles; further ones search beside them.
    """
    along, across = _AROUND[(number + int(time / STAYS)) % len(_AROUND)]
    beside = _BESIDE[max(0, number - 2) // len(_AROUND) % len(_BESIDE)]
    return along * (0.25 + beside) * pitch.length, across * 0.25 * pitch.width
