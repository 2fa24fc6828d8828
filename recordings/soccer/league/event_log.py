"""Reads the referee box's file of a log: one line for each signal.

`epoch ms,game time(running time),part of the game,signal,description`; the signal is a character in logs until 2019,
and JSON in later ones.
"""

import json
import re
from itertools import pairwise
from typing import NamedTuple

from schemas.messages.soccer.league.findings import Findings
from schemas.messages.soccer.league.signals import BY_CHARACTER, BY_NAME, Signal
from schemas.side import Side

_LINE = re.compile(r"\s*(\d+)\s*,([^,]*),([^,]*),(.*)")
_CLOCK = re.compile(r"\s*(\d+):(\d+)(?:\s*\((\d+):(\d+)\))?")
_COLOURS = {"CYAN": Side.CYAN, "MAGENTA": Side.MAGENTA}
_LETTERS = {"a": Side.CYAN, "teama": Side.CYAN, "b": Side.MAGENTA, "teamb": Side.MAGENTA}


class SignalLine(NamedTuple):
    """One signal."""

    epoch_ms: float
    """ms since 1970."""
    signal: Signal
    side: Side | None
    game_s: float | None
    """Clock of the box in s, which restarts with each half; None if the line has none."""
    half: int
    """Number of the half, as in the line; 0 if it has none."""
    text: str
    is_shoot_out: bool = False
    """The line is of the penalty shoot-out."""


class TeamNames(NamedTuple):
    """Names by which a signal may refer to a team."""

    cyan: str
    magenta: str
    team_a: str | None = None
    """The address of team A, cyan, in the log, given by the user; any other address is then team B's."""

    def side(self, target: str) -> Side | None:
        """The side that a target refers to; None if it is unknown."""
        name = target.strip().lower()
        if self.team_a is not None:
            return Side.CYAN if name == self.team_a.strip().lower() else Side.MAGENTA
        by_name = {self.cyan.lower(): Side.CYAN, self.magenta.lower(): Side.MAGENTA}
        if not self.cyan or not self.magenta or len(by_name) < 2:
            by_name = {}  # both teams have one name, or one has none
        return {**{side.value: side for side in Side}, **_LETTERS, **by_name}.get(name)


def read_events(text: str, names: TeamNames, findings: Findings) -> list[SignalLine]:
    """All signals of the file, by time; other lines are counted in `findings`."""
    lines: list[SignalLine] = []
    for number, line in enumerate(text.splitlines(), 1):
        findings.place = f"events, line {number}"
        if line.strip("\x00 \t"):
            read = _parse(line, names, findings)
            if read is not None:
                lines.append(read)
    if any(later.epoch_ms < earlier.epoch_ms for earlier, later in pairwise(lines)):
        findings.note("signals out of order: sorted by time")
    return sorted(lines, key=lambda line: line.epoch_ms)


def _parse(line: str, names: TeamNames, findings: Findings) -> SignalLine | None:
    found = _LINE.fullmatch(line)
    if found is None:
        findings.note("line that is not a signal", lost=True)
        return None
    epoch_ms, clock, part, rest = found.groups()
    is_json = rest.lstrip().startswith("{")
    signal, side, description = _parse_2020(rest, names, findings) if is_json else _parse_2016(rest)
    if signal is None:
        findings.note("unknown signal", lost=True)
        return None
    if signal.sided and side is None:
        findings.note("signal for an unknown team: its name in the log can be given with --team-a", lost=True)
    return SignalLine(
        float(epoch_ms), signal, side, _clock(clock), _half(part), description, "penalties" in part.lower()
    )


def _parse_2016(rest: str) -> tuple[Signal | None, Side | None, str]:
    """A character. The description also names the side, and takes precedence."""
    character, _, description = rest.partition(",")
    signal, side = BY_CHARACTER.get(character.strip(), (None, None))
    if signal is None:
        return None, None, ""
    colour = description.strip().split(" ")[0].upper()
    return signal, _COLOURS.get(colour, side) if signal.sided else None, description.strip() or signal.description


def _parse_2020(rest: str, names: TeamNames, findings: Findings) -> tuple[Signal | None, Side | None, str]:
    """JSON with `command` and `targetTeam`."""
    try:
        fields, end = json.JSONDecoder().raw_decode(rest.lstrip())
    except (ValueError, RecursionError):
        findings.note("signal that is not JSON", lost=True)
        return None, None, ""
    signal = BY_NAME.get(str(fields.get("command", "")).strip().upper())
    if signal is None:
        return None, None, ""
    side = names.side(str(fields.get("targetTeam") or "")) if signal.sided else None
    description = rest.lstrip()[end:].lstrip(", ").strip()
    robot = fields.get("robotID")
    number = f", robot {robot}" if isinstance(robot, int) and robot >= 0 else ""
    if not description or description == "null":
        description = f"{signal.description} {side.value}" if side is not None else signal.description
    return signal, side, description + number


def _clock(text: str) -> float | None:
    found = _CLOCK.match(text)
    return 60.0 * int(found[1]) + int(found[2]) if found is not None else None


def _half(part: str) -> int:
    fields = part.lower()
    number = 1 if "1st half" in fields else 2 if "2nd half" in fields else 0
    return number + 2 if number and "overtime" in fields else number
