"""Supervises accounts and links while the match runs: ends their periods by wall time, and reports who is cut off."""

import logging
from collections.abc import Mapping

from schemas.bus.contract import Bus
from sim_host.server.account_limits import AccountLimits
from sim_host.server.admission import Admission
from sim_host.server.agent_stats import AgentStats
from sim_host.server.link_limits import Flood, LinkLimits

log = logging.getLogger("sim_host")

_PERIOD_S = 0.25
"""Wall time of a period."""


class AccountSupervision:
    """Supervises all accounts, and the links of their clients."""

    def __init__(
        self,
        bus: Bus,
        accounts: AccountLimits,
        links: LinkLimits,
        admission: Admission,
        agent_stats: Mapping[str, AgentStats],
    ) -> None:
        self._bus = bus
        self._accounts = accounts
        self._links = links
        self._admission = admission
        self._agent_stats = agent_stats
        self._next = bus.clock.now() + _PERIOD_S
        self._reports: list[str] = []
        bus.links.refuse_if(lambda link: links.is_refused(link, bus.clock.now()))

    def update(self) -> None:
        """End a period where it is due: count what the bus refused, and cut off links and accounts that went on."""
        now = self._bus.clock.now()
        if now < self._next:
            return
        self._next = now + _PERIOD_S
        self._accounts.add_refusals(self._bus.refusals.pop())
        for flood in self._links.end_period(self._bus.links.traffic(), self._accounts.read, now):
            if self._bus.links.close(flood.link):
                self._reports.append(_report(flood, self._accounts.over_limit))
        for account in self._accounts.end_period():
            self._reports.append(
                f"{account.name} is cut off: it went on above its limit of messages; a referee may admit it again"
            )
        for name, stats in self._agent_stats.items():
            stats.cut_off = self._accounts.is_cut_off(name)

    def pop_reports(self) -> list[str]:
        """Accounts that were cut off and what was admitted since the last call, one line each."""
        reports, self._reports = [*self._reports, *self._admission.pop_changes()], []
        for text in reports:
            log.warning(text)
        return reports


def _report(flood: Flood, accounts: list[str]) -> str:
    """The report on a link that was closed; `accounts` are above their limits at the same time."""
    above = f"; above their limits: {', '.join(accounts)}" if accounts else ""
    return (
        f"a connection from {flood.link.address} is closed: it carried {flood.rate / 1e6:.1f} MB/s, "
        f"far more than the host reads{above}"
    )
