"""Presence of agents, recorders, watchers and referee boxes, by liveliness tokens, and the progress of recorders."""

from schemas.bus.contract import Bus, Presence, PresenceKind
from schemas.topics import RECORDER_PROGRESS
from schemas.wire.message import BadMessageError
from sim_host.server.agent_stats import AgentStats

_REMEMBERED = (PresenceKind.AGENT, PresenceKind.REFBOX, PresenceKind.COACH)
_MAX_NAMES = 100
"""Most names kept for each kind of process; a flood of invented names must not fill the memory."""


class PresenceTracker:
    """Follows the presence of all processes of a match, and the progress of its recorders."""

    def __init__(self, bus: Bus, agent_stats: dict[str, AgentStats], patience: float) -> None:
        """`patience` is the wall time in s after which a recorder with a broken link is dropped."""
        self._clock = bus.clock
        self._patience = patience
        self._watch = bus.watch_alive()
        self._progress = bus.subscribe(RECORDER_PROGRESS)
        self._agent_stats = agent_stats
        self._known: dict[PresenceKind, dict[str, bool]] = {kind: {} for kind in _REMEMBERED}
        """Name → whether the process is present, once it has joined; agents may be of robots that do not play yet."""
        self.recorders: dict[str, int] = {}
        """Recorder → the newest tick it has read; a recorder with a broken link stays until it is dropped."""
        self._sight_recorders: set[str] = set()
        """Recorders that request sights."""
        self._lost: dict[str, float] = {}
        """Recorder with a broken link → wall time at which it is dropped."""

    def update(self, timeout: float = 0.0) -> list[Presence]:
        """Process changes, waiting up to `timeout` s for the first; returns the agents that joined or left."""
        changed = []
        presence = self._watch.receive(timeout)
        while presence is not None:
            self._remember(presence)
            stats = self._agent_stats.get(presence.name)
            if presence.kind is PresenceKind.RECORDER:
                self._recorder(presence)
            elif presence.kind is PresenceKind.AGENT and stats is not None:
                stats.alive, stats.silent = presence.alive, 0
                changed.append(presence)
            presence = self._watch.receive(0.0)
        self.receive_progress(0.0)
        self._drop_lost_recorders()
        return changed

    def refresh_agents(self) -> None:
        """Update the statistics after a change of the roster: an agent may have joined before its robot."""
        for name, stats in self._agent_stats.items():
            stats.alive = self._known[PresenceKind.AGENT].get(name, stats.alive)

    def receive_progress(self, timeout: float) -> None:
        """Process the progress of recorders, waiting up to `timeout` s for the first message."""
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
                if progress.sights:
                    self._sight_recorders.add(name)
            received = self._progress.receive(0.0)

    def _remember(self, presence: Presence) -> None:
        known = self._known.get(presence.kind)
        if known is not None and (presence.name in known or len(known) < _MAX_NAMES):
            known[presence.name] = presence.alive

    def _recorder(self, presence: Presence) -> None:
        """Add a recorder; one that loses its link may only be suspended, and stays until its patience has passed."""
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
        agents = all(stats.alive or stats.idle for stats in self._agent_stats.values())
        return agents and (bool(self.recorders) or not wait_for_recorder)

    def recorder_lags(self, tick: int) -> dict[str, int]:
        """How many ticks each recorder is behind."""
        return {name: max(0, tick - newest) for name, newest in self.recorders.items()}
