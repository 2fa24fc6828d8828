"""The live view, over a real WebSocket on loopback, with the words that Foxglove's protocol has for them."""

import importlib.util
import json
import struct
from collections.abc import Callable, Iterator
from contextlib import closing

import pytest
from foxglove_schemas_protobuf import FrameTransforms_pb2, SceneUpdate_pb2
from websockets.sync.client import ClientConnection, connect

from recordings.reading.log_order import open_log
from recordings.replay.live_view import LiveView
from recordings.replay.log_cursor import LogCursor
from recordings.replay.player import Player
from recordings.replay.replay import Replay, ReplaySettings
from recordings.viz.drawing import FIELD, SCHEMAS, TF
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayRequest
from support.foreign import START_NS, drive, write_mcap
from support.stepped_clock import SteppedClock

PATIENCE_S = 30.0
"""Wall time that the server's threads are given."""
DATA, TIME, CONTROL, STATE = 1, 2, 3, 5
"""First bytes of the protocol's binary messages: data, time, a wish, and how the playback stands."""
PLAY, PAUSE = 0, 1


class Viewer:
    """A viewer that is connected to the view of a replay, and the replay itself, moved by hand."""

    def __init__(self, socket: ClientConnection, view: LiveView, player: Player, clock: SteppedClock) -> None:
        self.socket, self.view, self.player, self.clock = socket, view, player, clock
        self.topics: dict[int, dict] = {}
        self.data: dict[str, list[tuple[int, bytes]]] = {}
        """Topic → log time and payload of what came."""
        self.sessions: list[str] = []
        self.states: list[tuple[int, int, float]] = []
        """Status, time in ns and speed, as published."""
        self.time_ns = -1

    def until(self, happened: Callable[[], object]) -> None:
        """Attend and listen until something has happened."""
        deadline = PATIENCE_S / 0.02
        while not happened():
            self.view.update(self.player)
            try:
                self.hear(self.socket.recv(timeout=0.02))
            except TimeoutError:
                deadline -= 1
            assert deadline > 0, "it did not happen"

    def hear(self, message: str | bytes) -> None:
        if isinstance(message, str):
            fields = json.loads(message)
            if fields["op"] == "serverInfo":
                self.sessions.append(fields["sessionId"])
            elif fields["op"] == "advertise":
                self.topics |= {channel["id"]: channel for channel in fields["channels"]}
        elif message[0] == DATA:
            channel, log_ns = struct.unpack_from("<IQ", message, 1)
            self.data.setdefault(self.topics[channel]["topic"], []).append((log_ns, message[13:]))
        elif message[0] == TIME:
            (self.time_ns,) = struct.unpack_from("<Q", message, 1)
        elif message[0] == STATE:
            self.states.append(struct.unpack_from("<BQf", message, 1))

    def subscribe(self) -> None:
        """To everything that is there."""
        wanted = [{"id": number, "channelId": number} for number in self.topics]
        self.socket.send(json.dumps({"op": "subscribe", "subscriptions": wanted}))

    def wish(self, command: int, speed: float = 1.0, to_s: float | None = None) -> None:
        """As the viewer's own controls do."""
        seek = (1, round(to_s * 1e9)) if to_s is not None else (0, 0)
        self.socket.send(struct.pack("<BBfBQI", CONTROL, command, speed, *seek, 4) + b"wish")

    def play(self, seconds: float) -> None:
        """Let so much simulated time go by."""
        for _ in range(round(seconds / 0.02)):
            self.clock.sleep_until(self.clock.now() + 0.02)
            while self.player.pump():
                pass


@pytest.fixture
def viewer(recorded) -> Iterator[Viewer]:
    """A viewer of a recording of four seconds, of which the first half second has been played."""
    replay, clock = Replay(ReplaySettings(recorded.path, stay=True)), SteppedClock()
    extent = replay.cursor.start_ns, replay.cursor.end_ns
    with closing(LiveView("a match", recorded.manifest.setup, extent, 0)) as view:
        player = replay.player(clock, publish=view.publish)
        with connect(view.address, subprotocols=["foxglove.sdk.v1"], close_timeout=0.5) as socket:
            viewer = Viewer(socket, view, player, clock)
            viewer.play(0.5)
            viewer.until(lambda: len(viewer.topics) >= len(SCHEMAS) + 6)
            yield viewer


def test_it_offers_every_key_and_every_topic_for_viewers_with_a_schema_that_they_read(viewer, recorded):
    offered = {channel["topic"]: channel for channel in viewer.topics.values()}
    assert {*SCHEMAS, "world", "host/applied", "robot/cyan1/command"} <= set(offered)
    assert (offered["world"]["schemaName"], offered["world"]["encoding"]) == ("touchline.World", "json")
    assert "$ref" not in offered["world"]["schema"]
    for topic, message in SCHEMAS.items():
        assert (offered[topic]["schemaName"], offered[topic]["encoding"]) == (message, "protobuf")


