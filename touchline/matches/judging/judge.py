"""The verdict of a drill, from what happens in it."""

from collections.abc import Sequence
from dataclasses import dataclass

from recordings.stats.match_tick import MatchTick
from schemas.config.drill import Drill, DrillResult
from schemas.messages.setup import Setup
from touchline.matches.judging.occurrences import Occurrence, OccurrenceTracker

NO_CONDITION = "none of the conditions"
"""Why a drill ended whose time was over."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """How a drill ended."""

    success: bool
    because: str
    """The condition that was met, as in the scene: `goal:cyan`; `none of the conditions` when the time is over."""
    time: float
    """Time in s since the start."""


def verdict_of(drill: Drill, time: float, occurrences: Sequence[Occurrence]) -> Verdict | None:
    """The verdict after a tick at this time in s in which this happened; None while the drill goes on."""
    for conditions, success in ((drill.failure, False), (drill.success, True)):
        for condition in conditions:
            if any(one.is_meant_by(condition) for one in occurrences):
                return Verdict(success, condition, time)
    if time >= drill.seconds - 1e-9:
        return Verdict(drill.otherwise is DrillResult.SUCCESS, NO_CONDITION, time)
    return None


class Judge:
    """Follows a drill to its verdict."""

    def __init__(self, drill: Drill, setup: Setup) -> None:
        self._drill = drill
        self._tracker = OccurrenceTracker(setup)

    def update(self, tick: MatchTick) -> Verdict | None:
        """Add a tick; the verdict after it, None while the drill goes on."""
        return verdict_of(self._drill, tick.world.time, self._tracker.update(tick))
