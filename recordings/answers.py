"""Whether the inputs that a host says it applied are the commands that are recorded of the robots' programs."""

from collections.abc import Container, Iterable
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.reader import Recorded
from schemas.command import Command
from schemas.host import Applied, AppliedInput
from schemas.message import BadMessageError

_KEPT = 1000
"""Commands of one robot that are kept: longer than any of them counts."""


class Contradiction(NamedTuple):
    """An input, and the command that it is said to be."""

    tick: int
    """At which it was applied."""
    robot: str
    field: str
    """`drive.vx`; `command` where none was recorded."""
    applied: object
    sent: object


class _Sent(NamedTuple):
    payload: bytes
    fields: dict[str, Any]
    """As they stand in it, not validated."""


class Answers:
    """Follows commands and inputs of a stretch of a match."""

    def __init__(self, checked: Container[str], complete: Container[str], first_tick: int) -> None:
        """`checked`: robots that are moved by recorded commands; `complete`: those of them of whose none is missing.

        The answers to sights of `first_tick` and later must have been recorded.
        """
        self._checked = checked
        self._complete = complete
        self._first_tick = first_tick
        self._sent: dict[str, dict[int, list[_Sent]]] = {}
        self._awaited: dict[tuple[str, int], tuple[int, AppliedInput]] = {}
        self._found: list[Contradiction] = []

    def sent(self, recorded: Recorded) -> None:
        """A program sent a command."""
        robot = recorded.key.split("/")[1]
        try:
            fields = from_json(recorded.payload)
            answers = fields["answers_tick"]
        except (ValueError, KeyError, TypeError):
            return  # the host took no notice of it either
        kept = self._sent.setdefault(robot, {})
        kept.setdefault(answers, []).append(_Sent(recorded.payload, fields))
        if len(kept) > _KEPT:
            del kept[next(iter(kept))]

    def applied(self, applied: Applied) -> None:
        """A host applied these inputs."""
        for robot, given in applied.inputs.items():
            if given.answers_tick is None or robot not in self._checked:
                continue
            sent = self._sent.get(robot, {}).get(given.answers_tick)
            if sent is not None:
                self._found += _compared(applied.tick, robot, given, sent)
            elif robot in self._complete and given.answers_tick >= self._first_tick:
                self._awaited[robot, given.answers_tick] = applied.tick, given

    def contradictions(self) -> list[Contradiction]:
        """All that were found, in the order of their ticks, when nothing more comes."""
        for (robot, answers), (tick, given) in self._awaited.items():
            sent = self._sent.get(robot, {}).get(answers)
            if sent is None:
                self._found.append(Contradiction(tick, robot, "command", f"answers tick {answers}", None))
            else:
                self._found += _compared(tick, robot, given, sent)
        self._awaited = {}
        return sorted(self._found, key=_tick_of)


def _tick_of(one: Contradiction) -> int:
    return one.tick


def _compared(tick: int, robot: str, given: AppliedInput, sent: Iterable[_Sent]) -> list[Contradiction]:
    """Where an input is none of the commands that answer the same sight; nothing where it is one of them."""
    if any(_is_plainly(given, one.fields) for one in sent):
        return []
    found: list[Contradiction] = []
    applied = _fields(given)
    for one in sent:
        try:
            said = _fields(Command.decode(one.payload))
        except BadMessageError:
            continue
        if said == applied:
            return []
        found = found or [
            Contradiction(tick, robot, name, applied[name], said[name])
            for name in applied
            if applied[name] != said[name]
        ]
    return found or [Contradiction(tick, robot, "command", "applied", None)]


def _is_plainly(given: AppliedInput, fields: dict[str, Any]) -> bool:
    """Whether a command says just that in the words of this library; one that leaves out what is nothing may, too."""
    drive, told = given.drive, fields.get("drive")
    return (
        given.kick is None
        and fields.get("kick", 0) is None
        and fields.get("dribble") is given.dribble
        and told == {"vx": drive.vx, "vy": drive.vy, "omega": drive.omega}
    )


def _fields(told: AppliedInput | Command) -> dict[str, Any]:
    drive, kick = told.drive, told.kick
    return {
        "drive.vx": drive.vx,
        "drive.vy": drive.vy,
        "drive.omega": drive.omega,
        "dribble": told.dribble,
        "kick.mode": None if kick is None else kick.mode.value,
        "kick.speed": None if kick is None else kick.speed,
    }
