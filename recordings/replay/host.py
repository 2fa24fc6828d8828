"""The host of a replay: says what a recording has, on its keys and in its order, and answers who asks."""

import math
from collections.abc import Callable
from typing import Any

from recordings.reader import Recorded
from recordings.replay.listeners import Listeners
from recordings.replay.player import Player
from schemas.bus.contract import Bus, Publisher, Received, Server, Stamp
from schemas.bus.minutes import MinuteKeeper
from schemas.game import ActionReply
from schemas.host import Setup
from schemas.message import BadMessageError, Message
from schemas.parameters import ParametersReply
from schemas.replay import ReplayReply, ReplayRequest
from schemas.scene import SceneReply
from schemas.topic import Party, Topic
from schemas.topics import ACTION, PARAMETERS, REPLAY, SCENE, SETUP

_STILL_S = 1.0
"""Wall time after which a replay that stands still says again how things stand: who has come since must know."""
_NAP_S = 0.02
"""Longest wall time between two looks for questions."""
_LEAST_NAP_S = 0.001
_PARTING_S = 5.0
"""Wall time that recorders are given at the end to take in the last message."""
_UNCHANGEABLE = "this is a replay: what is recorded cannot be changed"

_REFUSALS: dict[Topic, Callable[[], Message]] = {
    ACTION: lambda: ActionReply(accepted=False, reason=_UNCHANGEABLE),
    PARAMETERS: lambda: ParametersReply(accepted=False, reason=_UNCHANGEABLE),
    SCENE: lambda: SceneReply(accepted=False, reason=_UNCHANGEABLE, episode=1),
}
"""What a live host would be asked, and what a replay answers."""


class ReplayHost:
    """Stands in for the host of a match that was recorded."""

    def __init__(self, bus: Bus, setup: Setup | None, make_player: Callable[..., Player]) -> None:
        """`make_player` is given `say` and `has_room`; `setup` is the recorded one, nothing where there is none."""
        self._bus = bus
        self._clock = bus.clock
        self._setup = setup.model_copy(update={"match": bus.match}) if setup is not None else None
        self._writers: dict[str, Publisher | None] = {}
        self._setups, self._controls = bus.serve(SETUP), bus.serve(REPLAY)
        self._refused: list[tuple[Server, Callable[[], Message]]] = [
            (bus.serve(topic), refusal) for topic, refusal in _REFUSALS.items()
        ]
        self._minutes = MinuteKeeper(bus)
        self._tick_ns = setup.time.tick * 1e9 if setup is not None else math.inf
        self._listeners = Listeners(bus, self._tick_ns)
        self.player = make_player(say=self._say, has_room=self._listeners.have_room)
        self.foreign = 0
        """Messages on keys that no topic has; left out."""
        self._told_at = -math.inf
        bus.declare_alive("host", "host")
        bus.declare_alive("replay", "replay")

    def run(self, meanwhile: Callable[[Player], Any] = lambda _: None) -> None:
        """Replay to the end; `meanwhile` is done again and again, some fifty times in a second of wall time.

        Raises:
            TouchlineError: the recording is damaged inside.
        """
        while not self.player.ended:
            said = self.pump()
            meanwhile(self.player)
            if not said:
                now = self._clock.now()
                self._clock.sleep_until(now + max(_LEAST_NAP_S, min(_NAP_S, self.player.wait())))
        self.part()

    def pump(self) -> int:
        """Answer who asks, say what is due; returns how many messages were said."""
        self._answer()
        newcomers = self._listeners.update()
        said = self.player.pump()
        self._minutes.send_if_due()
        now = self._clock.now()
        if said:
            self._told_at = now
        elif self._may_repeat() and (newcomers or now - self._told_at > _STILL_S):
            self._told_at = now
            self.player.tell_standing()
        return said

    def _may_repeat(self) -> bool:
        """A recorder would have it twice; and before the first message is played nothing stands yet."""
        return self.player.paused and self.player.said > 0 and not self._listeners.recorders

    def part(self) -> None:
        """Give the recorders time to take in the last message."""
        self._minutes.end_tick(self._tick())
        self._minutes.send()
        deadline = self._clock.now() + _PARTING_S
        while self._listeners.behind() and self._clock.now() < deadline:
            self._clock.sleep_until(self._clock.now() + _NAP_S)
            self._answer()
            self._listeners.update()

    def _say(self, recorded: Recorded) -> None:
        if recorded.log_ns != self._clock.sim_ns:
            self._minutes.end_tick(self._tick())
            self._clock.sim_ns = recorded.log_ns
        try:
            writer = self._writers[recorded.key]
        except KeyError:
            writer = self._writers[recorded.key] = self._writer(recorded)
        if writer is None:
            self.foreign += 1
        else:
            stamp = writer.put_payload(recorded.payload)
            if recorded.topic.writer is not Party.HOST:
                stamp = Stamp(stamp.sequence, recorded.sent_ns, recorded.log_ns)
                self._minutes.note(Received(recorded.topic, recorded.key, recorded.payload, stamp))
            self._listeners.said(recorded)

    def _tick(self) -> int:
        """The tick of the moment that is said."""
        return round(max(0, self._clock.sim_ns) / self._tick_ns)

    def _writer(self, recorded: Recorded) -> Publisher | None:
        chunks = recorded.topic.match(recorded.key)
        if chunks is None:
            return None
        seat = self._minutes if recorded.topic.writer is Party.HOST else self._bus
        return seat.publisher(recorded.topic, **chunks)

    def _answer(self) -> None:
        while (question := self._setups.receive()) is not None:
            if self._setup is not None:
                question.answer(self._setup)
            else:
                question.fail("the recording does not say how its match was set up")
        while (question := self._controls.receive()) is not None:
            try:
                request: ReplayRequest = question.message()
            except BadMessageError as error:
                question.fail(str(error))
            else:
                reply: ReplayReply = self.player.control(request)
                question.answer(reply)
        for server, refusal in self._refused:
            while (question := server.receive()) is not None:
                question.answer(refusal())
