"""Files of other writers on a network of Zenoh that is none of a match."""

import json
import re
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from pathlib import Path
from time import monotonic

import numpy as np
import pytest
import zenoh
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from mcap.writer import IndexType
from mcap_protobuf.writer import Writer as ProtobufWriter
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from typer.testing import CliRunner, Result

from recordings.container.key_selection import EVERYTHING
from recordings.reading.log_order import open_log
from recordings.recorder.key_recorder import KeyRecorder
from recordings.replay.log_replay import Keys, LogReplay
from recordings.replay.replay import ReplaySettings
from runtime.access.accounts import Account
from runtime.access.credentials import account_file, new_credentials, write_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import BusError, NoReplyError
from runtime.bus.zenoh.any_keys import KeySubscription, open_network
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.clock import WallClock
from schemas.messages.replay import ReplayOperation, ReplayRequest
from schemas.topics import REPLAY_CONTROL
from support.foreign import LIMIT, START_NS, Network, drive, write_mcap
from touchline.commands.cli.command_line import app

UNINDEXED = {"chunks": {"use_chunking": False}, "indexes": {"index_types": IndexType.NONE}}


@pytest.fixture
def network() -> Iterator[Network]:
    network = Network()
    yield network
    network.close()


def replay(network: Network, *words: str | Path) -> Result:
    return CliRunner().invoke(
        app, ["replay", *map(str, words), "--connect", network.endpoint], prog_name="touchline", catch_exceptions=False
    )


def test_a_json_file_of_another_writer_is_replayed_on_keys_named_like_its_topics(tmp_path, network):
    file = write_mcap(tmp_path / "log.mcap", drive(50))
    result = replay(network, file, "--rate", "100")
    assert result.exit_code == 0, result.output
    samples = network.received(50)
    assert {str(one.key_expr) for one in samples} == {"robot1/odom"}
    assert [one.payload.to_bytes() for one in samples] == [payload for _, _, payload in drive(50)]
    assert {str(one.encoding) for one in samples} == {"application/json;any"}


def payloads(samples: list[zenoh.Sample]) -> list[tuple[str, bytes]]:
    return [(str(one.key_expr), one.payload.to_bytes()) for one in samples]


@pytest.mark.parametrize("options", UNINDEXED.values(), ids=UNINDEXED)
def test_a_file_without_chunks_or_indexes_is_replayed(tmp_path, network, options):
    file = write_mcap(tmp_path / "log.mcap", drive(50), **options)
    assert replay(network, file, "--fast", "--from", "0.1").exit_code == 0
    assert payloads(network.received(40)) == [("robot1/odom", payload) for _, _, payload in drive(50)[10:]]


def test_a_bag_folder_of_rosbags_is_replayed_with_its_types(tmp_path, network):
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        connection = bag.add_connection("/scan", "sensor_msgs/msg/LaserScan", typestore=store)
        header = store.types["std_msgs/msg/Header"](store.types["builtin_interfaces/msg/Time"](1, 2), "laser")
        ranges = np.array([1.0, 2.0], dtype=np.float32)
        scan = store.types["sensor_msgs/msg/LaserScan"](header, 0.0, 1.0, 0.5, 0.0, 0.1, 0.0, 9.0, ranges, ranges)
        for number in range(10):
            cdr = store.serialize_cdr(scan, "sensor_msgs/msg/LaserScan")
            bag.write(connection, START_NS + number * 1_000_000, cdr)
    assert replay(network, tmp_path / "bag", "--rate", "0").exit_code == 0
    samples = network.received(10)
    assert {str(one.encoding) for one in samples} == {"application/cdr;sensor_msgs/msg/LaserScan"}
    read = store.deserialize_cdr(samples[0].payload.to_bytes(), "sensor_msgs/msg/LaserScan")
    assert (read.header.frame_id, list(read.ranges)) == ("laser", [1.0, 2.0])


def test_protobuf_and_raw_payloads_keep_their_bytes_and_the_names_of_their_schemas(tmp_path, network):
    with (tmp_path / "proto.mcap").open("wb") as file, ProtobufWriter(file) as writer:
        writer.write_message(topic="/force", message=Vector3(x=1.5), log_time=START_NS, publish_time=START_NS)
    raw = write_mcap(
        tmp_path / "raw.mcap", [("lidar", 1, b"\xff\x00")], encoding="vendor", schema=("Packet", "vendor", b"?")
    )
    assert replay(network, tmp_path / "proto.mcap", raw, "--fast").exit_code == 0
    force, lidar = network.received(2)
    assert (str(force.encoding), Vector3.FromString(force.payload.to_bytes()).x) == (
        "application/protobuf;foxglove.Vector3",
        1.5,
    )
    assert (str(lidar.encoding), lidar.payload.to_bytes()) == ("application/octet-stream;Packet", b"\xff\x00")


