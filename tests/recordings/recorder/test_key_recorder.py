"""Any keys of a network of Zenoh that is none of a match, put by a session that is none of this project."""

import signal
import struct
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from time import monotonic

import pytest
import zenoh
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.typesys import Stores, get_typestore

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.editing.recovery import recover
from recordings.inspection.log_facts import log_facts, log_lines
from recordings.recorder.key_recorder import KeyRecorder, KeySummary, record_keys
from recordings.recorder.settings import RecorderSettings
from runtime.bus.contract import BusError
from runtime.bus.zenoh.any_keys import open_network
from runtime.process.clock import WallClock
from schemas.errors import TouchlineError
from support.foreign import LIMIT, Network
from support.stepped_clock import SteppedClock

Put = Callable[[zenoh.Session], None]
Record = Callable[..., KeySummary]


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    """Records what is put, until `count` messages have arrived, into log.mcap."""
    network = Network()

    def run(put: Put, count: int, keys: str = "**", selection: KeySelection = EVERYTHING) -> KeySummary:
        with open_network("keys", WallClock(), network.endpoint, None) as bus:
            recorder = KeyRecorder(bus, tmp_path / "log.mcap", keys.split(), selection)
            deadline = monotonic() + LIMIT
            network.wait_for_subscriber(keys.split()[-1].replace("**", "robot2"))  # a key of the last expression alone
            put(network.session)
            return recorder.run(lambda: recorder.messages >= count or monotonic() > deadline)

    yield run
    network.close()


def read(path: Path):
    with path.open("rb") as file:
        return list(make_reader(file, validate_crcs=True).iter_messages())


