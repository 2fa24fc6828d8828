"""What a match has left in files. What reads recordings is imported on use, after the processes are launched."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from schemas.errors import TouchlineError
from touchline.launch.processes import MatchPlan

if TYPE_CHECKING:
    from schemas.bus.contract import ReceivedMessage


def published_by(plan: MatchPlan) -> "Iterator[ReceivedMessage]":
    """Events and the last state of the game, as the host has left them."""
    from schemas.bus.outcome_file import read_outcome

    return read_outcome(plan.outcome)


def losses_of(plan: MatchPlan) -> dict[str, int]:
    """Key → number of messages missing in the recording; keys without loss are left out.

    Raises:
        TouchlineError: the recording cannot be read, or is not that of the whole match.
    """
    if plan.recording is None:
        return {}
    from recordings.inspection.recording_facts import facts_of
    from recordings.reading.recording import open_recording

    facts = facts_of(open_recording(plan.recording))
    last = max((one.message().tick for one in published_by(plan)), default=-1)
    if facts.tick < last:
        raise TouchlineError(f"it ends with tick {facts.tick}, the match with tick {last} or a later one")
    return {key.key: key.lost for key in facts.keys if key.lost}
