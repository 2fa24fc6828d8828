"""A live view for Foxglove and Lichtblick: the messages of a replay, and their drawing, over a WebSocket.

The only module that uses foxglove-sdk. Its server has threads of its own; their requests are queued until `update`.
"""

import json
from queue import SimpleQueue
from typing import TYPE_CHECKING

from recordings.container.encodings import zenoh_encoding
from recordings.container.json_schema import flat_schema
from recordings.container.lineup import Lineup
from recordings.container.mcap_file import ChannelRecord
from recordings.reading.log_order import LogMessage
from recordings.reading.recording import RecordedMessage
from recordings.replay.player import Player
from recordings.viz.drawing import SCHEMAS, Drawing, schema_of
from recordings.viz.foxglove import descriptors
from runtime.process.installed import need
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.messages.setup import Setup
from schemas.topics import WORLD

if TYPE_CHECKING:
    from foxglove import Channel, Schema
    from foxglove.websocket import PlaybackControlRequest, ServerListener

_LOOPBACK = "127.0.0.1"
_MAX_SPEED = 1000.0
"""Speed that is reported for `as fast as possible`, which viewers do not support."""


class LiveView:
    """A server for viewers on this machine. They may play, pause, seek and change the rate."""

    def __init__(
        self,
        name: str,
        setup: Setup | None,
        extent_ns: tuple[int, int] | None,
        port: int,
        base_ns: int | None = None,
    ) -> None:
        """`extent_ns` is the range for seeking in simulated time; None if it grows. Port 0 selects a free port.

        A file without a match has `base_ns`, the log time of its first message, from which the replay counts its times.
        Viewers have log times.

        Raises:
            TouchlineError: foxglove-sdk is not installed, or the port is in use.
        """
        need("--foxglove requires foxglove-sdk, which is not installed", "viz", "foxglove")
        import foxglove

        self._setup, self._drawing = setup, Drawing(setup) if setup is not None else None
        self._context = foxglove.Context()
        self._channels: dict[str, Channel] = {}
        self._newest: dict[str, tuple[bytes, int]] = {}
        self._described: dict[str, str] = {}
        self._base_ns = base_ns or 0
        self._shown_ns = -1
        self._announced: tuple[bool, float, bool] | None = None
        self._requests: SimpleQueue[PlaybackControlRequest] = SimpleQueue()
        self._new_subscriptions: SimpleQueue[str] = SimpleQueue()
        try:
            self._server = foxglove.start_server(
                name=name,
                host=_LOOPBACK,
                port=port,
                capabilities=[foxglove.Capability.Time],
                server_listener=_listener(self._requests, self._new_subscriptions),
                context=self._context,
                playback_time_range=extent_ns,
            )
        except RuntimeError as error:
            raise TouchlineError(
                f"--foxglove-port {port} cannot be listened on ({error}); choose another, or 0 for a free one"
            ) from None
        for topic in SCHEMAS if base_ns is None else ():
            self._open_drawing(topic)

    @property
    def address(self) -> str:
        """URL for viewers to open."""
        return f"ws://{_LOOPBACK}:{self._server.port}"

    def publish(self, recorded: RecordedMessage) -> None:
        """Send a message that the replay publishes, and its drawing."""
        if recorded.topic is WORLD:
            self._show_until(recorded.log_ns)
        if recorded.key not in self._channels:
            self._open(recorded.key, "json", self._schema_of(recorded))
        received = recorded.received()
        self._send(recorded.key, received.payload, recorded.log_ns)
        if self._drawing is not None:
            for topic, payload in self._drawing.draw(received, recorded.log_ns):
                if topic not in self._channels:
                    self._open_drawing(topic)
                self._send(topic, payload, recorded.log_ns)

    def publish_of_log(self, message: LogMessage) -> None:
        """Send a message of a file without a match, as that file describes it; a key has its first description."""
        self._show_until(message.log_ns)
        described = zenoh_encoding(message.topic)
        if self._described.setdefault(message.key, described) != described:
            return
        if message.key not in self._channels:
            self._open(message.key, message.topic.encoding, _schema_in(message.topic))
        self._send(message.key, message.payload, message.log_ns)

    def update(self, player: Player) -> None:
        """Apply the requests of viewers, send the newest messages to new ones, and broadcast the time."""
        while not self._new_subscriptions.empty():
            topic = self._new_subscriptions.get()
            self._announced = None
            if topic in self._newest:
                self._channels[topic].log(self._newest[topic][0], log_time=self._newest[topic][1])
        while not self._requests.empty():
            self._apply(self._requests.get(), player)
        self._server.broadcast_time(self._base_ns + player.position_ns)
        self._announce(player)

    def close(self) -> None:
        """End the server."""
        self._server.stop()

    def _open(self, topic: str, encoding: str, schema: "Schema | None") -> None:
        from foxglove import Channel

        self._channels[topic] = Channel(topic, message_encoding=encoding, schema=schema, context=self._context)

    def _open_drawing(self, topic: str) -> None:
        from foxglove import Schema

        message = schema_of(topic)
        self._open(topic, "protobuf", Schema(name=message, encoding="protobuf", data=descriptors(message)))

    def _schema_of(self, recorded: RecordedMessage) -> "Schema":
        from foxglove import Schema

        model = recorded.topic.message
        assert model is not None
        data = json.dumps(flat_schema(model, Lineup.of(self._setup).robots)).encode()
        return Schema(name=f"touchline.{model.__name__}", encoding="jsonschema", data=data)

    def _send(self, topic: str, payload: bytes, log_ns: int) -> None:
        self._newest[topic] = payload, self._base_ns + log_ns
        channel = self._channels[topic]
        if channel.has_sinks():
            channel.log(payload, log_time=self._base_ns + log_ns)

    def _show_until(self, ns: int) -> None:
        if ns < self._shown_ns:
            self._restart_session()
        self._shown_ns = ns

    def _restart_session(self) -> None:
        """After a seek back in time: make viewers discard their data, and start a new drawing."""
        self._newest.clear()
        self._server.clear_session()
        if self._setup is not None:
            self._drawing = Drawing(self._setup)

    def _apply(self, request: "PlaybackControlRequest", player: Player) -> None:
        from foxglove.websocket import PlaybackCommand

        if request.seek_time is not None:
            to = max(0, request.seek_time - self._base_ns) / 1e9
            player.control(ReplayRequest(operation=ReplayOperation.SEEK, to=str(to)))
        if request.playback_speed > 0.0 and request.playback_speed != _speed(player.status()):
            player.control(ReplayRequest(operation=ReplayOperation.RATE, rate=request.playback_speed))
        wants_play = request.playback_command == PlaybackCommand.Play
        if wants_play == player.paused:
            player.control(ReplayRequest(operation=ReplayOperation.PLAY if wants_play else ReplayOperation.PAUSE))
        self._announced = None
        self._announce(player, request.request_id, did_seek=request.seek_time is not None)

    def _announce(self, player: Player, request_id: str | None = None, *, did_seek: bool = False) -> None:
        """Broadcast the playback state if it has changed."""
        from foxglove.websocket import PlaybackState, PlaybackStatus

        speed = _speed(player.status())
        state = player.paused, speed, player.ended
        if state == self._announced:
            return
        self._announced = state
        status = PlaybackStatus.Playing
        if player.ended:
            status = PlaybackStatus.Ended
        elif player.paused:
            status = PlaybackStatus.Paused
        here_ns = self._base_ns + player.position_ns
        self._server.broadcast_playback_state(PlaybackState(status, here_ns, speed, did_seek, request_id))


def _schema_in(channel: ChannelRecord) -> "Schema | None":
    from foxglove import Schema

    schema = channel.schema
    return Schema(name=schema.name, encoding=schema.encoding, data=schema.data) if schema is not None else None


def _speed(status: ReplayReply) -> float:
    return _MAX_SPEED if status.rate is None else status.rate


def _listener(
    requests: "SimpleQueue[PlaybackControlRequest]", new_subscriptions: "SimpleQueue[str]"
) -> "ServerListener":
    """The listener that the threads of the server call."""
    from foxglove.websocket import ChannelView, Client, ServerListener

    class Listener(ServerListener):
        """Queues subscriptions and requests."""

        def on_subscribe(self, client: Client, channel: ChannelView) -> None:
            """A viewer subscribed to a channel."""
            del client
            new_subscriptions.put(channel.topic)

        def on_playback_control_request(self, playback_control_request: "PlaybackControlRequest") -> None:
            """A viewer requested a change of playback; the reply follows when it is done."""
            requests.put(playback_control_request)

    return Listener()
