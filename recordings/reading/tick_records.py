"""The recorded messages of each tick of a segment: `host/applied`, `world`, the game, and the commands."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from recordings.reading.command_check import CommandCheck
from recordings.reading.record_order import RecordOrder
from recordings.reading.recording import RecordedMessage, Recording
from recordings.reading.tick_index import Segment
from schemas.messages.applied import Applied
from schemas.messages.soccer.game import GameEvent
from schemas.soccer.game import EventKind
from schemas.topics import APPLIED, BELIEF, COMMAND, EVENT, STATE, WORLD
from schemas.wire.message import valid
from schemas.wire.part import json_object

_BEFORE_S = 0.5
_AFTER_S = 2.0
"""Simulated time before and after a segment that is searched for its messages: some are recorded late."""
_SETTLED_NS = 200_000_000
"""Simulated time, in ns, after which the world of a tick has been recorded, if at all."""


class TickRecord(NamedTuple):
    """The messages recorded of one tick."""

    tick: int
    recorded: RecordedMessage
    applied: Applied | None
    """The message `host/applied`; None if it is not valid."""
    world: dict[str, Any] | None
    """The fields of `schemas.messages.world.World`; None if it is missing."""
    states: tuple[RecordedMessage, ...] = ()
    """The messages `game/state` of this tick."""
    events: tuple[RecordedMessage, ...] = ()
    """The messages `game/event` of this tick."""


def command_check_of(recording: Recording, segment: Segment) -> CommandCheck:
    """Return a check of the applied inputs of a segment against the recorded commands.

    A robot that was ever under manual control is left out: manual commands are not recorded.
    """
    keys = [channel.key for channel in recording.channels if channel.topic == "command"]
    driven = manually_driven(recording)
    checked = {key.split("/")[1]: key for key in keys if key.split("/")[1] not in driven}
    counts = recording.result.keys if recording.result is not None else {}
    whole = [key for key, it in counts.items() if it.lost == it.missed_before_start == it.restarts == 0]
    without_loss = [key.split("/")[1] for key in keys if key in whole]
    return CommandCheck(checked, without_loss, segment.answers_from)


def manually_driven(recording: Recording) -> set[str]:
    """The robots that were under manual control at any time."""
    events: Iterator[GameEvent] = (event for _, event in recording.decoded(EVENT.key))
    changes = (event for event in events if event.kind is EventKind.AGENT and event.rule == "manual_control")
    return {event.robot for event in changes if event.robot is not None}


def tick_records(
    recording: Recording, segment: Segment, check: CommandCheck, order: RecordOrder
) -> Iterator[TickRecord]:
    """Yield the records of the tick before a segment, of the ticks in it, and of the tick after it, in order.

    The commands and beliefs of that time are added to `check`, and all messages of the host to `order`.
    """
    held: list[TickRecord] = []
    worlds: dict[int, dict[str, Any]] = {}
    states: dict[int, list[RecordedMessage]] = {}
    events: dict[int, list[RecordedMessage]] = {}

    def complete(record: TickRecord) -> TickRecord:
        tick = record.tick
        return record._replace(
            world=worlds.pop(tick, None), states=tuple(states.pop(tick, ())), events=tuple(events.pop(tick, ()))
        )

    keys = (APPLIED.key, WORLD.key, STATE.key, EVENT.key, BELIEF.fill(), COMMAND.fill(robot="*"))
    ticks = range(segment.ticks.start - 1, segment.ticks.stop + 1)
    start, end = segment.seconds[0] - _BEFORE_S, segment.seconds[1] + _AFTER_S
    for recorded in recording.messages(*keys, start=max(0.0, start), end=end):
        if recorded.topic is COMMAND:
            check.add_command(recorded)
            continue
        if recorded.topic is APPLIED:
            record = _tick_record(recorded)
            if record.tick in ticks:
                order.add(recorded, record.tick)
                held.append(record)
        else:
            fields = json_object(recorded.payload)
            tick = fields.get("tick")
            if not isinstance(tick, int):
                order.add_unreadable(recorded)
                continue
            order.add(recorded, tick)
            if tick not in ticks:
                continue
            if recorded.topic is WORLD:
                worlds.setdefault(tick, fields)
            elif recorded.topic is BELIEF:
                check.add_belief(recorded, tick, fields)
            else:
                (states if recorded.topic is STATE else events).setdefault(tick, []).append(recorded)
        while held and recorded.log_ns - held[0].recorded.log_ns > _SETTLED_NS:
            yield complete(held.pop(0))
    for record in held:
        yield complete(record)


def _tick_record(recorded: RecordedMessage) -> TickRecord:
    applied: Applied | None = valid(recorded.message)
    tick = json_object(recorded.payload).get("tick") if applied is None else applied.tick
    return TickRecord(tick if isinstance(tick, int) else -1, recorded, applied, None)
