"""A live view for Foxglove and Lichtblick: what a replay says, and what viewers draw of it, over a WebSocket.

The only door to foxglove-sdk. Its server has threads of its own; what they hear waits in queues until `attend`.
"""

import importlib.util
import json
from queue import SimpleQueue
from types import TracebackType
from typing import TYPE_CHECKING, Self

from recordings.json_schema import flat_schema
from recordings.reader import Recorded
from recordings.replay.player import Player
from recordings.viz.drawing import SCHEMAS, Drawing
from recordings.viz.foxglove import descriptors
from schemas.errors import TouchlineError
from schemas.host import Setup
from schemas.replay import ReplayDeed, ReplayReply, ReplayRequest
from schemas.topics import WORLD

if TYPE_CHECKING:
    from foxglove import Channel, Schema
    from foxglove.websocket import PlaybackControlRequest, ServerListener

DEFAULT_PORT = 8765
"""Where Foxglove and Lichtblick look unless they are told otherwise."""
_LOOPBACK = "127.0.0.1"
_FASTEST = 1000.0
"""The speed that is told for `as fast as possible`, which viewers have no word for."""


def need_foxglove() -> None:
    """Make sure that the server is there.

    Raises:
        TouchlineError: with the line that brings it.
    """
    if importlib.util.find_spec("foxglove") is None:
        raise TouchlineError("--foxglove needs foxglove-sdk, which is not installed; pip install 'touchline[viz]'")


class LiveView:
    """A server that viewers connect to, on this machine alone. They may play, pause, wind and change the rate."""

    def __init__(self, name: str, setup: Setup | None, extent_ns: tuple[int, int] | None, port: int) -> None:
        """`extent_ns` is what of simulated time can be wound to; nothing where that grows. Port 0 takes a free one.

        Raises:
            TouchlineError: the server is not installed, or the port is taken.
        """
        need_foxglove()
        import foxglove

        self._setup, self._drawing = setup, Drawing(setup) if setup is not None else None
        self._context = foxglove.Context()
        self._channels: dict[str, Channel] = {}
        self._newest: dict[str, tuple[bytes, int]] = {}
        self._world_ns = -1
        self._told: tuple[bool, float, bool] | None = None
        self._wishes: SimpleQueue[PlaybackControlRequest] = SimpleQueue()
        self._newcomers: SimpleQueue[str] = SimpleQueue()
        try:
            self._server = foxglove.start_server(
                name=name,
                host=_LOOPBACK,
                port=port,
                capabilities=[foxglove.Capability.Time],
                server_listener=_listener(self._wishes, self._newcomers),
                context=self._context,
                playback_time_range=extent_ns,
            )
        except RuntimeError as error:
            raise TouchlineError(
                f"--foxglove-port {port} cannot be listened on ({error}); choose another, or 0 for a free one"
            ) from None
        for topic, message in SCHEMAS.items():
            schema = foxglove.Schema(name=message, encoding="protobuf", data=descriptors(message))
            self._open(topic, "protobuf", schema)

    @property
    def address(self) -> str:
        """What viewers are told to open."""
        return f"ws://{_LOOPBACK}:{self._server.port}"

    def say(self, recorded: Recorded) -> None:
        """The replay says this."""
        if recorded.topic is WORLD:
            if recorded.log_ns < self._world_ns:
                self._begin_anew()
            self._world_ns = recorded.log_ns
        if recorded.key not in self._channels:
            self._open(recorded.key, "json", self._schema_of(recorded))
        self._send(recorded.key, recorded.payload, recorded.log_ns)
        if self._drawing is not None:
            for topic, payload in self._drawing.take(recorded.received(), recorded.log_ns):
                self._send(topic, payload, recorded.log_ns)

    def attend(self, player: Player) -> None:
        """Do what viewers wish, give newcomers what was said last, and tell everybody the time."""
        while not self._newcomers.empty():
            topic = self._newcomers.get()
            self._told = None
            if topic in self._newest:
                self._channels[topic].log(self._newest[topic][0], log_time=self._newest[topic][1])
        while not self._wishes.empty():
            self._fulfil(self._wishes.get(), player)
        self._server.broadcast_time(player.position_ns)
        self._tell(player)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._server.stop()

    def _open(self, topic: str, encoding: str, schema: "Schema") -> None:
        from foxglove import Channel

        self._channels[topic] = Channel(topic, message_encoding=encoding, schema=schema, context=self._context)

    def _schema_of(self, recorded: Recorded) -> "Schema":
        from foxglove import Schema

        model = recorded.topic.message
        assert model is not None
        data = json.dumps(flat_schema(model)).encode()
        return Schema(name=f"touchline.{model.__name__}", encoding="jsonschema", data=data)

    def _send(self, topic: str, payload: bytes, log_ns: int) -> None:
        self._newest[topic] = payload, log_ns
        channel = self._channels[topic]
        if channel.has_sinks():
            channel.log(payload, log_time=log_ns)

    def _begin_anew(self) -> None:
        """It was wound back: viewers forget what they have, and what is drawn is drawn from here."""
        self._newest.clear()
        self._server.clear_session()
        if self._setup is not None:
            self._drawing = Drawing(self._setup)

    def _fulfil(self, wish: "PlaybackControlRequest", player: Player) -> None:
        from foxglove.websocket import PlaybackCommand

        if wish.seek_time is not None:
            player.control(ReplayRequest(deed=ReplayDeed.SEEK, to=str(wish.seek_time / 1e9)))
        if wish.playback_speed > 0.0 and wish.playback_speed != _speed(player.status()):
            player.control(ReplayRequest(deed=ReplayDeed.RATE, rate=wish.playback_speed))
        wants_play = wish.playback_command == PlaybackCommand.Play
        if wants_play == player.paused:
            player.control(ReplayRequest(deed=ReplayDeed.PLAY if wants_play else ReplayDeed.PAUSE))
        self._told = None
        self._tell(player, wish.request_id, did_seek=wish.seek_time is not None)

    def _tell(self, player: Player, request: str | None = None, *, did_seek: bool = False) -> None:
        """How the replay stands, where that has changed."""
        from foxglove.websocket import PlaybackState, PlaybackStatus

        speed = _speed(player.status())
        stands = player.paused, speed, player.ended
        if stands == self._told:
            return
        self._told = stands
        status = PlaybackStatus.Playing
        if player.ended:
            status = PlaybackStatus.Ended
        elif player.paused:
            status = PlaybackStatus.Paused
        self._server.broadcast_playback_state(PlaybackState(status, player.position_ns, speed, did_seek, request))


def _speed(status: ReplayReply) -> float:
    return _FASTEST if status.rate is None else status.rate


def _listener(wishes: "SimpleQueue[PlaybackControlRequest]", newcomers: "SimpleQueue[str]") -> "ServerListener":
    """What the server's threads call."""
    from foxglove.websocket import ChannelView, Client, ServerListener

    class Listener(ServerListener):
        """Notes what it hears."""

        def on_subscribe(self, client: Client, channel: ChannelView) -> None:
            """A viewer wants to see this."""
            del client
            newcomers.put(channel.topic)

        def on_playback_control_request(self, playback_control_request: "PlaybackControlRequest") -> None:
            """A viewer wants something else; it is told when that is done."""
            wishes.put(playback_control_request)

    return Listener()
