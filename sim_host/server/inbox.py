"""Receives, validates and counts the robots' commands; no payload can stop the host."""

from collections.abc import Container
from itertools import chain, repeat

from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, ReceivedMessage
from schemas.messages.command import Command
from schemas.topics import COMMAND
from schemas.wire.message import BadMessageError
from sim_host.server.admission.door import Admission, AgentStats
from sim_host.snapshot import Roster

_MAX_UNKNOWN_SENDERS = 100
"""Keys of unknown robots that are counted separately; a flood of invented names must not fill the memory."""
_MAX_INVALID_IN_A_ROW = 1000
"""Invalid messages read in one call before the host goes on with its work: a flood must not block it."""
_TICKS_WITH_TIMES = 500
"""Newest ticks for which the latency of an answer can be measured: ten seconds in real time."""


class Inbox:
    """Receives the commands of all robots."""

    def __init__(self, bus: Bus, roster: Roster, batches: BatchPublisher, admission: Admission) -> None:
        """All commands within the limits of their accounts are added to `batches`."""
        self._commands = bus.subscribe(COMMAND)
        self._invalid_log = admission.invalid_log
        self._batches = batches
        self._accounts = admission.accounts
        self.agent_stats: dict[str, AgentStats] = {}
        self.unknown_senders: dict[str, int] = {}
        """Key → commands received on it, for names that no robot of the match has."""
        self._sent_at: dict[int, int] = {}
        """Tick → wall time at which its sights were sent, in ns since 1970, of the newest ticks."""
        self.set_roster(roster)

    def set_roster(self, roster: Roster) -> None:
        """Receive from these robots from now on; the statistics of removed robots are kept."""
        for name, stats in self.agent_stats.items():
            stats.removed = name not in roster.names
        for name in roster.names:
            stats = self.agent_stats.setdefault(name, AgentStats())
            stats.still = name in roster.still
            stats.silent = 0

    def sights_sent(self, tick: int, unix_ns: int) -> None:
        """Note when the sights of a tick were sent, to measure the latency of the commands that answer them."""
        self._sent_at[tick] = unix_ns
        self._sent_at.pop(tick - _TICKS_WITH_TIMES, None)

    def receive_command(self, tick: int, timeout: float) -> tuple[str, Command] | None:
        """The next valid command that answers this tick, or an earlier one not answered yet; None after `timeout` s.

        All other messages are counted in the statistics of their sender and dropped.
        """
        for wait in chain((timeout,), repeat(0.0, _MAX_INVALID_IN_A_ROW)):
            received = self._commands.receive(wait)
            if received is None:
                return None
            account = self._accounts.of_key(received.key)
            if not account.accept(len(received.payload)):
                if (stats := self.agent_stats.get(received.key.split("/")[1])) is not None:
                    stats.is_over_limit = True  # the host does not wait for its robot
                continue
            self._batches.add_received(received)
            checked = self._check(received, tick)
            if checked is not None:
                return checked
            account.extra += 1
        return None

    def end_tick(self, answered: Container[str]) -> None:
        """Count a tick that ended with the commands of these robots."""
        for name, stats in self.agent_stats.items():
            stats.end_tick(name in answered)

    def _check(self, received: ReceivedMessage, tick: int) -> tuple[str, Command] | None:
        name = received.key.split("/")[1]
        stats = self.agent_stats.get(name)
        if stats is None:
            self._count_unknown_sender(received, "no robot of this match has that name")
            return None
        stats.is_over_limit = False
        if not stats.is_admitted:
            self._count_unknown_sender(received, "no agent of this match's launch has claimed that robot")
            return None
        if stats.removed:
            return None  # it answers a sight from before it was removed
        sequence = received.stamp.sequence if received.stamp is not None else -1
        if sequence >= max(0, stats.next_sequence):
            if sequence > stats.next_sequence:
                stats.add_gap(sequence, tick)
            stats.next_sequence = sequence + 1
        try:
            command = Command.decode(received.payload)
            if command.answers_tick > tick:
                raise BadMessageError(f"Command: answers_tick is {command.answers_tick}, the newest sight is {tick}")
        except BadMessageError as error:
            stats.add_invalid(str(error))
            self._invalid_log.add(received.key, str(error), received.payload)
            return None
        if not stats.add_answer(command.answers_tick, tick):
            return None
        if sequence >= 0:
            stats.next_sequence = sequence + 1  # a restarted agent counts from 0 again; a message sent twice does not
        stats.acknowledged = command.acknowledges_order
        stats.refused_order = command.refuses_order
        sent_ns = self._sent_at.get(command.answers_tick)
        if sent_ns is not None and received.arrived_ns:
            stats.add_latency((received.arrived_ns - sent_ns) * 1e-9)
        return name, command

    def _count_unknown_sender(self, received: ReceivedMessage, reason: str) -> None:
        key = (
            received.key
            if received.key in self.unknown_senders or len(self.unknown_senders) < _MAX_UNKNOWN_SENDERS
            else "others"
        )
        self.unknown_senders[key] = self.unknown_senders.get(key, 0) + 1
        self._invalid_log.add(received.key, reason, received.payload)
