"""What a line of a program is: the command for a sight, or a fault with a sentence that names the line."""

from collections.abc import Collection
from enum import StrEnum
from reprlib import Repr
from typing import NamedTuple

from robot_agent.process.stdio.lines import Line
from schemas.messages.command import Command
from schemas.wire.message import BadMessageError
from schemas.wire.part import json_object

_SHOWN = Repr()
_SHOWN.maxstring = _SHOWN.maxother = 80


class AnswerFault(StrEnum):
    """The kinds of faults, which are counted separately."""

    STRAY = "stray"
    """A line that is no JSON object, such as a message for people."""
    INVALID = "invalid"
    """A JSON object that is no command, or a line that is too long."""
    SECOND = "second"
    """A second answer to one sight."""
    OTHER_TICK = "other_tick"
    """An answer to a sight that the program was not given."""
    LATE = "late"
    """An answer to a sight after which the program was given a newer one."""
    SILENT = "silent"
    """No answer to a sight for a while."""
    UNREAD = "unread"
    """A sight that the program did not read."""


NOT_COMMANDS = frozenset({AnswerFault.STRAY, AnswerFault.INVALID})
"""Faults of lines that no command can be read from."""


class JudgedLine(NamedTuple):
    """What one line is."""

    command: Command | None = None
    """The command to publish; None for a fault."""
    fault: AnswerFault | None = None
    reason: str = ""
    """The fault as a sentence; empty for an answer in time."""
    ends_wait: bool = False
    """The program has answered the awaited sight, also where its answer is invalid."""


class Expected(NamedTuple):
    """What a program has been given."""

    awaited: int | None
    """Tick of the sight whose answer is awaited; None if there is none."""
    given_up: Collection[int] = ()
    """Ticks of earlier sights that were not answered."""
    answered: int | None = None
    """Tick of the sight that was answered last; None before the first."""


def judge(line: Line, expected: Expected) -> JudgedLine:
    """What a line is for a program that was given these sights; an empty line is nothing."""
    content = line.content.strip()
    if not content:
        return JudgedLine()
    is_object = content.startswith(b"{")
    if not is_object:
        reason = "no JSON object; write commands alone to standard output, and messages to standard error"
        return _fault(AnswerFault.STRAY, content, reason)
    if line.is_cut:
        reason = f"longer than {Command.max_bytes} bytes; a command is one short line"
        return _fault(AnswerFault.INVALID, content, reason, ends_wait=True)
    try:
        command = Command.decode(content)
    except BadMessageError as error:
        ends_wait = _tick_in(content) in (None, expected.awaited)
        return _fault(AnswerFault.INVALID, content, str(error), ends_wait=ends_wait)
    return _judge_tick(command, content, expected)


def _judge_tick(command: Command, content: bytes, expected: Expected) -> JudgedLine:
    tick = command.answers_tick
    if tick == expected.awaited:
        return JudgedLine(command, ends_wait=True)
    if tick in expected.given_up:
        late = f"an answer to tick {tick} after newer sights; decide faster"
        return _fault(AnswerFault.LATE, content, late)._replace(command=command)
    if tick == expected.answered:
        return _fault(AnswerFault.SECOND, content, f"a second answer to tick {tick}; write one line for each sight")
    given = "no sight is awaited" if expected.awaited is None else f"the sight is of tick {expected.awaited}"
    return _fault(AnswerFault.OTHER_TICK, content, f"answers_tick is {tick}, {given}; copy the sight's tick")


def _fault(kind: AnswerFault, content: bytes, reason: str, *, ends_wait: bool = False) -> JudgedLine:
    shown = _SHOWN.repr(content.decode("utf-8", "replace"))
    return JudgedLine(None, kind, f"{shown}: {reason}", ends_wait)


def _tick_in(content: bytes) -> int | None:
    """The tick that a line names although it is no command; None if it cannot be read."""
    tick = json_object(content).get("answers_tick")
    return tick if isinstance(tick, int) else None
