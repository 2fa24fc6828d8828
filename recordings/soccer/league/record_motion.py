"""Velocities and jumps of one body, from the positions in its records.

Teams write velocities of zero, or in other axes. Where recorded velocities contradict the positions they are derived
from these. A position that no body can have reached since the record before is a jump of the localisation: it is no
motion. The times of records in a burst are when they were received: no velocity is judged by these.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from recordings.soccer.league.record_values import BallRow, RobotRow
from recordings.soccer.league.team_log import BURST_S, GAP_S
from schemas.messages.soccer.league.findings import Findings

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

_X, _Y, _THIRD, _VX, _VY, _VTHIRD = 1, 2, 3, 4, 5, 6
"""Columns of a row after its time: two coordinates, heading or height, and their rates."""
_ROUNDING_S = 1e-6
_WINDOW_S = 0.12 + _ROUNDING_S
"""s before and after a record in which its velocity is the slope of the positions. Chosen here: errors of some cm in
positions of 25 Hz become 0.2 m/s."""
_APART_S = 0.04
"""s between the first and the last record from which a velocity is derived. Chosen here: the league's highest rate."""
_MOVES_MPS = 0.7
"""m/s above which a body moves. Chosen here: well above the error of a derived velocity."""
_ENOUGH = 10
"""Records in which a body moves, below which its velocities are not judged as a whole. Chosen here."""


class Limits(NamedTuple):
    """The motion that is possible for a body."""

    speed: float
    """m/s."""
    slack: float
    """m; the error of a position."""


ROBOT = Limits(6.0, 0.3)
BALL = Limits(20.0, 0.6)
"""Chosen here: robots of the league drive at most 5 m/s, and kick at most 15 m/s."""


@dataclass(frozen=True, slots=True)
class BodyRecords:
    """The records of one body, by time."""

    rows: Array
    """A row for each record, like `RobotRow` or `BallRow`; all velocities are known."""
    jumps: Mask
    """Per record: its position is a jump from the record before."""


def body_records(rows: list[RobotRow] | list[BallRow], what: str, limits: Limits, findings: Findings) -> BodyRecords:
    """The records of a body with velocities that follow from its positions where the recorded ones do not.

    Jumps and contradictions are counted in `findings`, at the place that it has.
    """
    table = np.array(rows)
    seconds = (table[:, 0] - table[0, 0]) / 1e3
    jumps, speeds = _jumps(seconds, table, limits)
    if jumps.any():
        fastest = float(speeds[jumps].max())
        findings.note(f"jump of {what}, up to {fastest:.1f} m/s: not counted as motion", count=int(jumps.sum()))
    derived = _slopes(seconds, table[:, [_X, _Y]], jumps)
    missing = np.isnan(table[:, [_VX, _VY]]).any(axis=1)
    wrong = _contradicted(seconds, table, derived) & ~np.isnan(derived[:, 0])
    if wrong.any():
        stated, moved = _mean_speed(table[wrong][:, [_VX, _VY]]), _mean_speed(derived[wrong])
        findings.note(
            f"velocity of {what} contradicts its positions, {stated:.1f} m/s where it moves {moved:.1f} m/s on average"
            ": derived from the positions",
            count=int(wrong.sum()),
        )
    replaced = wrong | missing
    if replaced.any():
        third = last_known(table[:, _THIRD])
        rate = _slopes(seconds, np.unwrap(third)[:, None] if limits is ROBOT else third[:, None], jumps)[:, 0]
        unknown = np.isnan(table[:, _VTHIRD]) | (table[:, _VTHIRD] == 0.0)
        table[replaced, _VX], table[replaced, _VY] = np.nan_to_num(derived[replaced].T)
        table[replaced & unknown, _VTHIRD] = np.nan_to_num(rate[replaced & unknown])
    _clamp(table, what, limits, findings)
    return BodyRecords(table, jumps)


def _clamp(table: Array, what: str, limits: Limits, findings: Findings) -> None:
    """Shorten velocities beyond the limit."""
    speeds = np.hypot(table[:, _VX], table[:, _VY])
    beyond = speeds > limits.speed
    if beyond.any():
        findings.note(
            f"velocity of {what} up to {speeds.max():.1f} m/s: taken for {limits.speed:g} m/s", count=int(beyond.sum())
        )
        table[beyond, _VX : _VY + 1] *= (limits.speed / speeds[beyond])[:, None]


