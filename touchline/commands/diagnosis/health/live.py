"""The ledger of a running match, from the newest report of its host."""

from collections.abc import Iterator
from dataclasses import replace

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from runtime.bus.contract import Bus
from schemas.errors import TouchlineError
from schemas.messages.hardware import HardwareHealth
from schemas.messages.health import Health
from schemas.topics import HARDWARE
from schemas.wire.message import valid
from touchline.commands.diagnosis.health.ledger import Ledger, ledger_of
from touchline.timing import POLL_S

_NO_HOST = Health(tick=0, time=0.0, pace="no host", real_time_factor=0.0)
"""In place of the report of a host, for robots on hardware that play without one."""


class LiveLedgers:
    """Follows the reports of a host, and of robots on hardware."""

    def __init__(self, bus: Bus, patience: float) -> None:
        """`patience` is the wall time in s to wait for the host and its first report.

        Raises:
            TouchlineError: no host replies, and no robot on hardware reports.
        """
        self._clock, self._patience = bus.clock, patience
        self._client, self._follower = HostClient(bus, patience), MatchFollower(bus)
        self._reports = bus.subscribe(HARDWARE, history=True)
        self._hardware: dict[str, HardwareHealth] = {}
        self._has_host = True
        try:
            self._sides = self._client.setup().sides
        except TouchlineError:
            self._update_hardware()
            if not self._hardware:
                raise
            self._has_host, self._sides = False, {}

    def newest(self) -> Ledger:
        """The ledger of the newest report.

        Raises:
            TouchlineError: there is none.
        """
        deadline = self._clock.now() + self._patience
        while self._clock.now() < deadline:
            self._follower.update()
            if self._follower.health is not None or not self._has_host:
                self._wait()  # the reports of robots come as the host's does
                return self._ledger(self._follower.health or _NO_HOST)
            self._wait()
        raise TouchlineError(
            f"the host has published no report on its health for {self._patience:g} s; is it a replay?"
        )

    def all(self) -> Iterator[Ledger]:
        """A ledger for each report of the host, or of robots without one, until it leaves."""
        yield self.newest()
        while not self._follower.gone:
            news = self._follower.update()
            if news.new_host:
                self._sides, self._has_host = self._client.setup().sides, True
            if news.healths:
                yield self._ledger(news.healths[-1])
            elif not self._has_host and self._update_hardware():
                yield self._ledger(_NO_HOST)
            self._wait()

    def _ledger(self, health: Health) -> Ledger:
        self._update_hardware()
        return replace(ledger_of(health, self._sides), hardware=dict(self._hardware))

    def _update_hardware(self) -> bool:
        """Take over reports of robots on hardware; returns whether there were any."""
        is_new = False
        while (received := self._reports.receive()) is not None:
            report = valid(received.message)
            if report is not None and report.robot == received.chunks["robot"]:
                self._hardware[report.robot] = report
                is_new = True
        return is_new

    def _wait(self) -> None:
        self._clock.sleep_until(self._clock.now() + POLL_S)