def test_messages_of_several_files_come_in_the_order_of_log_time(tmp_path, network):
    """Also those that stand in a file before earlier ones, in one chunk or in several."""
    one, other = drive(40), drive(40, "robot2", 7)
    shuffled = [one[at] for at in sorted(range(40), key=lambda at: at ^ 5)]
    files = [write_mcap(tmp_path / "1.mcap", shuffled, chunk_size=120), write_mcap(tmp_path / "2.mcap", other)]
    assert replay(network, *files, "--fast").exit_code == 0
    expected = sorted([*one, *other], key=lambda message: message[1])
    assert [payload for _, payload in payloads(network.received(80))] == [payload for _, _, payload in expected]


def test_keys_are_selected_renamed_and_put_below_a_prefix(tmp_path, network):
    file = write_mcap(tmp_path / "log.mcap", [*drive(1), *drive(1, "robot10"), ("/robot1/image", 1, b"")])
    words = ["--only", "/**/odom", "--rename", "/robot1=spare/7", "--prefix", "test/"]
    assert replay(network, file, "--fast", *words).exit_code == 0
    assert sorted(key for key, _ in payloads(network.received(2))) == ["test/robot10/odom", "test/spare/7/odom"]


@pytest.mark.parametrize("start_ns", [0, 2**64 - 1 - 490_000_000])
def test_the_earliest_and_the_latest_log_times_are_played(tmp_path, network, start_ns):
    file = write_mcap(tmp_path / "log.mcap", drive(50), start_ns=start_ns)
    began = monotonic()
    result = replay(network, file, "--rate", "2", "--json")
    assert monotonic() - began >= 0.24
    assert json.loads(result.stdout) == {"time": 0.49, "start": 0.0, "end": 0.49, "messages": 50}
    assert len(network.received(50)) == 50


def test_log_times_as_far_apart_as_mcap_can_say_are_played_as_fast_as_possible(tmp_path, network):
    file = write_mcap(tmp_path / "log.mcap", [("a", 0, b"1"), ("a", 18_446_744_073_709, b"2")], start_ns=0)
    assert replay(network, file, "--fast").exit_code == 0
    assert payloads(network.received(2)) == [("a", b"1"), ("a", b"2")]


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--follow"], "--follow: .* is no recording of a match; leave --follow out"),
        (["--name", "A/b"], "a match name is a key chunk"),
        (["--from", "goal:1"], '"goal:1" is no time in a log; give seconds since its first message'),
        *((["--from", time], f'"{time}" is a time that no recording has') for time in ("inf", "nan", "-1", "1e300")),
        (["--to", "inf"], '"inf" is a time that no recording has'),
        (["--rate", "inf"], "--rate is inf; give a number"),
        (["--rate", "2", "--fast"], "--fast and --rate 2 are two speeds; give one of them"),
        (["--listen", "tcp/127.0.0.1:0"], "--listen is in place of --connect tcp"),
        (["--behind", "inf"], "--behind is inf; give a number"),
        (["--from", "9"], "--from 9 is after the last message at 0.49 s; begin earlier"),
        (["--from", "0.3", "--to", "0.2"], "--to 0.2 is before --from 0.3; end later"),
        (["--rename", "robot1"], '--rename is "robot1"; write the old and the new key: robot1/odom=robot2/odom'),
        (["--rename", "robot=spare"], "--rename: no topic has the key robot; `touchline info` lists them"),
        (["--rename", "robot1/odom=image"], "--rename: robot1/odom and image are both image; leave one out with"),
        (["--only", "arm/**"], "no message is selected; `touchline info .*` lists the keys"),
    ],
)
def test_what_cannot_be_replayed_is_refused_in_one_line(tmp_path, network, words, fault):
    file = write_mcap(tmp_path / "log.mcap", [*drive(50), ("/image", 1, b"")])
    result = replay(network, file, *words)
    assert result.exit_code == 2
    found = " ".join(result.output.split())
    assert "Traceback" not in found
    assert re.search(fault, found), found


def test_a_topic_that_cannot_be_a_key_is_named_with_the_remedy(tmp_path, network):
    file = write_mcap(tmp_path / "log.mcap", [("/a//b", 0, b"{}"), ("/c", 1, b"{}")])
    assert "leave it out with --exclude, or give --rename" in " ".join(replay(network, file).output.split())
    assert replay(network, file, "--fast", "--rename", "a//b=a/b").exit_code == 0
    assert [key for key, _ in payloads(network.received(2))] == ["a/b", "c"]


def test_the_recording_of_a_match_is_not_mixed_with_other_files(tmp_path, network, recorded):
    """Its times are simulated ones, and its keys those of a match."""
    files = [recorded.path, write_mcap(tmp_path / "other.mcap", drive(5))]
    words = [str(word) for word in ("filter", *files, "--out", tmp_path / "out.mcap")]
    for result in (replay(network, *files), CliRunner().invoke(app, words, prog_name="touchline")):
        assert result.exit_code == 2
        assert "is the recording of a match, which is read alone" in " ".join(result.output.split())


@pytest.fixture
def log_replay(tmp_path) -> Iterator[LogReplay]:
    """A paused replay of 50 messages, 10 ms apart, which begins again at its end."""
    file = write_mcap(tmp_path / "log.mcap", drive(50))
    settings = ReplaySettings(file, rate=None, paused=True, loop=True)
    with open_network("replay", WallClock(), None, "tcp/127.0.0.1:0") as bus:
        yield LogReplay(bus, open_log([file], Keys(settings).of), settings)


