"""The recorded messages of each tick of a segment: `host/applied`, `world`, and the commands."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.container.manifest import KeyCount
from recordings.reading.command_check import CommandCheck
from recordings.reading.recording import RecordedMessage, Recording
from recordings.reading.tick_index import Segment
from schemas.game import EventKind
from schemas.messages.applied import Applied
from schemas.messages.game import GameEvent
from schemas.topics import APPLIED, COMMAND, EVENT, WORLD
from schemas.wire.message import BadMessageError

_BEFORE_S = 0.5
_AFTER_S = 2.0
"""Simulated time before and after a segment that is searched for its messages: some are recorded late."""
_SETTLED_NS = 200_000_000
"""Simulated time, in ns, after which the world of a tick has been recorded, if at all."""

_MANUAL_CONTROL = ("manual_control", "hand")
"""Rule of the events on manual control, now and in older recordings."""


class TickRecord(NamedTuple):
    """The messages recorded of one tick."""

    tick: int
    recorded: RecordedMessage
    applied: Applied | None
    """The message `host/applied`; None if it is not valid."""
    world: dict[str, Any] | None
    """The fields of `schemas.messages.world.World`; None if it is missing."""


def command_check_of(recording: Recording, segment: Segment) -> CommandCheck:
    """Return a check of the applied inputs of a segment against the recorded commands.

    A robot that was ever under manual control is left out: manual commands are not recorded.
    """
    keys = [channel.key for channel in recording.channels if channel.topic == "command"]
    driven_manually = {event.robot for _, event in recording.decoded(EVENT.key) if _is_manual_control(event)}
    checked = {key.split("/")[1]: key for key in keys if key.split("/")[1] not in driven_manually}
    counts = recording.result.keys if recording.result is not None else {}
    complete = [robot for robot, key in checked.items() if _none_missing(counts.get(key))]
    return CommandCheck(checked, complete, segment.answers_from)


def _is_manual_control(event: GameEvent) -> bool:
    return event.kind is EventKind.AGENT and event.rule in _MANUAL_CONTROL


def _none_missing(count: KeyCount | None) -> bool:
    return count is not None and count.lost == count.missed_before_start == count.restarts == 0


def tick_records(recording: Recording, segment: Segment, check: CommandCheck) -> Iterator[TickRecord]:
    """Yield the records of the tick before a segment and of the ticks in it, in order.

    The commands of that time are added to `check`.
    """
    held: list[TickRecord] = []
    worlds: dict[int, dict[str, Any]] = {}
    keys = (APPLIED.key, WORLD.key, COMMAND.fill(robot="*"))
    ticks = range(segment.ticks.start - 1, segment.ticks.stop)
    start, end = segment.seconds[0] - _BEFORE_S, segment.seconds[1] + _AFTER_S
    for recorded in recording.messages(*keys, start=max(0.0, start), end=end):
        if recorded.topic is COMMAND:
            check.add_command(recorded)
        elif recorded.topic is WORLD:
            fields = _fields(recorded.current_payload())
            tick = fields.get("tick")
            if isinstance(tick, int) and tick in ticks:
                worlds[tick] = fields
        else:
            record = _tick_record(recorded)
            if record.tick in ticks:
                held.append(record)
        while held and recorded.log_ns - held[0].recorded.log_ns > _SETTLED_NS:
            record = held.pop(0)
            yield record._replace(world=worlds.pop(record.tick, None))
    for record in held:
        yield record._replace(world=worlds.pop(record.tick, None))


def _tick_record(recorded: RecordedMessage) -> TickRecord:
    try:
        applied: Applied = recorded.message()
    except BadMessageError:
        tick = _fields(recorded.payload).get("tick")
        return TickRecord(tick if isinstance(tick, int) else -1, recorded, None, None)
    return TickRecord(applied.tick, recorded, applied, None)


def _fields(payload: bytes) -> dict[str, Any]:
    """The fields of a payload; none if it is not a JSON object."""
    try:
        fields = from_json(payload)
    except ValueError:
        return {}
    return fields if isinstance(fields, dict) else {}
