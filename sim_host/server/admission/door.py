"""The door of this room: who may join, who is waited for, and what each account has sent and got wrong."""

from collections.abc import Iterable, Mapping

from runtime.bus.contract import Bus
from schemas.config.match_config import MatchConfig
from schemas.side import Side
from sim_host.server.admission.account_limits import ORDER_WEIGHT, OVER_LIMIT, AccountLimits
from sim_host.server.admission.admitted_recorders import AdmittedRecorders
from sim_host.server.admission.agent_stats import SILENT_TICKS, AgentStats
from sim_host.server.admission.eligibility import Eligibility
from sim_host.server.admission.invalid_log import InvalidLog
from sim_host.server.admission.presence_tracker import PresenceTracker

__all__ = ["ORDER_WEIGHT", "OVER_LIMIT", "SILENT_TICKS", "Admission", "AgentStats", "InvalidLog", "PresenceTracker"]


class Admission:
    """What the rest of the host asks before it listens to a client."""

    def __init__(
        self,
        config: MatchConfig,
        sides: Mapping[str, Side],
        launch_token: str | None = None,
        recorders: Iterable[str] = (),
        *,
        has_accounts: bool = False,
    ) -> None:
        """Arguments as of `sim_host.server.host.Host`; `sides` has each robot's side."""
        self.invalid_log = InvalidLog()
        self.accounts = AccountLimits(dict(sides), has_accounts=has_accounts)
        self.recorders = AdmittedRecorders([*config.record.admit, *recorders], any_recorder=has_accounts)
        self._eligibility = Eligibility.of(config, launch_token)
        self._patience = config.patience.recorder

    def follow(self, bus: Bus, agent_stats: dict[str, AgentStats]) -> PresenceTracker:
        """Follow who is there from now on; agents that are admitted and present are marked in `agent_stats`."""
        return PresenceTracker(
            bus, agent_stats, self._patience, self.invalid_log, self.accounts, self.recorders, self._eligibility
        )

    def add_robots(self, sides: Mapping[str, Side]) -> None:
        """Admit robots that an operator has added to the match."""
        self._eligibility.sides.update(sides)
        self.accounts.sides = {**self.accounts.sides, **sides}
