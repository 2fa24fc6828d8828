"""Writes a recording from messages that no bus delivers: of a log, of a match in one process, of another recording."""

from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.container.parts import NotWritableError
from recordings.recorder.recording_writer import LoggedMessage, RecordingWriter
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.sequence_tracker import LossCounts
from runtime.bus.contract import ReceivedMessage, Stamp
from runtime.process.clock import WallClock
from runtime.process.whole_file import written_whole
from schemas.messages.soccer.game import GameState
from schemas.messages.world import World
from schemas.soccer.game import Phase
from schemas.topic import Topic
from schemas.topics import STATE
from schemas.wire.message import Message

_BATCH = 500
"""Messages that are passed to the writer at a time."""


class TimedMessage(NamedTuple):
    """One message and its simulated time in ns."""

    sim_ns: int
    topic: Topic
    key: str
    message: Message


class Composition:
    """A recording that is being written."""

    def __init__(self, writer: RecordingWriter, begins_ns: int) -> None:
        self._writer, self._begins_ns = writer, begins_ns
        self._counts = LossCounts()
        self._batch: list[LoggedMessage] = []
        self.messages = 0
        """Messages so far."""

    def add(self, log_ns: int, received: ReceivedMessage) -> None:
        """Write a message; one from before the beginning of the recording is not in its counts."""
        self.messages += 1
        if log_ns >= self._begins_ns:
            self._counts.add([received])
        self._batch.append((log_ns, received))
        if len(self._batch) >= _BATCH:
            self._flush()

    def finish(self, result: Result | None) -> Result | None:
        """Write the result with the counts of this file, and return it."""
        self._flush()
        counted = result.counted(self._counts.counts()) if result is not None else None
        self._writer.finish(counted)
        return counted

    def _flush(self) -> None:
        self._writer.write(self._batch)
        self._batch = []


@contextmanager
def composition(
    path: Path,
    manifest: Manifest,
    attachments: dict[str, bytes],
    roster: RosterMetadata | None = None,
    *,
    viz: bool = True,
) -> Iterator[Composition]:
    """A recording to be written in the block, which appears at `path` when it is complete.

    Raises:
        TouchlineError: the file cannot be written.
    """
    try:
        with written_whole(path) as draft:
            writer = RecordingWriter(draft, WallClock(), viz=viz)
            try:
                writer.begin(manifest, attachments, roster)
                yield Composition(writer, manifest.begins_ns)
            finally:
                writer.abandon()
    except NotWritableError as error:
        raise NotWritableError(path, error.reason) from None
    except OSError as error:
        raise NotWritableError(path, error.strerror or str(error)) from None


def compose(path: Path, manifest: Manifest, attachments: dict[str, bytes], messages: Iterable[TimedMessage]) -> Result:
    """Write the messages, ordered by time, as a finished recording; times of sending follow from simulated time.

    Raises:
        TouchlineError: the file cannot be written.
    """
    began_ns = round(datetime.fromisoformat(manifest.started).timestamp() * 1e9)
    numbers: Counter[str] = Counter()
    state, tick, time = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME), -1, 0.0
    with composition(path, manifest, attachments) as recording:
        for timed in messages:
            stamp = Stamp(numbers[timed.key], began_ns + timed.sim_ns, timed.sim_ns)
            numbers[timed.key] += 1
            recording.add(timed.sim_ns, ReceivedMessage(timed.topic, timed.key, timed.message.encode(), stamp))
            if isinstance(timed.message, GameState):
                state = timed.message
            elif isinstance(timed.message, World):
                tick, time = timed.message.tick, timed.message.time
        result = Result(
            ended=EndReason.FULL_TIME if state.phase is Phase.FULL_TIME else EndReason.STOPPED,
            finished=manifest.started,
            phase=state.phase if STATE.key in numbers else None,
            score=state.score if STATE.key in numbers else None,
            clock=state.clock,
            tick=tick,
            time=time,
        )
        return recording.finish(result) or result
