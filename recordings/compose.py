"""Writes a recording of messages that came over no bus: from a log, or from a match in one process."""

from collections.abc import Iterable
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

from recordings.cast import Cast
from recordings.manifest import Ended, Manifest, Result
from recordings.sequences import KeyLedger
from recordings.writer import RecordingWriter
from schemas.bus.contract import Received, Stamp
from schemas.clock import WallClock
from schemas.game import GameState, Phase
from schemas.message import Message
from schemas.topic import Topic
from schemas.topics import EVENT, STATE
from schemas.world import World

_BATCH = 500
"""Messages handed to the writer at a time."""


class Said(NamedTuple):
    """One message, and when it was said, in ns of simulated time."""

    sim_ns: int
    topic: Topic
    key: str
    message: Message


def compose(path: Path, manifest: Manifest, attachments: dict[str, bytes], said: Iterable[Said]) -> Result:
    """Write the messages, in the order of their times, as a finished recording; they were sent as simulated time went.

    Raises:
        TouchlineError: the file cannot be written.
    """
    clock = WallClock()
    began_ns = round(datetime.fromisoformat(manifest.started).timestamp() * 1e9)
    writer = RecordingWriter(path, clock, manifest.match, Cast(manifest.setup))
    ledgers: dict[str, KeyLedger] = {}
    state, tick, time = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME), -1, 0.0
    try:
        writer.begin(manifest, attachments)
        batch: list[tuple[int, Received]] = []
        for one in said:
            ledger = ledgers.setdefault(one.key, KeyLedger())
            payload = one.message.encode()
            stamp = Stamp(ledger.messages, began_ns + one.sim_ns, one.sim_ns)
            ledger.enter(stamp, len(payload))
            batch.append((one.sim_ns, Received(one.topic, one.key, payload, stamp)))
            if isinstance(one.message, GameState):
                state = one.message
            elif isinstance(one.message, World):
                tick, time = one.message.tick, one.message.time
            if len(batch) >= _BATCH:
                writer.write(batch)
                batch = []
        writer.write(batch)
        counts = {key: ledger.count() for key, ledger in sorted(ledgers.items())}
        result = Result(
            ended=Ended.FULL_TIME if state.phase is Phase.FULL_TIME else Ended.STOPPED,
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
