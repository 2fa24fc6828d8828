"""A robot that is a program of lines: a sight in, a command out, one at a time.

The program has at most one sight that it has not answered, and then the newest: what it does not read in time is
never sent. After `PROGRAM_SILENT_S` without an answer it gets the newest sight, if it has read the one before.
"""

import shlex
from collections.abc import Callable, Sequence
from typing import NamedTuple

from robot_agent.loading.brain_error import RobotError
from robot_agent.process.stdio.answers import NOT_COMMANDS, AnswerFault, Expected, judge
from robot_agent.process.stdio.child import Child
from robot_agent.process.stdio.fault_counts import FaultCounts
from robot_agent.process.timing import IDLE_S, PROGRAM_S, PROGRAM_SILENT_S, REPORT_S
from robot_agent.sdk.contract import Briefing
from runtime.process.clock import Clock, WallClock
from runtime.process.process_log import Level, log_line
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.wire.message import VERSION
from schemas.wire.part import encode

_MOST_GIVEN_UP = 100
"""Newest sights without an answer that are remembered, to recognize a late answer."""


class ProgramEndedError(RobotError):
    """The program ended, or closed its output, during the match."""


class Exchange(NamedTuple):
    """What came of a sight: commands to publish."""

    others: tuple[bytes, ...] = ()
    """Late answers, and some of the lines that are no commands, which the host counts and reports."""
    answer: bytes | None = None
    """The answer that was awaited; None if it has not come."""
    tick: int | None = None
    """Tick of the sight that it answers."""


def briefing_line(briefing: Briefing) -> bytes:
    """The first line that a program receives, without its line break."""
    content = {
        "version": VERSION,
        "robot": briefing.robot,
        "side": briefing.side,
        "number": briefing.number,
        "teammates": briefing.teammates,
        "setup": briefing.setup.plain(),
    }
    return encode(content)


class StdioProgram:
    """One robot's program; a brain, too, for matches in one process."""

    def __init__(
        self,
        command: Sequence[str],
        briefing: Briefing,
        clock: Clock | None = None,
        log: Callable[[str], None] = lambda line: log_line(line, Level.WARNING),
    ) -> None:
        """Start the program and send it the briefing; `log` receives the lines about its faults."""
        self.faults = FaultCounts()
        self._name = " ".join(shlex.join(command).split())
        self._robot = briefing.robot
        self._clock = clock or WallClock()
        self._log = log
        self._child = Child(command)
        self._child.send(briefing_line(briefing))
        self._awaited: int | None = None
        self._sent_at = 0.0
        self._is_reported_silent = False
        self._given_up: list[int] = []
        self._next_report = 0.0
        self._answered: int | None = None

    def exchange(self, sight: Sight, wait: float = IDLE_S, patience: float = PROGRAM_SILENT_S) -> Exchange:
        """Give the program a sight unless it still owes an answer; wait up to `wait` s for its answer.

        After `patience` s without an answer it counts as silent. An invalid answer to the awaited sight is replaced by
        a command to rest.

        Raises:
            ProgramEndedError: it has ended.
        """
        deadline = self._clock.now() + wait
        others: list[bytes] = []
        if self._awaited is None:
            self._read(0.0, others)  # lines since the last answer
            self._give(sight)
        elif sight.tick != self._awaited and self._clock.now() - self._sent_at >= patience:
            self._report_silence(patience)
            self._give_newer(sight)
        while True:
            answer = self._read(deadline - self._clock.now(), others)
            if answer is not None:
                return Exchange(tuple(others), answer, self._answered)
            if self._child.has_ended:
                how = self._child.ending()
                raise ProgramEndedError(f"the program `{self._name}` {how} at tick {sight.tick}")
            if self._clock.now() >= deadline:
                self._report_silence(patience)
                return Exchange(tuple(others))

    def act(self, sight: Sight) -> Command:
        """The command for a sight, which is waited for.

        Raises:
            TouchlineError: the program has ended, or does not answer for `PROGRAM_S`.
        """
        deadline = self._clock.now() + PROGRAM_S
        while self._clock.now() < deadline:
            try:
                found = self.exchange(sight, patience=PROGRAM_S)
            except ProgramEndedError as error:
                raise TouchlineError(f"{self._robot}: {error}") from None
            if found.answer is not None and found.tick == sight.tick:
                return Command.decode(found.answer)
        raise TouchlineError(
            f"{self._robot}: the program `{self._name}` does not answer the sight of tick {sight.tick} "
            f"within {PROGRAM_S:g} s"
        )

    def close(self) -> None:
        """End the program, and log what it did wrong in all."""
        self._child.close()
        summary = self.faults.summary()
        if summary:
            self._log(f"{self._robot}: {summary}")
            self.faults = FaultCounts()

    def _give(self, sight: Sight) -> None:
        self._child.send(sight.encode())
        self._awaited, self._sent_at, self._is_reported_silent = sight.tick, self._clock.now(), False

    def _give_newer(self, sight: Sight) -> None:
        """Give a silent program a newer sight, if it has read the one before."""
        assert self._awaited is not None
        if self._child.has_unread_input:
            self._count(AnswerFault.UNREAD, f"has not read the sight of tick {self._awaited}; newer ones are left out")
            return
        self._given_up = [*self._given_up[1 - _MOST_GIVEN_UP :], self._awaited]
        self._give(sight)

    def _report_silence(self, patience: float) -> None:
        """Count a sight without an answer once."""
        if self._clock.now() - self._sent_at < patience or self._is_reported_silent:
            return
        self._is_reported_silent = True
        remedy = "does it write one line for each sight, and flush it?"
        self._count(
            AnswerFault.SILENT, f"has not answered the sight of tick {self._awaited} for {patience:g} s; {remedy}"
        )

    def _read(self, timeout: float, others: list[bytes]) -> bytes | None:
        """The awaited answer if it is in the next lines of the program; other lines for the host are added."""
        answer = None
        for line in self._child.receive(timeout):
            verdict = judge(line, Expected(self._awaited, self._given_up, self._answered))
            if verdict.fault is not None:
                self._count(verdict.fault, f"wrote {verdict.reason}")
            if verdict.fault in NOT_COMMANDS and self._clock.now() >= self._next_report:
                self._next_report = self._clock.now() + REPORT_S
                others.append(line.content)
            if verdict.ends_wait and self._awaited is not None:
                answer = (verdict.command or Command(answers_tick=self._awaited)).encode()
                self._answered, self._awaited = self._awaited, None
            elif verdict.command is not None:
                others.append(verdict.command.encode())
                self._given_up.remove(verdict.command.answers_tick)
        return answer

    def _count(self, kind: AnswerFault, sentence: str) -> None:
        line = self.faults.add(kind, f"{self._robot}: the program {sentence}")
        if line is not None:
            self._log(line)
