"""Writes a recording from messages that were not sent on a bus: from a log, or from a match in one process."""

from collections.abc import Iterable
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.recorder.recording_writer import RecordingWriter
from recordings.recorder.sequence_tracker import SequenceTracker
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.errors import TouchlineError
from schemas.game import Phase
from schemas.messages.game import GameState
from schemas.messages.world import World
from schemas.process.clock import WallClock
from schemas.process.whole_file import written_whole
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


def compose(path: Path, manifest: Manifest, attachments: dict[str, bytes], messages: Iterable[TimedMessage]) -> Result:
    """Write the messages, ordered by time, as a finished recording; times of sending follow from simulated time.

    Raises:
        TouchlineError: the file cannot be written.
    """
    try:
        with written_whole(path) as draft:
            writer = RecordingWriter(draft, WallClock())
            try:
                writer.begin(manifest, attachments)
                result = _write(writer, manifest, messages)
                writer.finish(result)
            finally:
                writer.abandon()
    except OSError as error:
        raise TouchlineError(f"{path}: {error.strerror}; give a path that can be written") from None
    return result


def _write(writer: RecordingWriter, manifest: Manifest, messages: Iterable[TimedMessage]) -> Result:
    began_ns = round(datetime.fromisoformat(manifest.started).timestamp() * 1e9)
    trackers: dict[str, SequenceTracker] = {}
    state, tick, time = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME), -1, 0.0
    batch: list[tuple[int, ReceivedMessage]] = []
    for timed in messages:
        tracker = trackers.setdefault(timed.key, SequenceTracker())
        payload = timed.message.encode()
        stamp = Stamp(tracker.messages, began_ns + timed.sim_ns, timed.sim_ns)
        tracker.add(stamp, len(payload))
        batch.append((timed.sim_ns, ReceivedMessage(timed.topic, timed.key, payload, stamp)))
        if isinstance(timed.message, GameState):
            state = timed.message
        elif isinstance(timed.message, World):
            tick, time = timed.message.tick, timed.message.time
        if len(batch) >= _BATCH:
            writer.write(batch)
            batch = []
    writer.write(batch)
    result = Result(
        ended=EndReason.FULL_TIME if state.phase is Phase.FULL_TIME else EndReason.STOPPED,
        finished=manifest.started,
        phase=state.phase if STATE.key in trackers else None,
        score=state.score if STATE.key in trackers else None,
        clock=state.clock,
        tick=tick,
        time=time,
    )
    return result.counted({key: tracker.count() for key, tracker in sorted(trackers.items())})
