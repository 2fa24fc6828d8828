"""Checks that the inputs a host reports in `host/applied` are the recorded commands of the robots' programs."""

from collections.abc import Container, Iterable
from itertools import islice
from operator import attrgetter
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.reading.recording import RecordedMessage
from schemas.messages.applied import Applied, AppliedInput
from schemas.messages.command import Command
from schemas.wire.message import valid

_KEPT = 1000
"""Ticks whose commands are kept for each robot: longer than any command stays in force."""
_RADIO_COMMANDS = 10
"""Newest commands of a robot among which the one with a published belief is searched."""


class CommandMismatch(NamedTuple):
    """A difference between an applied input, or a belief, and the command that it claims to be."""

    tick: int
    """Tick at which the input was applied, or the belief published."""
    robot: str
    field: str
    """Field that differs, `drive.vx`; `command` if no such command was recorded; `belief` for a belief that no command
    of the robot sent."""
    applied: object
    sent: object


class _SentCommand(NamedTuple):
    recorded: RecordedMessage
    fields: dict[str, Any]
    """Fields of the payload, not validated."""


class _PendingBelief(NamedTuple):
    tick: int
    recorded: RecordedMessage
    radio: Any
    """The radio message, not validated."""


class CommandCheck:
    """Collects commands, applied inputs and beliefs of a segment of a match."""

    def __init__(self, checked: Container[str], complete: Container[str], first_tick: int) -> None:
        """`checked`: robots moved by recorded commands only; `complete`: robots without lost commands.

        The answers to sights of `first_tick` and later must have been recorded.
        """
        self._checked = checked
        self._complete = complete
        self._first_tick = first_tick
        self._sent: dict[str, dict[int, list[_SentCommand]]] = {}
        self._pending: dict[tuple[str, int], tuple[int, AppliedInput]] = {}
        self._unsent: dict[str, list[_PendingBelief]] = {}
        """Robot → beliefs whose command may still come."""
        self._mismatches: list[CommandMismatch] = []

    def add_command(self, recorded: RecordedMessage) -> None:
        """Add a recorded command."""
        robot = recorded.key.split("/")[1]
        kept = self._sent.setdefault(robot, {})
        try:
            fields = from_json(recorded.payload)
            kept.setdefault(fields["answers_tick"], []).append(_SentCommand(recorded, fields))
        except (ValueError, KeyError, TypeError):
            return  # the host ignored it, too
        unsent = self._unsent.get(robot)
        if unsent:
            radio = fields.get("radio")
            self._unsent[robot] = [one for one in unsent if one.radio != radio]
        if len(kept) > _KEPT:
            del kept[next(iter(kept))]

    def add_applied(self, applied: Applied) -> None:
        """Add the inputs that the host applied in a tick."""
        for robot, input_ in applied.inputs.items():
            if input_.answers_tick is None or robot not in self._checked:
                continue
            sent = self._sent.get(robot, {}).get(input_.answers_tick)
            if sent is not None:
                self._mismatches += _compare(applied.tick, robot, input_, sent)
            elif robot in self._complete and input_.answers_tick >= self._first_tick:
                self._pending[robot, input_.answers_tick] = applied.tick, input_

    def add_belief(self, recorded: RecordedMessage, tick: int, fields: dict[str, Any]) -> None:
        """Add a belief, published at this tick, that a robot has sent with a command before."""
        robot = recorded.key.rsplit("/", 1)[1]
        if robot not in self._complete or tick <= self._first_tick:
            return
        radio = fields.get("radio")
        newest = islice(reversed(self._sent.get(robot, {}).values()), _RADIO_COMMANDS)
        if any(one.fields.get("radio") == radio for commands in newest for one in commands):
            return
        unsent = self._unsent.setdefault(robot, [])
        unsent.append(_PendingBelief(tick, recorded, radio))
        if len(unsent) > _KEPT // 2:
            self._resolve_beliefs(robot)

    def _resolve_beliefs(self, robot: str) -> None:
        """Compare beliefs with commands as messages, whatever JSON the program writes that sent them."""
        radios = []
        for one in [one for commands in self._sent.get(robot, {}).values() for one in commands]:
            if one.fields.get("radio") is not None:
                command = valid(one.recorded.message)
                radios += [] if command is None else [command.radio]
        for belief in self._unsent.pop(robot, []):
            published = valid(belief.recorded.message)
            if published is None or published.radio not in radios:
                self._mismatches.append(CommandMismatch(belief.tick, robot, "belief", belief.radio, None))

    def mismatches(self) -> list[CommandMismatch]:
        """All mismatches by tick, after the last command and the last applied inputs were added."""
        for (robot, answers), (tick, input_) in self._pending.items():
            sent = self._sent.get(robot, {}).get(answers)
            if sent is None:
                self._mismatches.append(CommandMismatch(tick, robot, "command", f"answers tick {answers}", None))
            else:
                self._mismatches += _compare(tick, robot, input_, sent)
        self._pending = {}
        for robot in list(self._unsent):
            self._resolve_beliefs(robot)
        return sorted(self._mismatches, key=attrgetter("tick"))


def _compare(tick: int, robot: str, input_: AppliedInput, sent: Iterable[_SentCommand]) -> list[CommandMismatch]:
    """Differences of an input from the commands that answer the same sight; none if it equals one of them."""
    if any(_is_verbatim(input_, candidate.fields) for candidate in sent):
        return []
    mismatches: list[CommandMismatch] = []
    applied = _fields(input_)
    for candidate in sent:
        command = valid(candidate.recorded.message)
        if command is None:
            continue
        claimed = _fields(command)
        if claimed == applied:
            return []
        mismatches = mismatches or [
            CommandMismatch(tick, robot, name, applied[name], claimed[name])
            for name in applied
            if applied[name] != claimed[name]
        ]
    return mismatches or [CommandMismatch(tick, robot, "command", "applied", None)]


def _is_verbatim(input_: AppliedInput, fields: dict[str, Any]) -> bool:
    """Whether a command, encoded as by this library, equals the input; a fast check for the most frequent case."""
    drive, command_drive = input_.drive, fields.get("drive")
    return (
        input_.kick is None
        and fields.get("kick", 0) is None
        and fields.get("dribble") is input_.dribble
        and command_drive == {"vx": drive.vx, "vy": drive.vy, "omega": drive.omega}
    )


def _fields(message: AppliedInput | Command) -> dict[str, Any]:
    drive, kick = message.drive, message.kick
    return {
        "drive.vx": drive.vx,
        "drive.vy": drive.vy,
        "drive.omega": drive.omega,
        "dribble": message.dribble,
        "kick.mode": None if kick is None else kick.mode.value,
        "kick.speed": None if kick is None else kick.speed,
    }
