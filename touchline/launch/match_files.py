"""What a match has left in files. What reads recordings is imported on use, after the processes are launched."""

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

from touchline.launch.processes import MatchPlan

if TYPE_CHECKING:
    from schemas.bus.contract import ReceivedMessage


def published_by(plan: MatchPlan) -> "Iterator[ReceivedMessage]":
    """Events and the last state of the game, as the host has left them."""
    from schemas.bus.outcome_file import read_outcome

    return read_outcome(plan.outcome)


def losses_of(plan: MatchPlan) -> dict[str, int]:
    """Key → number of messages missing in the recording; keys without loss are left out."""
    if plan.recording is None:
        return {}
    from recordings.inspection.recording_facts import facts_of
    from recordings.reading.recording import open_recording

    losses: Counter[str] = Counter()
    for file in plan.recording_files:
        losses.update({key.key: key.lost for key in facts_of(open_recording(file)).keys if key.lost})
    return dict(losses)
