"""The referee box's own file of a log: one line for each signal.

`epoch ms,game time(running time),part of the game,signal,description`; the signal is a character until 2019, JSON
since.
"""

import json
import re
from itertools import pairwise
from typing import NamedTuple

from schemas.league.findings import Findings
from schemas.league.signals import BY_CHARACTER, BY_NAME, Signal
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
    """The box's clock, which begins anew with each half."""
    half: int
    """As the line itself says, 0 when it does not."""
    text: str


class TeamNames(NamedTuple):
    """By what a signal may mean a team."""

    cyan: str
    magenta: str
    team_a: str | None = None
    """The address that team A, cyan, has in the log, as the user knows it; any other is then team B's."""

    def side(self, target: str) -> Side | None:
        """The team that is meant, as far as that can be known."""
        word = target.strip().lower()
        if self.team_a is not None:
            return Side.CYAN if word == self.team_a.strip().lower() else Side.MAGENTA
        by_name = {self.cyan.lower(): Side.CYAN, self.magenta.lower(): Side.MAGENTA}
        if not self.cyan or not self.magenta or len(by_name) < 2:
            by_name = {}  # a team against itself
        return {**{side.value: side for side in Side}, **_LETTERS, **by_name}.get(word)


def read_events(text: str, names: TeamNames, findings: Findings) -> list[SignalLine]:
    """All signals of the file by time; lines that are none are counted."""
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
        findings.note("line that is no signal", lost=True)
        return None
    epoch_ms, clock, part, rest = found.groups()
    signal, side, says = _parse_2020(rest, names, findings) if rest.lstrip().startswith("{") else _parse_2016(rest)
    if signal is None:
        findings.note("signal that is not known", lost=True)
        return None
    if signal.sided and side is None:
        findings.note("signal for a team that is not known: its name in the log can be given with --team-a", lost=True)
    return SignalLine(float(epoch_ms), signal, side, _clock(clock), _half(part), says)


def _parse_2016(rest: str) -> tuple[Signal | None, Side | None, str]:
    """A character; the description tells the side as well, and is right where they differ."""
    character, _, says = rest.partition(",")
    signal, side = BY_CHARACTER.get(character.strip(), (None, None))
    if signal is None:
        return None, None, ""
    colour = says.strip().split(" ")[0].upper()
    return signal, _COLOURS.get(colour, side) if signal.sided else None, says.strip() or signal.description


def _parse_2020(rest: str, names: TeamNames, findings: Findings) -> tuple[Signal | None, Side | None, str]:
    """JSON: command and targetTeam."""
    try:
        fields, end = json.JSONDecoder().raw_decode(rest.lstrip())
    except (ValueError, RecursionError):
        findings.note("signal that is no JSON", lost=True)
        return None, None, ""
    signal = BY_NAME.get(str(fields.get("command", "")).strip().upper())
    if signal is None:
        return None, None, ""
    side = names.side(str(fields.get("targetTeam") or "")) if signal.sided else None
    says = rest.lstrip()[end:].lstrip(", ").strip()
    robot = fields.get("robotID")
    meant = f" {side.value}" if side is not None else ""
    number = f", robot {robot}" if isinstance(robot, int) and robot >= 0 else ""
    return signal, side, (says if says and says != "null" else f"{signal.description}{meant}") + number


def _clock(text: str) -> float | None:
    found = _CLOCK.match(text)
    return 60.0 * int(found[1]) + int(found[2]) if found is not None else None


def _half(part: str) -> int:
    fields = part.lower()
    number = 1 if "1st half" in fields else 2 if "2nd half" in fields else 0
    return number + 2 if number and "overtime" in fields else number
