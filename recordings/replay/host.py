"""The host of a replay: publishes the messages of a recording on their keys, in order, and answers queries."""

import math
from collections.abc import Callable
from typing import Any

from recordings.reading.recording import RecordedMessage
from recordings.replay.listeners import Listeners
from recordings.replay.player import Player
from recordings.timing import LATCHED_S, REPLAY_STEP_S
from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, PresenceKind, Publisher, ReceivedMessage, Server, Stamp
from runtime.process.timing import PARTING_S, POLL_S
from schemas.messages.pace import PaceReply
from schemas.messages.parameters import ParametersReply
from schemas.messages.replay import ReplayReply, ReplayRequest
from schemas.messages.scene import SceneReply
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import ActionReply
from schemas.topic import Party, Topic
from schemas.topics import ACTION, PACE, PARAMETERS, REPLAY_CONTROL, SCENE, SETUP
from schemas.wire.message import VERSION, BadMessageError, Message

_UNCHANGEABLE = "this is a replay: what is recorded cannot be changed"

_REFUSALS: dict[Topic, Callable[[], Message]] = {
    ACTION: lambda: ActionReply(accepted=False, reason=_UNCHANGEABLE),
    PARAMETERS: lambda: ParametersReply(accepted=False, reason=_UNCHANGEABLE),
    PACE: lambda: PaceReply(accepted=False, reason="this is a replay: pause it there", tick=0, paused=False),
    SCENE: lambda: SceneReply(accepted=False, reason=_UNCHANGEABLE, episode=1),
}
"""Queries that change a match, and the refusal that a replay replies with."""


class ReplayLoop:
    """Plays to the end, and serves the controls meanwhile."""

    player: Player

    def __init__(self, bus: Bus) -> None:
        self.clock = bus.clock
        self.unknown_keys = 0
        """Messages left out because their keys match no topic."""
        self._controls = bus.serve(REPLAY_CONTROL)

    def run(self, meanwhile: Callable[[Player], Any] = lambda _: None) -> None:
        """Replay to the end. `meanwhile` is called about fifty times per second of wall time.

        Raises:
            TouchlineError: the recording is damaged inside.
        """
        while not self.player.ended:
            published = self.pump()
            meanwhile(self.player)
            if not published:
                now = self.clock.now()
                self.clock.sleep_until(now + max(REPLAY_STEP_S, min(POLL_S, self.player.wait())))

    def pump(self) -> int:
        """Answer queries and publish due messages; returns the number of messages published."""
        self._answer()
        return self.player.pump()

    def _answer(self) -> None:
        while (query := self._controls.receive()) is not None:
            try:
                request: ReplayRequest = query.message()
            except BadMessageError as error:
                query.fail(str(error))
            else:
                reply: ReplayReply = self.player.control(request)
                query.reply(reply)


class ReplayHost(ReplayLoop):
    """Takes the place of the host of a recorded match."""

    def __init__(self, bus: Bus, setup: Setup | None, make_player: Callable[..., Player]) -> None:
        """`make_player` is called with `publish` and `can_publish`; `setup` is the recorded setup, or None."""
        super().__init__(bus)
        self._bus = bus
        self._setup = setup.replace(match=bus.match, version=VERSION, claims=False) if setup is not None else None
        self._publishers: dict[str, Publisher | None] = {}
        self._setups = bus.serve(SETUP)
        self._refused: list[tuple[Server, Callable[[], Message]]] = [
            (bus.serve(topic), refusal) for topic, refusal in _REFUSALS.items()
        ]
        self._batches = BatchPublisher(bus)
        self._tick_ns = setup.time.tick * 1e9 if setup is not None else math.inf
        self._listeners = Listeners(bus, self._tick_ns)
        self.player = make_player(publish=self._publish, can_publish=self._listeners.can_publish)
        self._published_at = -math.inf
        bus.declare_alive(PresenceKind.HOST, "host")
        bus.declare_alive(PresenceKind.REPLAY, "replay")

    def run(self, meanwhile: Callable[[Player], Any] = lambda _: None) -> None:
        super().run(meanwhile)
        self.wait_for_recorders()

    def pump(self) -> int:
        """Answer queries and publish due messages; returns the number of messages published."""
        self._answer()
        has_newcomers = self._listeners.update()
        published = self.player.pump()
        self._batches.send_if_due()
        now = self.clock.now()
        stands_still = self.player.paused and self.player.published > 0
        is_due = has_newcomers or now - self._published_at > LATCHED_S
        if published:
            self._published_at = now
        elif stands_still and is_due and not self._listeners.recorders:  # which would record them twice
            self._published_at = now
            self.player.republish_latched()
        return published

    def wait_for_recorders(self) -> None:
        """Give recorders time to receive the last messages."""
        self._batches.end_tick(self._tick())
        self._batches.send()
        deadline = self.clock.now() + PARTING_S
        while self._listeners.any_behind() and self.clock.now() < deadline:
            self.clock.sleep_until(self.clock.now() + POLL_S)
            self._answer()
            self._listeners.update()

    def _publish(self, recorded: RecordedMessage) -> None:
        if recorded.log_ns != self.clock.sim_ns:
            self._batches.end_tick(self._tick())
            self.clock.sim_ns = recorded.log_ns
        try:
            publisher = self._publishers[recorded.key]
        except KeyError:
            publisher = self._publishers[recorded.key] = self._open_publisher(recorded)
        if publisher is None:
            self.unknown_keys += 1
        else:
            stamp = publisher.put_payload(recorded.payload)
            if recorded.topic.writer is not Party.HOST:
                stamp = Stamp(stamp.sequence, recorded.sent_ns, recorded.log_ns)
                self._batches.add_received(ReceivedMessage(recorded.topic, recorded.key, recorded.payload, stamp))
            self._listeners.note_published(recorded)

    def _tick(self) -> int:
        """The tick that is being published."""
        return round(max(0, self.clock.sim_ns) / self._tick_ns)

    def _open_publisher(self, recorded: RecordedMessage) -> Publisher | None:
        chunks = recorded.topic.match(recorded.key)
        if chunks is None:
            return None
        if recorded.topic.writer is Party.HOST:
            return self._batches.recorded_publisher(recorded.topic, **chunks)
        return self._bus.publisher(recorded.topic, **chunks)

    def _answer(self) -> None:
        super()._answer()
        self._batches.process()
        while (query := self._setups.receive()) is not None:
            if self._setup is not None:
                query.reply(self._setup)
            else:
                query.fail("the recording has no setup")
        for server, refusal in self._refused:
            while (query := server.receive()) is not None:
                query.reply(refusal())
