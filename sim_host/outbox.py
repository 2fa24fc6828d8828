"""What the host says: one writer per key, each message encoded once."""

from dataclasses import replace
from typing import Any

from schemas.bus.contract import Publisher
from schemas.bus.minutes import MinuteKeeper
from schemas.game import GameEvent
from schemas.host import Health, Invalid
from schemas.side import Side
from schemas.topic import Delivery
from schemas.topics import APPLIED, BELIEF, EVENT, HEALTH, INVALID, SIGHT, STATE, WORLD, WORLD_BALL, WORLD_ROBOT
from sim_host.referee.state import RefereeState
from sim_host.simulation import Tick
from sim_host.snapshot import Roster

_LOOK_EVERY = 50
"""Ticks between two looks for listeners of single bodies."""
_STATE_S = 1.0
"""Simulated time after which the state of the game is said again."""


class Outbox:
    """All writers of the host."""

    def __init__(self, minutes: MinuteKeeper, roster: Roster, tick_s: float, *, sights_kept: bool = False) -> None:
        """`sights_kept`: a recorder can fetch sights again, which costs some 30 MB of memory for ten robots."""
        self._sight_topic = replace(SIGHT, delivery=Delivery.RECOVERED) if sights_kept else SIGHT
        self._minutes = minutes
        self._world = minutes.publisher(WORLD)
        self._applied = minutes.publisher(APPLIED)
        self._state = minutes.publisher(STATE)
        self._event = minutes.publisher(EVENT)
        self._health = minutes.publisher(HEALTH)
        self._invalid = minutes.publisher(INVALID)
        self._ball = minutes.publisher(WORLD_BALL)
        self._sent: dict[str, bytes] = {}
        self._wanted: list[tuple[Publisher, str | None]] = []
        self._sights: dict[str, Publisher] = {}
        self._robots: dict[str, Publisher] = {}
        self._beliefs: dict[tuple[str, Side], Publisher] = {}
        self.follow(roster)
        self._said: tuple[Any, ...] = ()
        self._state_every = round(_STATE_S / tick_s)

    def follow(self, roster: Roster) -> None:
        """Speak to and of these robots from now on; a writer that was there before counts on."""
        self._roster = roster
        for name, side in zip(roster.names, roster.sides, strict=True):
            if name not in self._sights:
                self._sights[name] = self._minutes.publisher(self._sight_topic, robot=name)
                self._robots[name] = self._minutes.publisher(WORLD_ROBOT, robot=name)
            if (name, side) not in self._beliefs:
                self._beliefs[name, side] = self._minutes.publisher(BELIEF, side=side.value, robot=name)
        self._wanted = []

    def sight(self, robot: str, sight: bytes) -> None:
        """Send a robot what it perceives."""
        self._sights[robot].put_payload(sight)
        self._sent[robot] = sight

    def sight_again(self, robot: str) -> None:
        """Send one robot that plays its newest sight once more."""
        if robot not in self._roster.names or robot not in self._sent:
            return
        self._sights[robot].put_payload(self._sent[robot])

    def truth(self, tick: Tick, state: RefereeState) -> None:
        """Send world, inputs, words, events, and the game's state when it changed, was acted on, or once a second."""
        for event in tick.events:
            self._event.put(event)
        episode = tick.world["episode"]
        news = (
            state.phase,
            state.side,
            state.running,
            state.half,
            state.score,
            state.cyan_attacks,
            state.spot,
            state.people.news,
            state.shoot_out,
            state.proposal is None,
            episode,
        )
        if news != self._said or tick.replies or tick.tick % self._state_every == 0:
            self._state.put(state.game_state(tick.tick, tick.time, episode))
            self._said = news
        for side, robot, belief in tick.beliefs:
            self._beliefs[robot, side].put_payload(belief)
        self._world.put_fields(tick.world)
        self._applied.put_payload(tick.applied_encoded)
        self._bodies(tick)

    def event(self, event: GameEvent) -> None:
        """Send an event that is not the referee's."""
        self._event.put(event)

    def health(self, health: Health) -> None:
        """Send how the host is doing."""
        self._health.put(health)

    def invalid(self, invalid: Invalid) -> None:
        """Send word of a payload that was no valid message."""
        self._invalid.put(invalid)

    def _bodies(self, tick: Tick) -> None:
        """Send single bodies to those who listen for them."""
        if tick.tick % _LOOK_EVERY == 0:
            pairs = [(self._ball, None), *((self._robots[name], name) for name in self._roster.names)]
            self._wanted = [(writer, name) for writer, name in pairs if writer.wanted()]
        for writer, name in self._wanted:
            head: dict[str, Any] = {"tick": tick.tick, "time": tick.time}
            if name is None:
                writer.put_fields({**head, "ball": tick.world["ball"]})
            else:
                side: Side = self._roster.side_of(name)
                writer.put_fields({**head, "robot": tick.world["robots"][name], "side": side})
