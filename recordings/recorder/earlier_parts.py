"""The parts of a recording that earlier recorders of the same match have written, and what these knew of the match."""

from dataclasses import dataclass, field
from pathlib import Path

from recordings.container.manifest import MANIFEST, Manifest, Result
from recordings.container.mcap_file import open_mcap_file
from recordings.container.parts import locked, parts_of
from recordings.container.sealed_metadata import from_metadata
from recordings.reading.recording import open_recording
from recordings.recorder.latched_messages import LATCHED, LatchedMessages
from recordings.recorder.match_progress import FOLLOWED, MatchProgress
from recordings.recorder.sequence_tracker import LossCounts
from schemas.errors import TouchlineError, os_errors
from schemas.topic import Party


@dataclass(slots=True)
class EarlierParts:
    """What the next part goes on from."""

    files: list[Path] = field(default_factory=list)
    loss_counts: LossCounts = field(default_factory=LossCounts)
    latched: LatchedMessages = field(default_factory=LatchedMessages)
    match: MatchProgress = field(default_factory=MatchProgress)
    messages: int = 0
    host_ns: int = 0
    """The host's wall time, ns since 1970, of its newest message before `begins_ns`."""
    begins_ns: int = 0
    """Simulated time of the last message: its tick may be incomplete, and is in the next part."""
    result: Result | None = None
    """The result of the last part; None if its recorder was killed."""


def read_earlier_parts(path: Path, host: int) -> EarlierParts:
    """Read the parts at a path, which are left as they are; `host` is the stream of the host to be recorded.

    Raises:
        TouchlineError: a recorder is writing there, or what is there is of another host, or no recording.
    """
    files = parts_of(path)
    earlier = EarlierParts(files)
    if not files:
        return earlier
    with os_errors(files[-1], "name another file, or move that one away"), locked(files[-1]):
        manifests = [found for file in files if (found := open_mcap_file(file).metadata.get(MANIFEST)) is not None]
        if not manifests:
            return earlier  # a recorder that was killed before it knew its match
        recording = open_recording(path)
    if recording.manifest.host != host:
        raise TouchlineError(f"{path}: is a recording of another match; name another file, or move that one away")
    earlier.result = recording.result
    last_ns = round(max((channel.end for channel in recording.channels), default=0.0) * 1e9)
    earlier.begins_ns = max(last_ns, from_metadata(Manifest, manifests[-1]).begins_ns)
    for recorded in recording.messages(end=earlier.begins_ns / 1e9):
        received = recorded.received()
        earlier.loss_counts.add([received])
        if received.topic.key in LATCHED:
            earlier.latched.update((recorded.log_ns, received))
        if received.key in FOLLOWED:
            earlier.match.update(received)
        earlier.messages += 1
        if recorded.topic.writer is Party.HOST:
            earlier.host_ns = max(earlier.host_ns, recorded.sent_ns)
    earlier.match.catch_up()
    return earlier
