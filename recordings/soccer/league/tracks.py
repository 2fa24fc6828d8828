"""Resamples the records of both teams on one regular grid of times, in the field frame.

Between two records of a team, values are interpolated linearly, headings along the shorter way. In gaps longer than
`GAP_S` they are unknown.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from recordings.soccer.league.record_motion import BALL, ROBOT, BodyRecords, body_records, last_known
from recordings.soccer.league.team_log import GAP_S, TeamLog
from schemas.messages.soccer.league.axes import heading_across, vector_to_field
from schemas.messages.soccer.league.findings import Findings

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

_EXTRAPOLATE_S = 0.2
"""s for which the last record is valid before a gap. Chosen here: two records at the league's lowest rate."""
_AGREE_M = 1.0
"""m between the balls of two teams up to which they are the same ball. Chosen here: well above their errors."""
_KICK_S = 0.4
_KICK_M = 0.8
"""s and m: a ball that is this far from its holder after this time was kicked. Chosen here: 2 m/s is faster than a
lost ball."""


@dataclass(frozen=True, slots=True)
class Track:
    """One body on the grid: `values` has a column for each time, NaN where `known` is False."""

    known: Mask
    values: Array
    """Robot: x, y, heading, vx, vy, omega, with the ball (1 or 0). Ball: x, y, z, vx, vy, vz, confidence."""


def robot_tracks(log: TeamLog, letter: str, grid_ms: Array, attack: Array, findings: Findings) -> dict[int, Track]:
    """Number → track of each robot of a team; `attack` is its direction of attack at each time, +1 or −1."""
    tracks = {}
    findings.place = letter
    for number in sorted(log.robots):
        body = body_records(log.robots[number], f"robot {number} of {letter}", ROBOT, findings)
        rows = body.rows
        rows[:, 3] = np.unwrap(last_known(rows[:, 3]))
        rows[:, 6] = np.nan_to_num(rows[:, 6])
        known, at = _resampled(body, grid_ms, kept=7)
        x, y = vector_to_field(at[0], at[1], attack)
        vx, vy = vector_to_field(at[3], at[4], attack)
        tracks[number] = Track(known, np.array([x, y, heading_across(at[2], attack), vx, vy, at[5], at[6]]))
    return tracks


def ball_track(log: TeamLog, letter: str, grid_ms: Array, attack: Array, radius: float, findings: Findings) -> Track:
    """The ball as seen by one team; on the ground if its height is unknown."""
    if not log.balls:
        return Track(np.zeros(len(grid_ms), bool), np.full((7, len(grid_ms)), np.nan))
    findings.place = letter
    body = body_records(log.balls, f"the ball of {letter}", BALL, findings)
    rows = body.rows
    rows[:, 3] = np.fmax(rows[:, 3], radius)
    rows[:, 6] = np.nan_to_num(rows[:, 6])
    known, at = _resampled(body, grid_ms, kept=7)
    x, y = vector_to_field(at[0], at[1], attack)
    vx, vy = vector_to_field(at[3], at[4], attack)
    return Track(known, np.array([x, y, at[2], vx, vy, at[5], at[6]]))


def fuse_balls(first: Track, second: Track, radius: float) -> Track:
    """Where both teams agree, the mean of both balls, weighted with their confidence; else the more confident one.

    An unknown confidence counts as hardly less than the other team's. While neither team sees the ball it stays at its
    last position, and before the first one on the centre mark.
    """
    a, b = np.nan_to_num(first.values), np.nan_to_num(second.values)
    sure_a, sure_b = _confidences(first.values[6], second.values[6])
    sure_a, sure_b = sure_a * first.known, sure_b * second.known
    both = first.known & second.known
    agree = both & (np.hypot(a[0] - b[0], a[1] - b[1]) <= _AGREE_M)
    total = sure_a + sure_b
    share = np.divide(sure_a, total, out=np.full_like(total, 0.5), where=total > 0)
    only_a = first.known & ~(second.known & (sure_b > sure_a))
    seen = np.where(agree, share * a + (1 - share) * b, np.where(only_a, a, b))
    known = first.known | second.known
    newest = np.maximum.accumulate(np.where(known, np.arange(len(known)), -1))
    start = np.array([0.0, 0.0, radius, 0.0, 0.0, 0.0, 0.0])[:, None]
    last = np.where(newest >= 0, seen[:, np.maximum(newest, 0)], start)
    last[3:6, ~known] = 0.0
    last[2, ~known] = radius
    return Track(known, last)


def kicks(robots: dict[str, Track], ball: Track, period: float) -> dict[int, str]:
    """Index of a time → the robot that kicked then: it has lost the ball, and the ball moves away fast.

    Kicks are not in a log; they are inferred.
    """
    with_ball = {name: track.known & (np.nan_to_num(track.values[6]) > 0.5) for name, track in robots.items()}
    count, later = len(ball.known), max(1, round(_KICK_S / period))
    found: dict[int, str] = {}
    for name, mask in with_ball.items():
        for end in (np.flatnonzero(mask[:-1] & ~mask[1:]) + 1).tolist():
            after = min(end + later, count - 1)
            away = np.hypot(*(ball.values[:2, after] - robots[name].values[:2, end - 1]))
            is_taken = any(other[end : after + 1].any() for other in with_ball.values())
            if ball.known[after] and away >= _KICK_M and not is_taken:
                found[end] = name
    return found


def _confidences(first: Array, second: Array) -> tuple[Array, Array]:
    """Both teams' confidences, in place of unknown ones values that the other team's exceed."""
    other_a, other_b = np.where(np.isnan(second), 0.5, second), np.where(np.isnan(first), 0.5, first)
    return np.where(np.isnan(first), 0.999 * other_a, first), np.where(np.isnan(second), 0.999 * other_b, second)


def _resampled(body: BodyRecords, grid_ms: Array, kept: int) -> tuple[Mask, Array]:
    """All columns but the time on the grid; column `kept` is not interpolated, but that of the record before.

    Before a jump, the body stays where it was.
    """
    rows = body.rows
    times = rows[:, 0]
    before = np.searchsorted(times, grid_ms, side="right") - 1
    first = np.maximum(before, 0)
    second = np.minimum(first + 1, len(times) - 1)
    gap_ms = times[second] - times[first]
    near = (gap_ms > 0) & (gap_ms <= GAP_S * 1e3)
    moves = near & ~body.jumps[second]
    share = np.where(moves, (grid_ms - times[first]) / np.where(near, gap_ms, 1.0), 0.0)
    known = (before >= 0) & (near | (grid_ms - times[first] <= _EXTRAPOLATE_S * 1e3))
    values = rows[first] + share[:, None] * (rows[second] - rows[first])
    values[:, kept] = rows[first, kept]
    return known, np.where(known[:, None], values, np.nan)[:, 1:].T
