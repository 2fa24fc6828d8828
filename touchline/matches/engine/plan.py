"""A plan: which matches can be played, given the outcomes so far."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from schemas.errors import TouchlineError
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.planned_match import PlannedMatch


class Plan(Protocol):
    """A pure function of outcomes. Resumption after a crash, and equal results in any order, follow from that."""

    def due(self, outcomes: Mapping[str, Outcome]) -> Sequence[PlannedMatch]:
        """All matches that can be played now and have no outcome; the plan is complete when there is none.

        Args:
            outcomes: identity → outcome. While matches are being played, theirs are missing, and they are due still.
        """


@dataclass(frozen=True, slots=True)
class ListPlan:
    """All matches are known from the beginning."""

    matches: tuple[PlannedMatch, ...]

    def __post_init__(self) -> None:
        seen: dict[str, PlannedMatch] = {}
        for one in self.matches:
            if (other := seen.get(one.identity)) is not None:
                raise TouchlineError(
                    f'the plan has "{other.label}" and "{one.label}", which are the same match; give another seed'
                )
            seen[one.identity] = one

    def due(self, outcomes: Mapping[str, Outcome]) -> Sequence[PlannedMatch]:
        """The matches without an outcome."""
        return [one for one in self.matches if one.identity not in outcomes]
