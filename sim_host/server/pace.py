"""The pace of a match: between two ticks the host waits for wall time, or for the command of every robot."""

import math
from collections.abc import Callable
from typing import Protocol

from runtime.process.active_clock import ActiveClock
from runtime.process.clock import Clock
from runtime.process.timing import POLL_S
from schemas.config.match_parts import Patience
from schemas.messages.command import Command
from schemas.recovery_window import RUN_AHEAD_TICKS
from sim_host.server.admission.door import SILENT_TICKS, PresenceTracker
from sim_host.server.inbox import Inbox
from sim_host.timing import PRESENCE_S, RESEND_S

Resend = Callable[[str], None]
"""Sends the newest sight of one robot again."""


class Pace(Protocol):
    """How the host waits between two ticks, and collects the commands of the robots."""

    late_ticks: int
    """Ticks that began later than planned."""
    silent_ticks: int
    """A robot without a command for this many ticks in a row is reported as silent."""

    def begin(self) -> None:
        """Note that the first sights are being sent."""

    def stop_waiting(self) -> None:
        """Stop waiting for agents: the host is about to exit."""

    def gather(self, tick: int, resend: Resend) -> dict[str, Command]:
        """Wait for commands after the sights of `tick` were sent; returns those to apply in the next tick."""


class Realtime:
    """Waits for wall time alone: each tick begins when it is due, with the newest command of each robot."""

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

    def stop_waiting(self) -> None:
        """Do nothing: this pace waits for no agent."""

    def gather(self, tick: int, resend: Resend) -> dict[str, Command]:
        """Sleep until the next tick is due, then collect the commands that have arrived."""
        del resend  # a robot that missed this sight receives the next one a period later
        self._next += self._period
        now = self._clock.now()
        if now > self._next:
            self.late_ticks += 1
            self._next = now  # later ticks do not make up for lost time
        self._clock.sleep_until(self._next)
        commands: dict[str, Command] = {}
        while (answer := self._inbox.receive_command(tick, 0.0)) is not None:
            commands[answer[0]] = answer[1]
        self._inbox.end_tick(commands)
        return commands


class Lockstep:
    """Waits for a command from every live agent in each tick, and never for wall time.

    Time in which this process had no processor does not count as patience: a busy machine delays robots as well.
    """

    def __init__(
        self,
        clock: Clock,
        inbox: Inbox,
        presence: PresenceTracker,
        patience: Patience,
        while_waiting: Callable[[], None] = lambda: None,
    ) -> None:
        """`while_waiting` is called repeatedly while the host waits for robots or recorders."""
        self._clock = clock
        self._while_waiting = while_waiting
        self._inbox = inbox
        self._presence = presence
        self._patience = patience.answer
        self._recorder_patience = patience.recorder
        self._stalled: dict[str, int] = {}
        self._stopped_waiting = False
        self.silent_ticks = SILENT_TICKS
        self.late_ticks = 0
        self.step_agents: Callable[[], None] | None = None
        """Called in place of waiting while commands are missing: agents in the same process act here."""

    def begin(self) -> None:
        """Do nothing: the first tick begins with the last command."""

    def stop_waiting(self) -> None:
        """From now on, take only commands that have already arrived."""
        self._stopped_waiting = True

    def gather(self, tick: int, resend: Resend) -> dict[str, Command]:
        """Wait for all commands; a robot that sends none within the limit misses this tick."""
        self._wait_for_recorders(tick)
        commands: dict[str, Command] = {}
        start = self._clock.now()
        waited = ActiveClock(start)
        next_check, next_resend = start, start + RESEND_S
        missing = self._missing(tick)
        while missing:
            answer = self._inbox.receive_command(tick, 0.0) or self._wait_for_answer(tick)
            if answer is not None:
                name, command = answer
                if command.answers_tick == tick:
                    commands[name] = command
                    missing.pop(name, None)
                continue
            now = self._clock.now()
            if self._stopped_waiting or waited.look(now) > self._patience:
                self.late_ticks += 1
                break
            if now >= next_check:
                next_check = now + PRESENCE_S
                self._while_waiting()
                to_resend = [change.name for change in self._presence.update() if change.alive]
                missing = self._missing(tick)
                if now >= next_resend:
                    next_resend = now + RESEND_S
                    to_resend = list(missing)
                for name in to_resend:
                    resend(name)
        while (answer := self._inbox.receive_command(tick, 0.0)) is not None:
            if answer[1].answers_tick == tick:
                commands[answer[0]] = answer[1]
        self._inbox.end_tick(commands)
        return commands

    def _wait_for_answer(self, tick: int) -> tuple[str, Command] | None:
        """The next command, or None after a short while."""
        if self.step_agents is not None:
            self.step_agents()
        return self._inbox.receive_command(tick, 0.0 if self.step_agents else min(RESEND_S, self._patience))

    def _missing(self, tick: int) -> dict[str, None]:
        """Robots whose command the host waits for, in the order of the roster."""
        agent_stats = self._inbox.agent_stats.items()
        return {name: None for name, stats in agent_stats if stats.newest < tick and not stats.is_silent}

    def _wait_for_recorders(self, tick: int) -> None:
        """Wait while a recorder lags further behind than can be recovered; one that makes no progress is given up."""
        late: dict[str, int] = {}
        deadline = 0.0
        while True:
            self._presence.update()
            before, late = late, self._far_behind(tick)
            now = self._clock.now()
            if not late or self._stopped_waiting:
                return
            if late != before:
                deadline = now + self._recorder_patience
            elif now > deadline:
                self._stalled.update(late)
                return
            self._while_waiting()
            if self.step_agents is not None:
                self.step_agents()
            else:
                self._presence.receive_progress(POLL_S)

    def _far_behind(self, tick: int) -> dict[str, int]:
        """Recorder → its newest tick, of recorders that lag too far and are not still where they were given up."""
        return {
            name: newest
            for name, newest in self._presence.awaited_recorders().items()
            if tick - newest > RUN_AHEAD_TICKS and self._stalled.get(name) != newest
        }