def test_keys_of_any_network_are_recorded_with_the_encodings_of_their_publishers(record, tmp_path):
    store = get_typestore(Stores.ROS2_JAZZY)
    point = store.types["geometry_msgs/msg/Point"](1.0, 2.0, 3.0)

    def put(session: zenoh.Session) -> None:
        session.put("robot1/odom", b'{"x":1}', encoding="application/json")
        cdr = bytes(store.serialize_cdr(point, "geometry_msgs/msg/Point"))
        session.put("robot1/goal", cdr, encoding="application/cdr;geometry_msgs/msg/Point")
        session.put("robot1/tf", b"\x0a\x00", encoding="application/protobuf;foxglove.FrameTransforms")
        session.put("robot1/raw", b"\x00\xff")

    assert record(put, 4).messages == 4
    found = {channel.topic: (channel.message_encoding, schema) for schema, channel, _ in read(tmp_path / "log.mcap")}
    assert {key: encoding for key, (encoding, _) in found.items()} == {
        "robot1/odom": "json",
        "robot1/goal": "cdr",
        "robot1/tf": "protobuf",
        "robot1/raw": "zenoh/bytes",
    }
    assert (found["robot1/tf"][1].name, found["robot1/tf"][1].encoding) == ("foxglove.FrameTransforms", "protobuf")
    assert found["robot1/raw"][1] is None
    with (tmp_path / "log.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        decoded = [one.decoded_message for one in reader.iter_decoded_messages(topics=["robot1/goal"])]
    assert [(one.x, one.y, one.z) for one in decoded] == [(1.0, 2.0, 3.0)]


def test_messages_that_did_not_arrive_are_counted_where_their_publisher_numbers_them(record):
    def put(session: zenoh.Session) -> None:
        publisher = session.declare_publisher("robot1/odom")
        for number in (7, 8, 20, 15, 21):
            publisher.put(b"{}", source_info=zenoh.SourceInfo(publisher.id, number))
        for number in (0, 1, 3):
            session.put("robot2/odom", b"{}", attachment=struct.pack("<QQq", number, 1_000_000 * number, 0))
        session.put("robot3/odom", b"{}")

    assert record(put, 9).losses == {"robot1/odom": 10, "robot2/odom": 1}


def test_numbers_of_a_publisher_that_begin_again_after_their_last_are_no_loss(record):
    def put(session: zenoh.Session) -> None:
        publisher = session.declare_publisher("robot1/odom")
        for number in (2**32 - 2, 2**32 - 1, 0, 1):
            publisher.put(b"{}", source_info=zenoh.SourceInfo(publisher.id, number))

    assert record(put, 4).losses == {}


def test_a_key_that_two_expressions_match_is_recorded_once_and_one_that_is_excluded_not_at_all(record, tmp_path):
    def put(session: zenoh.Session) -> None:
        for key in ("robot1/camera", "robot1/odom", "robot2/odom"):
            session.put(key, b"{}")

    assert record(put, 2, "robot1/** **/odom", KeySelection(exclude=("**/camera",))).messages == 2
    assert sorted(channel.topic for _, channel, _ in read(tmp_path / "log.mcap")) == ["robot1/odom", "robot2/odom"]


class SlowClock(SteppedClock):
    """Each message takes 1 ms to write."""

    def unix_ns(self) -> int:
        self.sleep_until(self.now() + 0.001)
        return super().unix_ns()


@pytest.mark.parametrize(("clock", "written"), [(SteppedClock(), 6500), (SlowClock(), 5000)], ids=["in time", "slow"])
def test_a_recorder_that_is_stopped_writes_what_has_arrived_and_counts_what_it_has_no_time_for(
    tmp_path, clock, written
):
    with open_network("keys", clock, None, "tcp/127.0.0.1:0") as bus:
        recorder = KeyRecorder(bus, tmp_path / "log.mcap", ["robot1/odom"], EVERYTHING)
        arrived = threading.Event()
        last = bus.session.declare_subscriber("last", lambda _: arrived.set())
        robot = Network(bus.endpoint, "client")
        robot.wait_for_subscriber("last")
        for number in range(6500):
            robot.session.put("robot1/odom", b"%d" % number, congestion_control=zenoh.CongestionControl.BLOCK)
        robot.session.put("last", b"", congestion_control=zenoh.CongestionControl.BLOCK)
        assert arrived.wait(LIMIT)
        summary = recorder.run(lambda: True)
        last.undeclare()
        robot.close()
    assert (summary.messages, summary.unwritten) == (written, 6500 - written)
    assert [int(message.data) for _, _, message in read(tmp_path / "log.mcap")] == list(range(written))
    assert (", 1500 unwritten" in summary.line()) == (written < 6500)
    facts = log_facts([tmp_path / "log.mcap"])
    assert (facts.lost, facts.unwritten) == (0, 6500 - written)
    assert (", 0 lost, 1500 unwritten at the end" in dict(log_lines(facts))["messages"]) == (written < 6500)


def test_of_a_recorder_of_keys_that_was_killed_info_says_that_its_losses_are_not_known(record, tmp_path):
    """Its counts stand at the end of a file; what repairs the file does not know them either."""
    record(lambda session: session.put("robot1/odom", b"{}" * 1000), 1)
    path = tmp_path / "log.mcap"
    assert log_facts([path]).ended is None
    content = path.read_bytes()
    path.write_bytes(content[: content.index(b"\x04\0\0\0keys")])
    for repair in (lambda: None, lambda: recover(path)):
        repair()
        facts = log_facts([path])
        assert (facts.ended, facts.messages, facts.lost) == ("cut_off", 1, None)
        lines = dict(log_lines(facts))
        assert lines["messages"] == "1"
        assert lines["ended"] == "cut_off: its recorder did not end it, and the losses are not known"


def test_what_is_no_key_expression_is_refused_in_one_line(tmp_path):
    fault = r'--keys "a//b" is no key expression .*write it as robot/\*\*'
    with open_network("keys", WallClock(), None, "tcp/127.0.0.1:0") as bus, pytest.raises(BusError, match=fault):
        KeyRecorder(bus, tmp_path / "log.mcap", ["a//b"], EVERYTHING)
    assert not (tmp_path / "log.mcap").exists()


@pytest.mark.parametrize(
    ("settings", "fault"),
    [
        ({"listen": "tcp/0.0.0.0:0"}, "is open to other machines; .* or add --insecure to admit everybody"),
        ({"listen": "tcp/127.0.0.1:0", "connect": "tcp/127.0.0.1:9"}, "--listen is in place of --connect tcp/127"),
        ({"record": {"sights": True}}, "leave --part-size, --part-duration, --sights out"),
    ],
)
def test_a_recorder_of_keys_refuses_open_listening_and_options_of_matches(tmp_path, settings, fault):
    wanted = RecorderSettings(out=tmp_path / "log.mcap", keys=["**"], patience=0.0, **settings)
    with pytest.raises(TouchlineError, match=fault):
        record_keys(wanted, lambda: True, lambda _: None)


@pytest.mark.processes
@pytest.mark.parametrize("mode", ["client", "peer"])
def test_the_command_records_those_who_connect_to_it_and_ctrl_c_leaves_a_whole_file(start, tmp_path, mode):
    recorder = start(
        "-m", "touchline", "record", "--keys", "**", "--listen", "tcp/127.0.0.1:0", "--out", str(tmp_path / "log.mcap")
    )
    endpoint = next(word for word in recorder.stderr.readline().split() if word.startswith("tcp/"))
    witness = Network(endpoint, "client")
    list(witness.session.get("nobody"))  # the reply comes after the recorder's router knows what the witness reads
    robot = Network(endpoint, mode)
    robot.wait_for_subscriber("robot1/odom")
    for _ in range(100):
        robot.session.put("robot1/odom", b"{}", congestion_control=zenoh.CongestionControl.BLOCK)
    assert len(witness.received(100)) == 100  # they have passed the recorder
    robot.close()
    witness.close()
    recorder.send_signal(signal.SIGINT)
    said, _ = recorder.communicate(timeout=LIMIT)
    assert recorder.returncode == 0
    assert "100 messages on 1 keys, 0 lost" in said
    assert len(read(tmp_path / "log.mcap")) == 100
