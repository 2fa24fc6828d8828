"""How the host waits for its robots between two ticks: not at all and on time, or for every answer."""

import math
from collections.abc import Callable
from typing import Protocol

from schemas.clock import Clock
from schemas.command import Command
from schemas.match_config import Patience
from sim_host.attendance import WINDOW, Attendance
from sim_host.inbox import SILENT_TICKS, Inbox

_RESEND_S = 0.05
"""Wall time after which an unanswered sight is sent again: a lost message is not waited for."""
_LOOK_S = 0.005
"""Wall time between two looks for robots that came or went."""

Resend = Callable[[str], None]
"""Sends the newest sight of one robot again."""


class Pace(Protocol):
    """A way of waiting."""

    late_ticks: int
    """Ticks that began later than they should have."""
    silent_ticks: int
    """A robot without an answer to this many ticks in a row is said to be silent."""

    def begin(self) -> None:
        """The first sights go out now."""

    def hurry(self) -> None:
        """Wait for nobody any more: the host is about to leave."""

    def gather(self, tick: int, resend: Resend) -> dict[str, Command]:
        """Wait as this pace does after the sights of `tick` went out; the commands to apply in the next tick."""


class Realtime:
    """Never waits for anyone: the next tick begins when its time has come, and the newest commands count."""

    def __init__(self, clock: Clock, inbox: Inbox, tick_s: float, speed: float, watchdog_s: float) -> None:
        self._clock = clock
        self._inbox = inbox
        self.silent_ticks = math.ceil(watchdog_s / tick_s)
        self._period = tick_s / speed
        self._next = 0.0
        self.late_ticks = 0

    def begin(self) -> None:
        """The first tick begins one period from now."""
        self._next = self._clock.now()

    def hurry(self) -> None:
        """Nothing to do: this pace waits for its next tick alone."""

    def gather(self, tick: int, resend: Resend) -> dict[str, Command]:
        """Sleep to the next tick, then take in what has come."""
        del resend  # a robot that missed this sight gets the next one soon enough
        self._next += self._period
        now = self._clock.now()
        if now > self._next:
            self.late_ticks += 1
            self._next = now  # the field does not hurry to make up for lost time
        self._clock.sleep_until(self._next)
        commands: dict[str, Command] = {}
        while (taken := self._inbox.take(tick, 0.0)) is not None:
            commands[taken[0]] = taken[1]
        self._inbox.end_tick(commands)
        return commands


class Lockstep:
    """Waits for every living agent's answer to each tick, and for nothing else."""

    def __init__(
        self,
        clock: Clock,
        inbox: Inbox,
        attendance: Attendance,
        patience: Patience,
        meanwhile: Callable[[], None] = lambda: None,
    ) -> None:
        """`meanwhile` is done now and then while answers are missing."""
        self._clock = clock
        self._meanwhile = meanwhile
        self._inbox = inbox
        self._attendance = attendance
        self._patience = patience.answer
        self._recorder_patience = patience.recorder
        self._stalled: dict[str, int] = {}
        self._hurried = False
        self.silent_ticks = SILENT_TICKS
        self.late_ticks = 0
        self.idle: Callable[[], None] | None = None
        """Called while answers are missing, in place of waiting: within one process the agents answer here."""

    def begin(self) -> None:
        """Nothing to do: the first tick begins with the last answer."""

    def hurry(self) -> None:
        """Take what is there from now on."""
        self._hurried = True

    def gather(self, tick: int, resend: Resend) -> dict[str, Command]:
        """Wait for all answers; a robot that gives none within the limit is silent for this tick."""
        self._wait_for_recorders(tick)
        commands: dict[str, Command] = {}
        start = self._clock.now()
        look, again = start, start + _RESEND_S
        missing = self._missing(tick)
        while missing:
            taken = self._inbox.take(tick, 0.0) or self._wait_for_answer(tick)
            if taken is not None:
                name, command = taken
                if command.answers_tick == tick:
                    commands[name] = command
                    missing.pop(name, None)
                continue
            now = self._clock.now()
            if self._hurried or now - start > self._patience:
                self.late_ticks += 1
                break
            if now >= look:
                look = now + _LOOK_S
                self._meanwhile()
                came = [presence.name for presence in self._attendance.update() if presence.alive]
                missing = self._missing(tick)
                if now >= again:
                    again = now + _RESEND_S
                    came = list(missing)
                for name in came:
                    resend(name)
        while (taken := self._inbox.take(tick, 0.0)) is not None:
            if taken[1].answers_tick == tick:
                commands[taken[0]] = taken[1]
        self._inbox.end_tick(commands)
        return commands

    def _wait_for_answer(self, tick: int) -> tuple[str, Command] | None:
        """The next answer, or nothing after a while."""
        if self.idle is not None:
            self.idle()
        return self._inbox.take(tick, 0.0 if self.idle else min(_RESEND_S, self._patience))

    def _missing(self, tick: int) -> dict[str, None]:
        """Robots whose answer is worth waiting for, in the order of the roster."""
        ledgers = self._inbox.ledgers.items()
        return {name: None for name, ledger in ledgers if ledger.newest < tick and not ledger.is_silent}

    def _wait_for_recorders(self, tick: int) -> None:
        """Let no recorder fall further behind than what can be recovered; one that stands still is left behind."""
        late: dict[str, int] = {}
        deadline = 0.0
        while True:
            self._attendance.update()
            before, late = late, self._far_behind(tick)
            now = self._clock.now()
            if not late or self._hurried:
                return
            if late != before:
                deadline = now + self._recorder_patience
            elif now > deadline:
                self._stalled.update(late)
                return
            if self.idle is not None:
                self.idle()
            else:
                self._attendance.hear_recorders(0.01)

    def _far_behind(self, tick: int) -> dict[str, int]:
        """Recorders that are too far behind, and where they are; without those that stand where they were given up."""
        return {
            name: newest
            for name, newest in self._attendance.recorders.items()
            if tick - newest > WINDOW and self._stalled.get(name) != newest
        }
