"""Search for a lost ball: each robot in one quarter of the pitch, every few seconds in the next."""

from schemas.config.sections import Pitch

STAYS = 6.0
"""s in each quarter: enough to drive to the next and look around."""
_AROUND = ((1, 1), (-1, 1), (-1, -1), (1, -1))


def search_place(number: int, time: float, pitch: Pitch) -> tuple[float, float]:
    """Where the robot with this number searches at a time, s: the middle of a quarter, m.

    From there a camera that reaches half a quarter's diagonal, 6.5 m on 22 × 14 m, sees all of it.
    """
    along, across = _AROUND[(number + int(time / STAYS)) % len(_AROUND)]
    return along * 0.25 * pitch.length, across * 0.25 * pitch.width
