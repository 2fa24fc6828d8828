"""Presence of agents, recorders, watchers and referee boxes, by liveliness tokens, and the progress of recorders."""

from itertools import chain, repeat

from runtime.bus.contract import Bus, Presence, PresenceKind
from schemas.topics import RECORDER_PROGRESS
from schemas.wire.message import valid
from sim_host.server.admission.account_limits import AccountLimits
from sim_host.server.admission.admitted_recorders import AdmittedRecorders
from sim_host.server.admission.agent_stats import AgentStats
from sim_host.server.admission.claim_handler import ClaimHandler, RefusedAgent
from sim_host.server.admission.claims import Claims
from sim_host.server.admission.eligibility import Eligibility
from sim_host.server.admission.invalid_log import InvalidLog

_REMEMBERED = (PresenceKind.REFBOX, PresenceKind.COACH)
_MAX_CHANGES = 500
"""Most changes, and most reports of recorders, that are read in one call: a flood must not block the host."""
_MAX_RECORDERS = 20
"""Most recorders that are followed in addition to the admitted ones."""
_MAX_NAMES = 100
"""Most names kept for each kind of process; a flood of invented names must not fill the memory."""


class PresenceTracker:
    """Follows the presence of all processes of a match, and the progress of its recorders."""

    def __init__(
        self,
        bus: Bus,
        agent_stats: dict[str, AgentStats],
        patience: float,
        invalid_log: InvalidLog,
        accounts: AccountLimits,
        admitted: AdmittedRecorders,
        eligibility: Eligibility,
    ) -> None:
        """`patience` is the wall time in s after which a recorder with a broken link is dropped."""
        self._clock = bus.clock
        self._patience = patience
        self._watch = bus.watch_alive()
        self._progress = bus.subscribe(RECORDER_PROGRESS)
        self._agent_stats = agent_stats
        self._accounts = accounts
        self._admitted = admitted
        self.claims = Claims(eligibility)
        self.claim_handler = ClaimHandler(bus, self.claims, invalid_log)
        self._known: dict[PresenceKind, dict[str, bool]] = {kind: {} for kind in _REMEMBERED}
        """Name → whether the process is present, once it has joined."""
        self.recorders: dict[str, int] = {}
        """Recorder → the newest tick it has read; a recorder with a broken link stays until it is dropped."""
        self._gone_referees: list[str] = []
        """Names of referees whose gateway has gone since the last `pop_gone_referees`."""
        self._changes: list[Presence] = []
        self._sight_recorders: set[str] = set()
        """Recorders that request sights."""
        self._lost: dict[str, float] = {}
        """Recorder with a broken link → wall time at which it is dropped."""
        self.refresh_agents()

    def update(self, timeout: float = 0.0) -> list[Presence]:
        """Process changes, waiting up to `timeout` s for the first; returns the agents that joined or left."""
        changed: list[str] = []
        self.claim_handler.receive()
        presence = self._watch.receive(timeout)
        for _ in range(_MAX_CHANGES):
            if presence is None:
                break
            known = self._known.get(presence.kind)
            if known is not None and (presence.name in known or len(known) < _MAX_NAMES):
                known[presence.name] = presence.alive
            if presence.kind is PresenceKind.RECORDER:
                self._recorder(presence)
            elif presence.kind is PresenceKind.AGENT:
                self.claims.set_unclaimed(presence.name, presence.alive)
                changed.append(presence.name)
            elif presence.kind is PresenceKind.SESSION:
                changed += self.claims.set_session(presence.name, presence.alive)
            elif presence.kind is PresenceKind.REFEREE and not presence.alive:
                self._gone_referees.append(presence.name)
            presence = self._watch.receive(0.0)
        changed += self.claim_handler.decide()
        self.receive_progress(0.0)
        for name in [name for name, until in self._lost.items() if self._clock.now() >= until]:
            self._forget(name)
        changes = [presence for robot in changed if (presence := self._refresh(robot)) is not None]
        self._changes += changes
        return changes

    def pop_changes(self) -> list[Presence]:
        """The agents that joined or left since the last call."""
        changes, self._changes = self._changes, []
        return changes

    def refresh_agents(self) -> None:
        """Update the statistics after a change of the roster: an agent may have joined before its robot."""
        for name in self._agent_stats:
            self._refresh(name)

    def pop_refusals(self) -> list[RefusedAgent]:
        """Agents that were refused since the last call."""
        handler = self.claim_handler
        refusals, handler.refusals = handler.refusals, []
        return refusals

    def pop_gone_referees(self) -> list[str]:
        """Referees that have gone since the last call."""
        gone, self._gone_referees = self._gone_referees, []
        return gone

    def _refresh(self, robot: str) -> Presence | None:
        """Update the statistics of a robot's agent; None for a robot that does not take part."""
        stats = self._agent_stats.get(robot)
        if stats is None:
            return None
        alive = self.claims.is_present(robot)
        stats.alive, stats.silent, stats.is_admitted = alive, 0, self.claims.admits(robot)
        return Presence(PresenceKind.AGENT, robot, alive)

    def receive_progress(self, timeout: float) -> None:
        """Process the progress of recorders, waiting up to `timeout` s for the first message."""
        for wait in chain((timeout,), repeat(0.0, _MAX_CHANGES)):
            received = self._progress.receive(wait)
            if received is None:
                return
            if not self._accounts.of_key(received.key).accept(len(received.payload), 1):
                continue
            name = received.chunks["name"]
            progress = valid(received.message)
            if progress is not None and progress.leaving:
                self._forget(name)
            elif progress is not None and name in self.recorders:
                self.recorders[name] = max(self.recorders[name], progress.tick)
                if progress.sights:
                    self._sight_recorders.add(name)

    def _recorder(self, presence: Presence) -> None:
        """Add a recorder. An admitted one that loses its link may only be suspended: it stays until its patience has
        passed.
        """
        name = presence.name
        if presence.alive:
            self._admitted.join(name)
            if name in self.recorders or self._admitted.waits_for(name) or len(self.recorders) < _MAX_RECORDERS:
                self.recorders.setdefault(name, -1)
            self._lost.pop(name, None)
        elif not self._admitted.waits_for(name):
            self._forget(name)
        elif name in self.recorders:
            self._lost[name] = self._clock.now() + self._patience

    def _forget(self, name: str) -> None:
        self.recorders.pop(name, None)
        self._lost.pop(name, None)
        self._sight_recorders.discard(name)

    @property
    def wants_sights(self) -> bool:
        """Whether a recorder records sights."""
        return bool(self._sight_recorders)

    def has_referee_box(self) -> bool:
        """Whether a league's referee box is connected: other clients may then only stop the game."""
        return any(self._known[PresenceKind.REFBOX].values())

    def has_watchers(self) -> bool:
        """Whether a page or a terminal shows the match."""
        return any(self._known[PresenceKind.COACH].values())

    def all_present(self, wait_for_recorder: bool) -> bool:
        """Whether every robot has an agent, and, with `wait_for_recorder`, a recorder is present."""
        return not self.missing_agents() and (bool(self.recorders) or not wait_for_recorder)

    def missing_agents(self) -> list[str]:
        """Robots that have a body to move and no agent."""
        return [name for name, stats in self._agent_stats.items() if not (stats.alive or stats.idle)]

    def awaited_recorders(self) -> dict[str, int]:
        """Recorder → the newest tick it has read, of the recorders that a lockstep host waits for."""
        return {name: newest for name, newest in self.recorders.items() if self._admitted.waits_for(name)}

    def recorder_lags(self, tick: int) -> dict[str, int]:
        """How many ticks each recorder is behind."""
        return {name: max(0, tick - newest) for name, newest in self.recorders.items()}
