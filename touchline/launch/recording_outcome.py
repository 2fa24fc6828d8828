"""What became of a match's recording: where it is, what it misses, and what can be done about it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from runtime.bus.outcome_file import read_outcome
from runtime.process.ending import ending
from schemas.errors import TouchlineError
from schemas.topic import Party
from schemas.topics import recorded_topic
from touchline.launch.processes.programs import MatchPlan


@dataclass(frozen=True, slots=True)
class RecordingOutcome:
    """The recording of a match that was played to its end."""

    path: Path | None
    """The recording; None if there is none, or if nothing of it is left."""
    losses: Mapping[str, int]
    """Key → messages that are missing in it; keys without losses are left out."""
    fault: str = ""
    """Why it does not have all that the host published and received, and the remedy, in one sentence; empty if it has,
    or if none was asked for."""


NO_RECORDING = RecordingOutcome(None, {})
"""No recording was asked for."""


def outcome_of(plan: MatchPlan, status: int | None, log: Sequence[str]) -> RecordingOutcome:
    """The outcome after the recorder has ended with this exit status and these last lines of its log."""
    from recordings.container.parts import parts_of

    if (path := plan.recording) is None:
        return NO_RECORDING
    parts = parts_of(path)
    reason = f"the recorder {ending(status)}" if status else "it is missing"
    if status is not None and status > 0 and log:
        reason = log[-1].removeprefix("touchline: ")
    if status == 0 and parts:
        try:
            return finished_recording(path, losses_of(path, plan))
        except TouchlineError as error:
            reason = str(error)
    return unfinished_recording(path, parts, reason, plan.folder / "recorder.log")


def losses_of(path: Path, plan: MatchPlan) -> dict[str, int]:
    """Key → number of messages missing in the recording; keys without loss are left out.

    Raises:
        TouchlineError: the recording cannot be read, or is not that of the whole match.
    """
    from recordings.inspection.recording_facts import facts_of
    from recordings.reading.recording import open_recording

    facts = facts_of(open_recording(path))
    last = max((one.message().tick for one in read_outcome(plan.outcome)), default=-1)
    if facts.tick < last:
        raise TouchlineError(f"it ends with tick {facts.tick}, the match with tick {last} or a later one")
    return {key.key: key.lost for key in facts.keys if key.lost}


def finished_recording(path: Path, losses: Mapping[str, int]) -> RecordingOutcome:
    """The outcome if the recorder has finished.

    Messages of robots and coaches that the host did not receive are losses of the link between them: the recording has
    what the host has received. What the host has published is missing only where its batches were lost.
    """
    if not any(topic is not None and topic.writer is Party.HOST for topic in map(recorded_topic, losses)):
        return RecordingOutcome(path, losses)
    counts = ", ".join(f"{key} {count}" for key, count in losses.items())
    fault = (
        f"the recording misses {sum(losses.values())} messages ({counts}): "
        f"the host no longer kept them when the recorder asked; {path} has all others"
    )
    return RecordingOutcome(path, losses, fault)


def unfinished_recording(path: Path, left: Sequence[Path], reason: str, log: Path) -> RecordingOutcome:
    """The outcome if the recorder has not finished: `left` are its parts."""
    if not left:
        return RecordingOutcome(None, {}, f"the recording {path} is lost: {reason}; the recorder's log is {log}")
    fault = f"the recording is not complete: {reason}; {path} has what was written; the recorder's log is {log}"
    return RecordingOutcome(path, {}, fault)
