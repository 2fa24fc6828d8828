"""Where shots ended: where the ball crossed the goal line or the line beside it, or where it was stopped."""

import math
from itertools import pairwise

from recordings.soccer.stats.kicks import KickRecord
from recordings.soccer.stats.tracks import Tracks
from schemas.frames import Point

_CM = 0.01
_AFTER_S = 0.4
"""s after the outcome of a shot was clear in which the ball is still followed: a goal is a goal behind the line."""
_JUMP_M, _FASTEST = 0.5, 25.0
"""m, m/s: a ball that moves farther between two samples than this and its speed allow was placed there."""


def end_of_shot(kick: KickRecord, tracks: Tracks, half_length: float) -> Point:
    """The end of a shot in the field frame; `half_length` is the distance of the goal lines from the centre."""
    path = _path(tracks, kick.time, kick.ended + _AFTER_S)
    for before, after in pairwise(path):
        if math.dist(before, after) > _JUMP_M + _FASTEST / tracks.rate:
            return before
        if abs(before[0]) < half_length <= abs(after[0]):
            share = (half_length - abs(before[0])) / (abs(after[0]) - abs(before[0]))
            return before[0] + share * (after[0] - before[0]), before[1] + share * (after[1] - before[1])
    stopped = _path(tracks, kick.time, kick.ended)
    return stopped[-1] if stopped else (kick.x, kick.y)


def _path(tracks: Tracks, start: float, end: float) -> list[Point]:
    """The places of the ball between two times, in s of simulated time."""
    first = max(0, round((start - tracks.start) * tracks.rate))
    last = min(tracks.samples - 1, round((end - tracks.start) * tracks.rate))
    return [(_CM * tracks.ball_x[sample], _CM * tracks.ball_y[sample]) for sample in range(first, last + 1)]
