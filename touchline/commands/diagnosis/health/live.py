"""The ledger of a running match, from the newest report of its host."""

from collections.abc import Iterator

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from runtime.bus.contract import Bus
from schemas.errors import TouchlineError
from touchline.commands.diagnosis.health.ledger import Ledger, ledger_of
from touchline.timing import POLL_S


class LiveLedgers:
    """Follows the reports of a host."""

    def __init__(self, bus: Bus, patience: float) -> None:
        """`patience` is the wall time in s to wait for the host and its first report."""
        self._clock, self._patience = bus.clock, patience
        self._client, self._follower = HostClient(bus, patience), MatchFollower(bus)
        self._sides = self._client.setup().sides

    def newest(self) -> Ledger:
        """The ledger of the newest report.

        Raises:
            TouchlineError: there is none.
        """
        deadline = self._clock.now() + self._patience
        while self._clock.now() < deadline:
            self._follower.update()
            if self._follower.health is not None:
                return ledger_of(self._follower.health, self._sides)
            self._wait()
        raise TouchlineError(
            f"the host has published no report on its health for {self._patience:g} s; is it a replay?"
        )

    def all(self) -> Iterator[Ledger]:
        """A ledger for each report of the host, until it leaves."""
        yield self.newest()
        while not self._follower.gone:
            news = self._follower.update()
            if news.new_host:
                self._sides = self._client.setup().sides
            if news.healths:
                yield ledger_of(news.healths[-1], self._sides)
            self._wait()

    def _wait(self) -> None:
        self._clock.sleep_until(self._clock.now() + POLL_S)
