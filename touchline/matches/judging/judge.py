"""The verdict of a drill, from what happens in it."""

from collections.abc import Sequence
from dataclasses import dataclass

from schemas.config.soccer.drill import Drill, DrillResult
from touchline.matches.judging.occurrences import Occurrence

NO_CONDITION = "none of the conditions"
"""Why a drill ended whose time was over."""


@dataclass(frozen=True, slots=True)
class DrillVerdict:
    """How a drill ended."""

    success: bool
    because: str
    """The condition that was met, as in the scene: `goal:cyan`; `none of the conditions` when the time is over."""
    time: float
    """Time in s since the start."""


def verdict_of(drill: Drill, time: float, occurrences: Sequence[Occurrence]) -> DrillVerdict | None:
    """The verdict after a tick at this time in s in which this happened; None while the drill goes on."""
    for conditions, success in ((drill.failure, False), (drill.success, True)):
        for condition in conditions:
            if any(one.is_meant_by(condition) for one in occurrences):
                return DrillVerdict(success, condition, time)
    if time >= drill.seconds - 1e-9:
        return DrillVerdict(drill.otherwise is DrillResult.SUCCESS, NO_CONDITION, time)
    return None
