"""Writes a recording from messages that were not sent on a bus: from a log, or from a match in one process."""

from collections.abc import Iterable
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.recorder.recording_writer import RecordingWriter
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.sequence_tracker import SequenceTracker
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.game import Phase
from schemas.messages.game import GameState
from schemas.messages.world import World
from schemas.process.clock import WallClock
from schemas.topic import Topic
from schemas.topics import EVENT, STATE
from schemas.wire.message import WireMessage

_BATCH = 500
"""Messages that are passed to the writer at a time."""


class TimedMessage(NamedTuple):
    """One message and its simulated time in ns."""

    sim_ns: int
    topic: Topic
    key: str
    message: WireMessage


def compose(path: Path, manifest: Manifest, attachments: dict[str, bytes], messages: Iterable[TimedMessage]) -> Result:
    """Write the messages, ordered by time, as a finished recording; times of sending follow from simulated time.

    Raises:
        TouchlineError: the file cannot be written.
    """
    clock = WallClock()
    began_ns = round(datetime.fromisoformat(manifest.started).timestamp() * 1e9)
    writer = RecordingWriter(path, clock, manifest.match, RosterMetadata(manifest.setup))
    trackers: dict[str, SequenceTracker] = {}
    state, tick, time = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME), -1, 0.0
    try:
        writer.begin(manifest, attachments)
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
        counts = {key: tracker.count() for key, tracker in sorted(trackers.items())}
        result = Result(
            ended=EndReason.FULL_TIME if state.phase is Phase.FULL_TIME else EndReason.STOPPED,
            finished=manifest.started,
            phase=state.phase if STATE.key in counts else None,
            score=state.score if STATE.key in counts else None,
            clock=state.clock,
            tick=tick,
            time=time,
            events=counts[EVENT.key].messages if EVENT.key in counts else 0,
            messages=sum(count.messages for count in counts.values()),
            keys=counts,
        )
        writer.finish(result)
    finally:
        writer.abandon()
    return result
