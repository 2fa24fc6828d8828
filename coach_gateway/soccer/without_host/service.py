"""Publishes the game in the place of a host: replies to queries for the setup and to actions of the referee."""

import asyncio

from coach_gateway.service import pause
from coach_gateway.soccer.without_host.game import GameWithoutHost
from coach_gateway.timing import POLL_S
from runtime.bus.contract import Bus, PresenceKind
from schemas.messages.health import Health
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.soccer.game import REFBOX, ActionName
from schemas.topics import ACTION, HEALTH, SETUP, STATE
from schemas.wire.message import BadMessageError

_STATE_S = 1.0
"""s between two states in which nothing has changed: robots that hear none for longer stop."""
_BOX_DECIDES = "a league's referee box is connected and officiates; only stop is accepted"


class ServiceWithoutHost:
    """The game of robots on hardware, on a bus of their network."""

    def __init__(self, bus: Bus, setup: Setup) -> None:
        self._bus, self._setup = bus, setup
        self._game = GameWithoutHost(setup)
        self._began = bus.clock.now()
        self._due = 0.0
        self._boxes: set[str] = set()
        """Sides whose base stations are connected to a box."""
        self._states, self._healths = bus.publisher(STATE), bus.publisher(HEALTH)
        self._setups, self._actions = bus.serve(SETUP), bus.serve(ACTION)
        self._present = bus.watch_alive()
        bus.declare_alive(PresenceKind.HOST, "host")  # for which referees and viewers look

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set."""
        while not await pause(stop, POLL_S):
            self.update()

    def update(self) -> None:
        """Process what has arrived, without waiting; publishes the state where it has changed, and once a second."""
        while (presence := self._present.receive()) is not None:
            if presence.kind is PresenceKind.REFBOX:
                (self._boxes.add if presence.alive else self._boxes.discard)(presence.name)
        before = self._game.state
        self._game.advance(self._bus.clock.now() - self._began)
        self._game.state = self._game.state.replace(refbox=bool(self._boxes))
        while (query := self._setups.receive()) is not None:
            query.reply(self._setup)
        if self._game.state.phase is not before.phase or self._game.state.refbox != before.refbox:
            self._publish()
        while (query := self._actions.receive()) is not None:
            try:
                reason = self._act(query.message())
            except BadMessageError as error:
                query.fail(str(error))
                continue
            self._publish()  # before the reply
            query.reply(ActionReply(accepted=not reason, reason=reason, tick=self._game.state.tick))
        if self._game.state.time >= self._due:
            self._publish()

    def _act(self, action: RefereeAction) -> str:
        if self._boxes and action.source != REFBOX and action.action is not ActionName.STOP:
            return _BOX_DECIDES
        return self._game.act(action)

    def _publish(self) -> None:
        state = self._game.state
        self._bus.clock.sim_ns = round(state.time * 1e9)
        self._due = state.time + _STATE_S
        self._states.put(state)
        self._healths.put(Health(tick=state.tick, time=state.time, pace="no host", real_time_factor=1.0))
