"""The course of a match as recorded: what was noted of each tick, where one can begin, what is missing."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import islice
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.answers import Answers
from recordings.manifest import KeyCount
from recordings.reader import Recorded, Recording
from schemas.game import EventKind, GameEvent, GameState, Phase
from schemas.host import Applied
from schemas.message import BadMessageError
from schemas.topics import APPLIED, COMMAND, EVENT, STATE, WORLD

_CHANGES = ("parameters", "robots", "obstacles")
_BEFORE_S = 0.5
_AFTER_S = 2.0
"""Simulated time around a stretch in which messages are looked for that belong to it: some are recorded late."""
_TO_SETTLE = 50
"""Ticks after which a recorder that sets in has every command."""
_SETTLED_NS = 200_000_000
"""Simulated time after which the world of a tick has been recorded, if it was at all."""


class Start(NamedTuple):
    """A tick that a simulation can begin with: tick 0, or one before which the world was rebuilt."""

    tick: int
    kick_off: int | None
    """Counted from 1; nothing where it is no kick-off."""
    changes: tuple[Applied, ...]
    """What was noted before of changes to numbers, robots and obstacles."""


class Why(StrEnum):
    """Why ticks cannot be simulated again."""

    BEFORE = "before"
    """They are older than the recording."""
    MISSING = "missing"
    """They are not in the recording, and others before them are."""
    NO_START = "no_start"
    """They stand before the first tick that a simulation can begin with."""


class LeftOut(NamedTuple):
    """Ticks that cannot be simulated again."""

    first: int
    last: int
    why: Why


class Stretch(NamedTuple):
    """Ticks that are simulated again in one go."""

    ticks: range
    start: Start
    seconds: tuple[float, float]
    """Simulated time of the first and the last of them."""
    answers_from: int
    """The answers to the sights of this tick and later ones must have been recorded."""


@dataclass(slots=True)
class Course:
    """A recording seen from its ticks."""

    starts: list[Start] = field(default_factory=list)
    runs: list[range] = field(default_factory=list)
    """Ticks that were noted one after the other; between two runs some are missing."""
    times: dict[int, float] = field(default_factory=dict)
    """Tick → simulated time in s."""
    unreadable: int = 0
    """Notes that are no valid message."""

    def stretches(self, since: int, worth: float) -> Iterator[Stretch]:
        """Everything from a tick on that can be simulated again, in stretches of at least `worth` ticks."""
        for run in self.runs:
            starts = [start for start in self.starts if start.tick in run and start.tick >= since]
            while starts:
                first = starts.pop(0)
                while starts and starts[0].tick - first.tick < worth:
                    starts.pop(0)
                ticks = range(first.tick, starts[0].tick if starts else run.stop)
                # where a recording sets in, commands may set in a little later
                answers_from = max(ticks.start - 1, run.start + _TO_SETTLE if run.start else 0)
                yield Stretch(ticks, first, (self.times[ticks.start], self.times[ticks[-1]]), answers_from)

    def left_out(self, since: int) -> Iterator[LeftOut]:
        """Ticks from one on that are in no stretch."""
        after = since
        for number, run in enumerate(self.runs):
            if run.stop <= since:
                continue
            if run.start > after:
                yield LeftOut(after, run.start - 1, Why.MISSING if number else Why.BEFORE)
            begins = max(run.start, since)
            first = next((start.tick for start in self.starts if begins <= start.tick < run.stop), run.stop)
            if first > begins:
                yield LeftOut(begins, first - 1, Why.NO_START)
            after = run.stop

    @property
    def kick_offs(self) -> list[Start]:
        """The starts that are kick-offs, in order."""
        return [start for start in self.starts if start.kick_off is not None]


class TickNote(NamedTuple):
    """Everything that was recorded of one tick."""

    tick: int
    recorded: Recorded
    applied: Applied | None
    """What was recorded of it; nothing where that is no valid message."""
    world: dict[str, Any] | None
    """The fields of the `schemas.world.World`; nothing where it is missing."""


def course_of(recording: Recording) -> Course:
    """The course of a recording, from one pass over what was noted of each tick."""
    course = Course()
    changes: list[Applied] = []
    began, kick_offs = _kick_offs(recording), 0
    worlds = {recorded.log_ns for recorded in recording.messages(WORLD.key)}
    standing = _standing(recording)
    before: _Head | None = None
    for recorded in recording.messages(APPLIED.key):
        head = _head(recorded)
        if head is None or (before is not None and head.tick <= before.tick):
            course.unreadable += 1
            continue
        tick = head.tick
        is_next = before is not None and tick == before.tick + 1
        if tick not in standing:
            if is_next and course.runs and course.runs[-1].stop == tick:
                course.runs[-1] = range(course.runs[-1].start, tick + 1)
            else:
                course.runs.append(range(tick - is_next, tick + 1))  # what stood at the last tick counts with it
        if tick == 0 or (head.checkpoint and is_next and before is not None and before.log_ns in worlds):
            is_kick_off = tick - 1 in began
            kick_offs += is_kick_off
            course.starts.append(Start(tick, kick_offs if is_kick_off else None, tuple(changes)))
        if head.changes is not None:
            changes.append(head.changes)
        course.times[tick] = head.time
        before = head
    return course


def _standing(recording: Recording) -> set[int]:
    """Ticks whose notes were repeated when the file was begun, because they stood then."""
    repeated = islice(recording.messages(), recording.manifest.standing)
    heads = [_head(recorded) for recorded in repeated if recorded.topic is APPLIED]
    return {head.tick for head in heads if head is not None}


class _Head(NamedTuple):
    tick: int
    time: float
    log_ns: int
    checkpoint: bool
    changes: Applied | None


def _head(recorded: Recorded) -> _Head | None:
    """What a note says beside the inputs; nothing when it is no valid message."""
    try:
        fields: dict[str, Any] = from_json(recorded.payload)
        tick, time = fields["tick"], fields["time"]
        if not isinstance(tick, int) or not isinstance(time, int | float):
            return None
        changes = recorded.message() if any(name in fields for name in _CHANGES) else None
    except (BadMessageError, ValueError, KeyError, TypeError):
        return None
    return _Head(tick, time, recorded.log_ns, bool(fields.get("checkpoint")), changes)


def _kick_offs(recording: Recording) -> set[int]:
    """The ticks at which a kick-off was started: the state of the game says that it is running now."""
    ticks, was_running = set(), False
    state: GameState
    for _, state in recording.decoded(STATE.key):
        runs = state.phase is Phase.KICK_OFF and state.running
        if runs and not was_running:
            ticks.add(state.tick)
        was_running = runs
    return ticks


def answers_of(recording: Recording, stretch: Stretch) -> Answers:
    """Ready to compare what robots were told in a stretch with what their programs said.

    A robot that was ever driven by hand is left out: a hand's words are not recorded.
    """
    keys = [channel.key for channel in recording.channels if channel.topic == "command"]
    by_hand = {event.robot for _, event in recording.decoded(EVENT.key) if _is_of_hand(event)}
    checked = {key.split("/")[1]: key for key in keys if key.split("/")[1] not in by_hand}
    counts = recording.result.keys if recording.result is not None else {}
    complete = [robot for robot, key in checked.items() if _none_missing(counts.get(key))]
    return Answers(checked, complete, stretch.answers_from)


def _is_of_hand(event: GameEvent) -> bool:
    return event.kind is EventKind.AGENT and event.rule == "hand"


def _none_missing(count: KeyCount | None) -> bool:
    return count is not None and count.lost == count.missed_before_start == count.restarts == 0


def notes(recording: Recording, stretch: Stretch, answers: Answers) -> Iterator[TickNote]:
    """What was recorded of the tick before a stretch and of those in it, in order.

    `answers` gets to know the commands of their time.
    """
    held: list[TickNote] = []
    worlds: dict[int, dict[str, Any]] = {}
    keys = (APPLIED.key, WORLD.key, COMMAND.fill(robot="*"))
    ticks = range(stretch.ticks.start - 1, stretch.ticks.stop)
    start, end = stretch.seconds[0] - _BEFORE_S, stretch.seconds[1] + _AFTER_S
    for recorded in recording.messages(*keys, start=max(0.0, start), end=end):
        if recorded.topic is COMMAND:
            answers.sent(recorded)
        elif recorded.topic is WORLD:
            fields = _fields(recorded.payload)
            tick = fields.get("tick")
            if isinstance(tick, int) and tick in ticks:
                worlds[tick] = fields
        else:
            note = _note(recorded)
            if note.tick in ticks:
                held.append(note)
        while held and recorded.log_ns - held[0].recorded.log_ns > _SETTLED_NS:
            note = held.pop(0)
            yield note._replace(world=worlds.pop(note.tick, None))
    for note in held:
        yield note._replace(world=worlds.pop(note.tick, None))


def _note(recorded: Recorded) -> TickNote:
    try:
        applied: Applied = recorded.message()
    except BadMessageError:
        tick = _fields(recorded.payload).get("tick")
        return TickNote(tick if isinstance(tick, int) else -1, recorded, None, None)
    return TickNote(applied.tick, recorded, applied, None)


def _fields(payload: bytes) -> dict[str, Any]:
    """The fields of a message; none when it is not JSON."""
    try:
        fields = from_json(payload)
    except ValueError:
        return {}
    return fields if isinstance(fields, dict) else {}
