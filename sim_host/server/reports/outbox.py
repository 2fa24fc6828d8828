"""The host's publishers: one for each key; each message is encoded once."""

from typing import Any

from runtime.bus.batch_publisher import RecordedPublishers
from runtime.bus.contract import Publisher, ReceivedMessage, Stamp
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from schemas.topics import APPLIED, BELIEF, EVENT, HEALTH, INVALID, SIGHT, STATE, WORLD, WORLD_BALL, WORLD_ROBOT
from sim_host.game.judging import PlayState
from sim_host.match.simulation import TickResult
from sim_host.match.state_schedule import StateSchedule
from sim_host.snapshot import Roster

_LISTENER_CHECK_TICKS = 50
"""Ticks between two checks for subscribers to single bodies."""


class Outbox:
    """All publishers of the host."""

    def __init__(self, batches: RecordedPublishers, roster: Roster, tick_s: float) -> None:
        self.sights_recorded = False
        """Sights are recorded, too: with ten robots they are four times as many bytes as all other messages."""
        self._batches = batches
        self._world = batches.publisher(WORLD)
        self._applied = batches.publisher(APPLIED)
        self._state = batches.publisher(STATE)
        self._event = batches.publisher(EVENT)
        self.health = batches.publisher(HEALTH)
        self.invalid = batches.publisher(INVALID)
        self._ball = batches.publisher(WORLD_BALL)
        self._events: list[tuple[GameEvent, Stamp]] = []
        self._newest_state: tuple[GameState, Stamp] | None = None
        self._last_sights: dict[str, bytes] = {}
        self._listeners: list[tuple[Publisher, str | None]] = []
        self._sights: dict[str, Publisher] = {}
        self._robots: dict[str, Publisher] = {}
        self._beliefs: dict[tuple[str, Side], Publisher] = {}
        self.set_roster(roster)
        self._state_schedule = StateSchedule(tick_s)

    def set_roster(self, roster: Roster) -> None:
        """Publish for these robots from now on; an existing publisher continues its sequence numbers."""
        self._roster = roster
        for name, side in zip(roster.names, roster.sides, strict=True):
            if name not in self._sights:
                self._sights[name] = self._batches.publisher(SIGHT, robot=name)
                self._robots[name] = self._batches.publisher(WORLD_ROBOT, robot=name)
            if (name, side) not in self._beliefs:
                self._beliefs[name, side] = self._batches.publisher(BELIEF, side=side.value, robot=name)
        self._listeners = []

    def publish_sight(self, robot: str, sight: bytes) -> None:
        """Send a robot its sight."""
        self._put_sight(robot, sight)
        self._last_sights[robot] = sight

    def resend_sight(self, robot: str) -> None:
        """Send a robot its newest sight again, if it takes part and has one."""
        if robot not in self._roster.names or robot not in self._last_sights:
            return
        self._put_sight(robot, self._last_sights[robot])

    def publish_tick(self, tick: TickResult, state: PlayState) -> None:
        """Publish world, inputs, beliefs and events; the game's state on a change, after an action, and each second."""
        for event in tick.events:
            self.publish_event(event)
        episode = tick.world["episode"]
        if self._state_schedule.is_due(state, tick.tick, episode, had_actions=bool(tick.replies)):
            published = state.game_state(tick.tick, tick.time, episode)
            self._newest_state = (published, self._state.put(published))
        for side, belief in tick.beliefs:
            self._beliefs[belief.robot, side].put(belief)
        self._world.put_fields(tick.world)
        self._applied.put_payload(tick.applied_encoded)
        self._publish_bodies(tick)

    def publish_event(self, event: GameEvent) -> None:
        """Publish an event, which need not be the referee's."""
        self._events.append((event, self._event.put(event)))

    def outcome(self) -> list[ReceivedMessage]:
        """All events so far, and the newest state of the game, as they were published."""
        messages = [ReceivedMessage(EVENT, EVENT.key, event.encode(), stamp) for event, stamp in self._events]
        if self._newest_state is not None:
            state, stamp = self._newest_state
            messages.append(ReceivedMessage(STATE, STATE.key, state.encode(), stamp))
        return messages

    def _put_sight(self, robot: str, sight: bytes) -> None:
        writer = self._sights[robot]
        stamp = writer.put_payload(sight)
        if self.sights_recorded:
            self._batches.add_own(writer.key, sight, stamp)

    def _publish_bodies(self, tick: TickResult) -> None:
        """Publish single bodies on those topics that have subscribers."""
        if tick.tick % _LISTENER_CHECK_TICKS == 0:
            pairs = [(self._ball, None), *((self._robots[name], name) for name in self._roster.names)]
            self._listeners = [(writer, name) for writer, name in pairs if writer.has_subscribers()]
        for writer, name in self._listeners:
            head: dict[str, Any] = {"tick": tick.tick, "time": tick.time}
            if name is None:
                writer.put_fields({**head, "ball": tick.world["ball"]})
            else:
                side: Side = self._roster.side_of(name)
                writer.put_fields({**head, "robot": tick.world["robots"][name], "side": side})
