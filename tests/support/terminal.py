"""A terminal whose commands join a host of the same process."""

from collections.abc import Callable, Mapping
from typing import Any

import pytest

from runtime.access.accounts import Account
from runtime.bus.contract import Bus
from runtime.process.clock import Clock
from schemas.topic import Topic
from support.fake_host import Answer, FakeHost
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


class Terminal:
    """Where commands are typed in."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.accounts: list[Account] = []
        """The accounts with which they have joined their host, in order."""
        self.hosts: list[FakeHost] = []
        self._monkeypatch = monkeypatch

    def answers(self, answers: Mapping[Topic, Answer]) -> FakeHost:
        """Let the commands join a host with these replies."""
        return self.join(FakeHost(SharedState(), answers=answers, clock=SteppedClock(), in_threads=True))

    def join(self, host: FakeHost, make_clock: Callable[[], Clock] = SteppedClock) -> FakeHost:
        """Let the commands join this host, each with a clock of its own."""

        def open_client(match: str | None, *others: Any) -> Bus:
            self.accounts.append(others[-1])
            return host.medium.open_bus(match or "friendly", make_clock())

        self._monkeypatch.setattr("runtime.bus.zenoh.bus.open_client", open_client)
        self.hosts.append(host)
        return host