def test_a_replay_is_paused_stepped_sought_and_looped_by_the_control_of_replays(log_replay):
    with open_network("replay", WallClock(), log_replay._bus.endpoint, None) as bus:
        deadline, topics = monotonic() + LIMIT, []

        def ask(**request) -> tuple[float, bool, int]:
            pending = bus.query(REPLAY_CONTROL, ReplayRequest(**request), LIMIT)
            reply = None
            while reply is None and monotonic() < deadline:
                log_replay.pump()
                with suppress(NoReplyError):
                    reply = pending.result(0.01)
            assert reply.accepted, reply.reason
            topics[:] = reply.topics
            return reply.time, reply.paused, reply.messages

        assert ask() == (0.0, True, 0)
        assert topics == []
        ask(operation=ReplayOperation.EVENTS)
        (topic,) = topics
        assert (topic.key, topic.encoding, topic.schema, topic.messages) == ("robot1/odom", "json", "any", 50)
        assert (topic.start, topic.end) == (0.0, 0.49)
        ask(operation=ReplayOperation.STEP, ticks=3)
        log_replay.pump()
        assert ask() == (0.02, True, 3)
        assert ask(operation=ReplayOperation.SEEK, to="0.4") == (0.4, True, 3)
        ask(operation=ReplayOperation.PLAY)
        while log_replay.player.published < 20 and monotonic() < deadline:
            log_replay.pump()
        assert ask(operation=ReplayOperation.PAUSE)[2] >= 20  # 10 from the seek to the end, then from the beginning
        ask(operation=ReplayOperation.LEAVE)
        assert log_replay.player.ended


def test_each_account_receives_what_is_replayed_with_passwords_and_the_operator_alone_controls_it(tmp_path):
    credentials, file = new_credentials(), write_mcap(tmp_path / "log.mcap", drive(50))
    write_credentials(tmp_path, credentials)
    settings = ReplaySettings(file, rate=None, paused=True, stay=True)
    protection = Protection.of_any_keys(credentials, "replay")
    with ExitStack() as stack:
        bus = stack.enter_context(open_network("replay", WallClock(), None, "tcp/127.0.0.1:0", protection=protection))
        log_replay = LogReplay(bus, open_log([file], Keys(settings).of), settings)
        with pytest.raises(BusError):
            open_network("replay", WallClock(), bus.endpoint, None, patience=0.0)

        def join(account: Account) -> ZenohBus:
            own = account_file(tmp_path, account)
            return stack.enter_context(open_network("replay", WallClock(), bus.endpoint, None, own))

        clients = {account: join(account) for account in Account}
        subscriptions = {account: KeySubscription(client, ["**"]) for account, client in clients.items()}
        deadline = monotonic() + LIMIT
        clients[Account.VIEWER].session.put("robot1/odom", b"forged", allowed_destination=zenoh.Locality.REMOTE)

        def play(account: Account) -> bool:
            pending = clients[account].query(REPLAY_CONTROL, ReplayRequest(operation=ReplayOperation.PLAY), LIMIT)
            while monotonic() < deadline:
                log_replay.pump()
                try:
                    return pending.result(0.01).accepted
                except NoReplyError as error:
                    if "within" not in str(error):
                        return False
            return False

        assert [account for account in Account if play(account)] == [Account.OPERATOR]
        received = {account: [] for account in Account}
        while any(len(found) < 50 for found in received.values()) and monotonic() < deadline:
            log_replay.pump()
            for account, found in received.items():
                found += [sample.payload for sample in subscriptions[account].receive()]
    assert all(found == [payload for _, _, payload in drive(50)] for found in received.values())


def test_what_was_recorded_is_replayed_with_the_same_encodings_and_recorded_again(tmp_path, network):
    with open_network("keys", WallClock(), network.endpoint, None) as bus:
        recorder = KeyRecorder(bus, tmp_path / "one.mcap", ["robot1/**"], EVERYTHING)
        network.wait_for_subscriber("robot1/odom")
        for number in range(20):
            network.session.put("robot1/odom", b"%d" % number, encoding="text/plain;utf-8")
            network.session.put("robot1/raw", b"\x00%d" % number)
        deadline = monotonic() + LIMIT
        recorder.run(lambda: recorder.messages >= 40 or monotonic() > deadline)
        network.received(40)
        again = KeyRecorder(bus, tmp_path / "two.mcap", ["robot1/**"], EVERYTHING)
        network.wait_for_subscriber("robot1/odom")
        assert replay(network, tmp_path / "one.mcap", "--rate", "10").exit_code == 0
        assert {str(one.encoding) for one in network.received(40)} == {"text/plain;utf-8", "zenoh/bytes"}
        again.run(lambda: again.messages >= 40 or monotonic() > deadline)
    result = CliRunner().invoke(app, ["diff", str(tmp_path / "one.mcap"), str(tmp_path / "two.mcap")])
    assert result.output == "identical: 40 messages on 2 keys\n"