def last_known(values: Array) -> Array:
    """Replace unknown values by the last known one, or 0."""
    newest = np.maximum.accumulate(np.where(np.isnan(values), -1, np.arange(len(values))))
    return np.where(newest >= 0, values[np.maximum(newest, 0)], 0.0)


def _jumps(seconds: Array, table: Array, limits: Limits) -> tuple[Mask, Array]:
    """Per record: whether it is a jump from the record before, and the speed that this would be."""
    duration = np.diff(seconds)
    distance = np.hypot(np.diff(table[:, _X]), np.diff(table[:, _Y]))
    far = (distance > limits.speed * duration + limits.slack) & (duration <= GAP_S)
    speeds = np.divide(distance, duration, out=np.zeros_like(distance), where=duration > 0)
    return np.concatenate([[False], far]), np.concatenate([[0.0], speeds])


def _slopes(seconds: Array, values: Array, jumps: Mask) -> Array:
    """The slope of each column around each record, by least squares; never across a jump or a gap.

    NaN where the records that are left are less than `_APART_S` apart.
    """
    count = len(seconds)
    index = np.arange(count)
    begins = jumps | np.concatenate([[True], np.diff(seconds) > GAP_S])
    first = np.maximum.accumulate(np.where(begins, index, 0))
    ends = np.concatenate([begins[1:], [True]])
    last = np.minimum.accumulate(np.where(ends, index, count)[::-1])[::-1]
    near = _APART_S / 2 - _ROUNDING_S
    low = np.minimum(
        np.searchsorted(seconds, seconds - _WINDOW_S), np.searchsorted(seconds, seconds - near, "right") - 1
    )
    high = np.maximum(
        np.searchsorted(seconds, seconds + _WINDOW_S, "right"), np.searchsorted(seconds, seconds + near) + 1
    )
    low, high = np.maximum(low, first), np.minimum(high, last + 1)
    is_short = seconds[high - 1] - seconds[low] < _APART_S - _ROUNDING_S
    times = seconds.astype(np.longdouble)  # sums over a whole match lose digits that short windows need
    total, number = _sums(times, low, high), (high - low).astype(np.longdouble)
    spread = _sums(times * times, low, high) - total * total / number
    slopes = np.full(values.shape, np.nan)
    for column in range(values.shape[1]):
        value = values[:, column].astype(np.longdouble)
        common = _sums(times * value, low, high) - total * _sums(value, low, high) / number
        np.divide(common, spread, out=slopes[:, column], where=~is_short & (spread > 1e-12), casting="same_kind")
    return slopes


def _sums(values: npt.NDArray[np.longdouble], low: npt.NDArray[np.int64], high: npt.NDArray[np.int64]) -> Any:
    """The sum of the values from `low` up to but not including `high`, for each pair."""
    running = np.concatenate([np.zeros(1, np.longdouble), np.cumsum(values)])
    return running[high] - running[low]


def _contradicted(seconds: Array, table: Array, derived: Array) -> Mask:
    """Per record: whether its velocity is recorded and wrong."""
    recorded = table[:, [_VX, _VY]]
    stated, moved = np.hypot(*recorded.T), np.hypot(*derived.T)
    known: Mask = ~np.isnan(stated)
    faster = np.fmax(stated, moved)
    moves = known & (faster > _MOVES_MPS) & _is_even(seconds)
    wrong = moves & (np.hypot(*(recorded - derived).T) > 0.5 * faster)
    if moves.sum() >= _ENOUGH and wrong.sum() > 0.5 * moves.sum():
        return known
    # a body that stops or starts is at rest on one side of the record
    steps = np.hypot(np.diff(table[:, _X]), np.diff(table[:, _Y])) > _MOVES_MPS * np.diff(seconds)
    passes: Mask = np.concatenate([[False], steps]) & np.concatenate([steps, [False]])
    stands: Mask = moves & (stated == 0.0) & (moved > _MOVES_MPS) & passes
    return stands


def _is_even(seconds: Array) -> Mask:
    """Per record: whether no two records within the window of its velocity are a burst."""
    bursts = np.concatenate([[0], np.cumsum(np.diff(seconds) < BURST_S)])
    low = np.searchsorted(seconds, seconds - _WINDOW_S)
    high = np.searchsorted(seconds, seconds + _WINDOW_S, "right") - 1
    even: Mask = bursts[high] == bursts[low]
    return even


def _mean_speed(velocities: Array) -> float:
    return float(np.hypot(*velocities.T).mean())
