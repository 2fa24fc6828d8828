"""Who is there: agents, recorders and referee boxes by their liveliness tokens; recorders tell how far they are."""

from schemas.bus.contract import Bus, Presence
from schemas.game import REFBOX
from schemas.message import BadMessageError
from schemas.topics import RECORDER_PROGRESS
from sim_host.server.agent_stats import AgentStats

MAX_RECORDER_LAG = 250
"""Ticks; a lockstep host runs this far ahead of a recorder at most, well within what its writers keep for recovery."""

_MAX_NAMES = 100
"""Agents that are remembered by name; a flood of invented names must not fill the memory."""


class PresenceTracker:
    """Presence of agents, recorders and referee boxes."""

    def __init__(self, bus: Bus, agent_stats: dict[str, AgentStats], patience: float) -> None:
        """`patience` is how long a recorder whose link broke is expected back, in s of wall time."""
        self._clock = bus.clock
        self._patience = patience
        self._watch = bus.watch_alive()
        self._progress = bus.subscribe(RECORDER_PROGRESS)
        self._agent_stats = agent_stats
        self._agents: dict[str, bool] = {}
        """Everyone who came as an agent, also for a robot that does not play yet: whether it is there."""
        self._refboxes: dict[str, bool] = {}
        """Everyone who came to speak for a league's referee box: whether it is there."""
        self.recorders: dict[str, int] = {}
        """Recorder → the newest tick it has taken in; one whose link broke is in here until it is given up."""
        self._watchers: dict[str, bool] = {}
        """Everyone who came to watch, by page or terminal: whether it is there."""
        self._lost: dict[str, float] = {}
        """Recorder → when it is given up, wall time."""

    def update(self, timeout: float = 0.0) -> list[Presence]:
        """Take in what has changed, waiting up to `timeout` s for it; returns the agents that came or went."""
        changed = []
        presence = self._watch.receive(timeout)
        while presence is not None:
            if presence.kind == "agent" and (presence.name in self._agents or len(self._agents) < _MAX_NAMES):
                self._agents[presence.name] = presence.alive
            if presence.kind == "agent" and presence.name in self._agent_stats:
                self._agent_stats[presence.name].alive = presence.alive
                self._agent_stats[presence.name].silent = 0
                changed.append(presence)
            elif presence.kind == "recorder":
                self._recorder(presence)
            elif presence.kind == REFBOX and (presence.name in self._refboxes or len(self._refboxes) < _MAX_NAMES):
                self._refboxes[presence.name] = presence.alive
            elif presence.kind == "coach" and (presence.name in self._watchers or len(self._watchers) < _MAX_NAMES):
                self._watchers[presence.name] = presence.alive
            presence = self._watch.receive(0.0)
        self.receive_progress(0.0)
        self._drop_lost_recorders()
        return changed

    def refresh_agents(self) -> None:
        """Other robots take part: some of their agents may have come before them."""
        for name, stats in self._agent_stats.items():
            stats.alive = self._agents.get(name, stats.alive)

    def receive_progress(self, timeout: float) -> None:
        """Take in how far the recorders are, waiting up to `timeout` s for word of it."""
        received = self._progress.receive(timeout)
        while received is not None:
            name = received.chunks["name"]
            try:
                progress = received.message()
            except BadMessageError:
                progress = None
            if progress is not None and progress.leaving:
                self._forget(name)
            elif progress is not None and name in self.recorders:
                self.recorders[name] = max(self.recorders[name], progress.tick)
            received = self._progress.receive(0.0)

    def _recorder(self, presence: Presence) -> None:
        """A recorder that is frozen loses its link, and comes back: it is waited for like one that is there."""
        name = presence.name
        if presence.alive:
            self.recorders.setdefault(name, -1)
            self._lost.pop(name, None)
        elif name in self.recorders:
            self._lost[name] = self._clock.now() + self._patience

    def _drop_lost_recorders(self) -> None:
        if self._lost:
            now = self._clock.now()
            for name in [name for name, until in self._lost.items() if now >= until]:
                self._forget(name)

    def _forget(self, name: str) -> None:
        self.recorders.pop(name, None)
        self._lost.pop(name, None)

    def has_referee_box(self) -> bool:
        """Whether a league's referee box is connected: nobody else officiates meanwhile."""
        return any(self._refboxes.values())

    def has_watchers(self) -> bool:
        """Whether a page or a terminal shows the match."""
        return any(self._watchers.values())

    def all_present(self, wait_for_recorder: bool) -> bool:
        """Every robot's agent is there, and a recorder where one is waited for."""
        agents = all(stats.alive or stats.idle for stats in self._agent_stats.values())
        return agents and (bool(self.recorders) or not wait_for_recorder)

    def recorder_lags(self, tick: int) -> dict[str, int]:
        """How many ticks each recorder is behind."""
        return {name: max(0, tick - newest) for name, newest in self.recorders.items()}
