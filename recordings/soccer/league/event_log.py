"""Reads the referee box's file of a log: one line for each signal.

`epoch ms,game time(running time),part of the game,signal,description`; the signal is a character in logs until 2019,
and JSON in later ones. The box of 2024 writes the description in place of the signal, then the robot if there is one,
and the team: `Substitution,robotID:3,Falcons`.
"""

import json
import re
from itertools import pairwise
from typing import NamedTuple

from schemas.messages.soccer.league.findings import Findings
from schemas.messages.soccer.league.signals import BY_CHARACTER, BY_DESCRIPTION, BY_NAME, END_GAME, Signal
from schemas.side import Side
from schemas.soccer.game import Phase

_LINE = re.compile(r"\s*(\d+)\s*,([^,]*),([^,]*),(.*)")
_CLOCK = re.compile(r"\s*(\d+):(\d+)(?:\s*\((\d+):(\d+)\))?")
_COLOURS = {"CYAN": Side.CYAN, "MAGENTA": Side.MAGENTA}
_CONNECTION = re.compile(r"New \w+ @|Connection from|Invalid team|ERR |Team .* dropped")
"""Lines of the box on connections, which are no signals."""
_ROBOT = re.compile(r"\s*robotID:(-?\d+),")
_SHORT = 8
"""Characters of a team's name that the box of 2024 writes into the team's own file."""
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
    bare: Side | None = None
    """Where both teams have one name, the side that the name stands for; the other's has the letter A or B behind."""

    def side(self, target: str) -> Side | None:
        """The side that a target refers to; None if it is unknown."""
        name = target.strip().lower()
        if self.team_a is not None:
            return Side.CYAN if name == self.team_a.strip().lower() else Side.MAGENTA
        if self.bare is not None:
            return _LETTERS[name[-1]] if name.endswith((" a", " b")) else self.bare
        by_name = {self.cyan.lower(): Side.CYAN, self.magenta.lower(): Side.MAGENTA}
        short = {one[:_SHORT]: side for one, side in by_name.items()}
        if not self.cyan or not self.magenta or len(by_name) < 2:
            by_name = {}  # both teams have one name, or one has none
        known = {**{side.value: side for side in Side}, **_LETTERS, **by_name}
        return known.get(name, short.get(name[:_SHORT]) if by_name and len(short) == 2 else None)

    def told_apart(self, text: str) -> "TeamNames":
        """The names with `bare`, if both teams have one name and the box marks one of them in this file."""
        if self.cyan.lower() != self.magenta.lower():
            return self
        marked = re.findall(rf",{re.escape(self.cyan.lower())}[^,]* ([ab])\s*$", text.lower(), re.MULTILINE)
        return self._replace(bare=(Side.MAGENTA if "a" in marked else Side.CYAN) if marked else None)


def read_events(text: str, names: TeamNames, findings: Findings) -> list[SignalLine]:
    """All signals of the file, by time; other lines are counted in `findings`."""
    lines: list[SignalLine] = []
    names = names.told_apart(text)
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
    if found is None and _CONNECTION.match(line):
        findings.note("line of the box on connections")
        return None
    if found is None:
        findings.note("line that is not a signal", lost=True)
        return None
    epoch_ms, clock, part, rest = found.groups()
    is_json = rest.lstrip().startswith("{")
    signal, side, description = _parse_2020(rest, names, findings) if is_json else _parse_2016(rest)
    if signal is None and not is_json:
        signal, side, description = _parse_2024(rest, names)
    if signal is None:
        findings.note("unknown signal", lost=True)
        return None
    if part.strip().lower() == "end game" and signal.phase is Phase.HALF_TIME:
        signal, description = END_GAME, END_GAME.description  # the box of 2016 says so after the last part, too
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
    return signal, side, _text(signal, side, fields.get("robotID"), "" if description == "null" else description)


def _parse_2024(rest: str, names: TeamNames) -> tuple[Signal | None, Side | None, str]:
    """A description, the robot and the team."""
    description, _, target = rest.partition(",")
    signal = BY_DESCRIPTION.get(description.strip().lower())
    if signal is None:
        return None, None, ""
    robot = _ROBOT.match(target)
    side = names.side(target[robot.end() :] if robot is not None else target) if signal.sided else None
    return signal, side, _text(signal, side, int(robot[1]) if robot is not None else None)


def _text(signal: Signal, side: Side | None, robot: object, description: str = "") -> str:
    """The line's own description, or one with the side, and the robot."""
    own = f"{signal.description} {side.value}" if side is not None else signal.description
    return (description or own) + (f", robot {robot}" if isinstance(robot, int) and robot >= 0 else "")


def _clock(text: str) -> float | None:
    found = _CLOCK.match(text)
    return 60.0 * int(found[1]) + int(found[2]) if found is not None else None


def _half(part: str) -> int:
    fields = part.lower()
    number = 1 if "1st half" in fields else 2 if "2nd half" in fields else 0
    return number + 2 if number and "overtime" in fields else number
