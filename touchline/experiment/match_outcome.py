"""What came of one match of a study, to and from JSON."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass

Value = float | int | None
"""A figure; None where the match does not show it."""


@dataclass(frozen=True, slots=True)
class PlayedMatch:
    """A match that was played to its end."""

    identity: str
    chain: str
    """The hash chain over all states: equal for equal matches."""
    figures: Mapping[str, Value]
    """Of the match, of cyan as `cyan.NAME` and of magenta as `magenta.NAME`."""


@dataclass(frozen=True, slots=True)
class FailedMatch:
    """A match that was not played to its end."""

    identity: str
    reason: str
    """One line that names robot, tick, file and line where they are known."""


MatchOutcome = PlayedMatch | FailedMatch


def to_json(outcome: MatchOutcome) -> str:
    """The outcome as one line."""
    return json.dumps(asdict(outcome), ensure_ascii=False)


def from_json(text: str) -> MatchOutcome:
    """The outcome of such a line."""
    content = json.loads(text)
    return FailedMatch(**content) if "reason" in content else PlayedMatch(**content)