def test_late_viewers_receive_the_latched_messages_and_then_all_others(viewer, recorded):
    viewer.subscribe()
    viewer.until(lambda: FIELD in viewer.data and "world" in viewer.data)
    field = SceneUpdate_pb2.SceneUpdate.FromString(viewer.data[FIELD][0][1])
    assert "lines" in {entity.id for entity in field.entities}
    known = len(viewer.data["world"])
    viewer.play(0.4)
    viewer.until(lambda: len(viewer.data["world"]) == known + 20)
    payloads = {message.log_ns: message.payload for message in recorded.messages("world")}
    assert all(payloads[log_ns] == payload for log_ns, payload in viewer.data["world"])
    log_ns, transforms = viewer.data[TF][-1]
    assert {
        one.timestamp.ToNanoseconds() for one in FrameTransforms_pb2.FrameTransforms.FromString(transforms).transforms
    } == {log_ns}


def test_viewers_receive_the_time_of_the_replay(viewer):
    viewer.play(0.3)
    viewer.until(lambda: viewer.time_ns == viewer.player.position_ns)
    assert viewer.time_ns > 700_000_000


def test_viewers_pause_seek_and_change_the_rate(viewer):
    viewer.wish(PAUSE)
    viewer.until(lambda: viewer.player.paused)
    viewer.until(lambda: viewer.states and viewer.states[-1][0] == 1)
    viewer.wish(PLAY, speed=2.0, to_s=3.0)
    viewer.until(lambda: not viewer.player.paused)
    assert viewer.player.status().rate == 2.0
    assert viewer.player.position_ns == 3_000_000_000
    viewer.until(lambda: viewer.states[-1] == (0, 3_000_000_000, 2.0))


def test_after_seeking_back_viewers_begin_anew_with_the_pitch(viewer):
    viewer.subscribe()
    viewer.play(2.0)
    viewer.until(lambda: FIELD in viewer.data)
    before = len(viewer.sessions)
    viewer.data.clear()
    viewer.player.control(ReplayRequest(operation=ReplayOperation.SEEK, to="1.0"))
    viewer.play(0.1)
    viewer.until(lambda: len(viewer.sessions) > before)
    viewer.subscribe()
    viewer.until(lambda: any(1_000_000_000 <= log_ns < 1_200_000_000 for log_ns, _ in viewer.data.get(FIELD, [])))
    viewer.play(0.2)
    viewer.until(lambda: viewer.data.get(TF, [(0, b"")])[-1][0] == viewer.player.position_ns)


def test_a_file_without_a_match_is_shown_with_its_own_schemas_and_log_times(tmp_path):
    log = open_log([write_mcap(tmp_path / "log.mcap", [*drive(101), ("/map", 1000, b"{}")])])
    clock, end_ns = SteppedClock(), START_NS + 1_000_000_000
    with closing(LiveView("a log", None, (START_NS, end_ns), 0, log.base_ns)) as view:
        player = Player(LogCursor(log), clock, view.publish_of_log, stay=True, time_of=float)
        with connect(view.address, subprotocols=["foxglove.sdk.v1"], close_timeout=0.5) as socket:
            viewer = Viewer(socket, view, player, clock)
            viewer.play(0.1)
            viewer.until(lambda: viewer.topics)
            (topic,) = viewer.topics.values()
            assert (topic["topic"], topic["encoding"], topic["schemaName"]) == ("/robot1/odom", "json", "any")
            viewer.subscribe()
            viewer.until(lambda: viewer.data)
            viewer.play(0.1)
            viewer.until(lambda: viewer.time_ns == START_NS + 200_000_000)
            viewer.until(lambda: viewer.data["/robot1/odom"][-1] == (START_NS + 200_000_000, drive(21)[-1][2]))
            viewer.wish(PAUSE, to_s=end_ns / 1e9 - 0.5)
            viewer.until(lambda: viewer.player.paused and viewer.states)
            assert viewer.player.position_ns == pytest.approx(500_000_000, abs=1000)
            viewer.wish(PLAY, to_s=0.0)
            viewer.until(lambda: viewer.player.position_ns == 0 and not viewer.player.paused)


def test_a_port_in_use_is_reported_in_one_line(viewer, recorded):
    port = int(viewer.view.address.rpartition(":")[2])
    with pytest.raises(
        TouchlineError, match=rf"--foxglove-port {port} cannot be listened on .*; choose another"
    ) as told:
        LiveView("another", recorded.manifest.setup, None, port)
    assert "\n" not in str(told.value)


def test_without_its_extra_the_error_names_the_remedy(monkeypatch, recorded):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(TouchlineError, match=r"pip install 'touchline\[viz\]'"):
        LiveView("a match", recorded.manifest.setup, None, 0)


def test_a_recording_without_a_setup_is_shown_without_a_drawing(recorded):
    with closing(LiveView("bare", None, None, 0)) as view:
        view.publish(next(recorded.messages("world")))
        with connect(view.address, subprotocols=["foxglove.sdk.v1"]) as socket:
            told = [json.loads(socket.recv(timeout=PATIENCE_S)) for _ in range(2)]
    assert "playbackControl" not in told[0]["capabilities"], "nobody knows how far it goes"
    assert "world" in {channel["topic"] for channel in told[1]["channels"]}
