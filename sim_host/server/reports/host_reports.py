"""The host's own reports: events on agents, accounts and the referee's seat, none of which the referee decides."""

import logging
from typing import Any

from schemas.messages.soccer.game import GameEvent
from schemas.soccer.game import EventKind
from sim_host.match.simulation import Simulation, TickResult
from sim_host.server.admission.door import Admission, PresenceTracker
from sim_host.server.reports.outbox import Outbox
from sim_host.server.services.pause import Pause
from sim_host.server.services.referee_seat import RefereeSeat

log = logging.getLogger("sim_host")


class HostReports:
    """Publishes and logs what happens around a match."""

    def __init__(
        self,
        outbox: Outbox,
        simulation: Simulation,
        presence: PresenceTracker,
        seat: RefereeSeat,
        admission: Admission,
        pause: Pause,
    ) -> None:
        self._outbox = outbox
        self._simulation = simulation
        self._presence = presence
        self._seat = seat
        self._admission = admission
        self._pause = pause

    def publish(self, tick: TickResult) -> None:
        """Log agents that joined or left; publish refusals, changes of the seat, pauses, accounts over a limit."""
        self._log_agents()
        for refusal in self._presence.pop_refusals():
            log.warning(refusal.text)
            if refusal.robot in self._simulation.roster.names:
                self.publish_on_agent(tick, refusal.robot, "claim", refusal.text)
            else:
                self._publish(tick, "claim", refusal.text)
        for rule, texts in (("referee_seat", self._seat.pop_changes()), ("pace", self._pause.pop_changes())):
            for text in texts:
                log.warning(text)
                self._publish(tick, rule, text)
        names = self._admission.accounts.pop_over_limit()
        over = [f"{name} is over its limit of messages: the rest is not read" for name in names]
        for text in [*over, *self._admission.recorders.pop_changes()]:
            log.warning(text)
            self._publish(tick, "account", text)

    def publish_on_agent(self, tick: TickResult, robot: str, rule: str, text: str) -> None:
        """Publish an event on the agent of a robot, unless the robot was removed."""
        roster = self._simulation.roster
        if robot in roster.names:
            self._publish(tick, rule, text, side=roster.side_of(robot), robot=robot)

    def _log_agents(self) -> None:
        for change in self._presence.pop_changes():
            missing = self._presence.missing_agents()
            still = f"; missing: {', '.join(missing)}" if missing else ""
            joined = f"joined: {self._presence.claims.source(change.name)}" if change.alive else "left"
            log.info("%s %s%s", change.name, joined, still)

    def _publish(self, tick: TickResult, rule: str, text: str, **about: Any) -> None:
        time, clock = tick.time, self._simulation.state.clock
        event = GameEvent(tick=tick.tick, time=time, clock=clock, kind=EventKind.AGENT, rule=rule, text=text, **about)
        self._outbox.publish_event(event)
