"""Watches the logs of a match: limits them, and finds what their processes want to be shown to the user."""

import re
from collections import Counter, defaultdict
from pathlib import Path

from coach_gateway.match.team_names import printable
from runtime.process.process_log import NOTE, message_of
from touchline.launch.processes.log_limit import LogLimit
from touchline.launch.processes.supervisor import Notice
from touchline.launch.terminal.screen import Screen

_MOST_BYTES = 1_000_000
"""Bytes of a log that one search reads; of a longer one, the newest."""


_FAULT = re.compile(r"(act (?:raised|failed|returned).*?)( at tick \d+)(.*)")
"""The line of a brain's fault. What is left without the tick is the same in all robots of a team."""


class LogWatch:
    """Shows on the screen what is to be known of processes and their logs."""

    def __init__(self, screen: Screen) -> None:
        self._screen = screen
        self._limit, self._notes = LogLimit(), LogNotes()
        self._faults: defaultdict[str, Counter[str]] = defaultdict(Counter)
        """Fault of a brain → the robots that had it, and how often."""
        self._lasting: set[str] = set()
        """Faults with which a robot has left the match."""

    def update(self, log: Path) -> None:
        """Show what was added to a log since the last call."""
        for sentence in filter(None, (self._limit.check(log), *self._notes.update(log))):
            self._screen.warn(sentence)

    def show(self, notice: Notice) -> None:
        """Show a notice with the last lines of the log; a fault of a brain as one line, and only the first time.

        One more line, for all robots, says that a robot with that fault is not started again.
        """
        for number, line in enumerate(notice.log):
            if found := _FAULT.fullmatch(line):
                fault = found[1] + found[3]
                self._faults[fault][notice.name] += 1
                is_last = notice.sentence.endswith("not started again") and fault not in self._lasting
                if is_last:
                    self._lasting.add(fault)
                if self._faults[fault].total() > 1:
                    if is_last:
                        self._screen.warn(notice.sentence)
                else:
                    where = f"; {notice.name}.log has the traceback" if number else ""
                    self._screen.warn("; ".join((f"{notice.sentence}: {line}", *notice.log[number + 1 :])) + where)
                return
        self._screen.warn(notice.sentence)
        for line in notice.log:
            self._screen.warn(f"  {notice.name}: {line}")

    def count(self) -> None:
        """Show how often each fault of a brain came again; called once, at the end of the match."""
        for fault, counts in self._faults.items():
            if counts.total() > 1:
                robots = ", ".join(f"{robot} {count}" for robot, count in sorted(counts.items()))
                self._screen.warn(f"{counts.total()} times ({robots}): {fault}")


class LogNotes:
    """Reads logs as they grow; of notes with equal subjects, such as a team's robots, the first one counts."""

    def __init__(self) -> None:
        self._read: dict[Path, int] = {}
        self._subjects: set[str] = set()

    def update(self, log: Path) -> list[str]:
        """The notes in the lines that were added to a log since the last call."""
        size = log.stat().st_size if log.exists() else 0
        start = max(self._read.get(log, 0), size - _MOST_BYTES)
        if size <= start:
            self._read[log] = size  # it may have been cut
            return []
        with log.open("rb") as file:
            file.seek(start)
            added = file.read(size - start)
        whole = added[: added.rfind(b"\n") + 1]
        self._read[log] = start + len(whole)
        if NOTE.encode() not in whole:
            return []
        return [note for line in whole.decode("utf-8", "replace").splitlines() if (note := self._note(line))]

    def _note(self, line: str) -> str:
        """The note in a line; empty if it has none, or one with a known subject."""
        message = message_of(line)
        subject, _, _ = message.removeprefix(NOTE).partition(": ")
        if not message.startswith(NOTE) or subject in self._subjects:
            return ""
        self._subjects.add(subject)
        return printable(message.removeprefix(NOTE))
