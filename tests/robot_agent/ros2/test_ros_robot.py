"""A robot whose sights become messages of a graph, and whose commands come from a node in it."""

import json
import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import zenoh
from zenoh import ext

pytest.importorskip("xxhash")

from robot_agent.ros2.answers import Fault, SightHead
from robot_agent.ros2.clock_keeper import ClockKeeper
from robot_agent.ros2.robot import RosRobot, RosRunner
from runtime.process.clock import WallClock
from runtime.ros2 import topic_type as types
from runtime.ros2.graph import Graph, GraphPublisher, open_graph
from runtime.ros2.graph_names import Attachment, data_key
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.message_types import hash_of, typestore
from runtime.ros2.topic_type import TopicType
from schemas.config.sensors.range import RangeFinder, RangeReading
from schemas.messages.command import Drive, KickMode
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SIGHT
from support.in_process_bus import SharedState
from support.messages import make_setup, make_sight
from support.process_story import wait_for
from support.stepped_clock import SteppedClock

ROBOT = "cyan2"


def raw_session(endpoint: str) -> zenoh.Session:
    """A peer, as nodes of rmw_zenoh are."""
    config = zenoh.Config()
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    config.insert_json5("scouting/multicast/enabled", "false")
    return zenoh.open(config)


class Bench:
    """A match of one robot, played by this test; the bridge; and the session of a node."""

    def __init__(self, setup: Setup, robots: tuple[str, ...] = (ROBOT,)) -> None:
        medium = SharedState()
        self.clock = SteppedClock()
        host, agent = (medium.open_bus("friendly", self.clock) for _ in range(2))
        self.graph = open_graph("touchline", WallClock(), 0, "tcp/127.0.0.1:0", None, 10.0)
        self.nodes: list[Graph] = []
        self.node = self.join("team")
        self.build = MessageBuilder()
        self.keeper = keeper = ClockKeeper(self.graph, agent)
        self.robots = {name: RosRobot(self.graph, name, keeper, 1) for name in robots}
        keeper.follow([one.messages for one in self.robots.values()])
        self.runners = {name: RosRunner(agent, one.begin(setup), name) for name, one in self.robots.items()}
        self.sights = {name: host.publisher(SIGHT, robot=name) for name in robots}
        self._commands = host.subscribe(COMMAND)

    def join(self, name: str) -> Graph:
        self.nodes.append(open_graph(name, WallClock(), 0, None, self.graph.endpoint, 10.0))
        return self.nodes[-1]

    def close(self) -> None:
        for one in reversed(self.nodes):
            one.close()
        self.graph.close()

    def see(self, tick: int, robot: str = ROBOT, **more: Any) -> None:
        """The host sends a sight."""
        self.sights[robot].put(make_sight(tick, robot, **more))
        sight = self.runners[robot].next_sight(0.0)
        assert sight is not None
        self.runners[robot].answer(sight)

    def command(self) -> Any:
        """The next command that the host gets."""
        return wait_for(self._commands.receive).message()

    def no_command(self) -> bool:
        return self._commands.receive(0.0) is None

    def hear(self, topic: str, topic_type: TopicType) -> list[Any]:
        """The messages of a topic, as they come to the node."""
        heard: list[Any] = []
        store = typestore()
        self.node.subscribe(
            topic, topic_type, lambda one: heard.append(store.deserialize_cdr(one.payload, topic_type.message))
        )
        return heard

    def late_frames(self) -> list[Any]:
        """What a node gets of `/tf_static` that subscribes now, as those of rmw_zenoh do."""
        heard: list[Any] = []
        with raw_session(self.graph.endpoint) as session:
            subscriber = ext.declare_advanced_subscriber(
                session,
                data_key(0, "/tf_static", types.TF_STATIC, hash_of(types.TF_STATIC)),
                lambda sample: heard.append(sample.payload.to_bytes()),
                history=ext.HistoryConfig(detect_late_publishers=True, max_samples=1),
                recovery=ext.RecoveryConfig(heartbeat=True, periodic_queries=None),
                subscriber_detection=True,
            )
            wait_for(lambda: heard)
            subscriber.undeclare()
        return [typestore().deserialize_cdr(one, types.TF_STATIC.message) for one in heard]

    def driver(self, stamped: bool = True, node: Graph | None = None, robot: str = ROBOT) -> GraphPublisher:
        """A publisher of commands that the bridge has noticed."""
        publisher = (node or self.node).publisher(f"/{robot}/cmd_vel", types.TWIST_STAMPED if stamped else types.TWIST)
        wait_for(lambda: self.robots[robot].is_driven and publisher.is_read)
        return publisher

    def twist(self, vx: float, tick: int | None = None) -> memoryview:
        twist = self.build.twist(vx, 0.0, 0.0, 0.25)
        if tick is None:
            return self.build.encode(twist, types.TWIST)
        header = self.build.header(self.build.stamp(tick * 20_000_000), "")
        message = self.build.make(types.TWIST_STAMPED.message, header, twist)
        return self.build.encode(message, types.TWIST_STAMPED)


@pytest.fixture
def lockstep() -> Setup:
    return make_setup(pace="lockstep")


@pytest.fixture
def make_bench() -> Iterator[Callable[..., Bench]]:
    """Makes benches, which are closed after the test: a session that is open keeps the process from ending."""
    made: list[Bench] = []

    def make(*arguments: Any) -> Bench:
        made.append(Bench(*arguments))
        return made[-1]

    yield make
    for one in made:
        one.close()


@pytest.fixture
def bench(lockstep: Setup, make_bench: Callable[..., Bench]) -> Bench:
    return make_bench(lockstep)


def all_read(bench: Bench, *topics: str) -> None:
    """Wait until the bridge knows that the topics are read."""
    writers = bench.robots[ROBOT].messages.writers
    wait_for(lambda: all(writers[topic].is_read for topic in topics))


def test_a_sight_becomes_odometry_ball_obstacles_and_game_in_the_frame_of_the_robot(bench: Bench):
    odometry = bench.hear(f"/{ROBOT}/odom", types.ODOMETRY)
    ball = bench.hear(f"/{ROBOT}/ball", types.BALL)
    obstacles = bench.hear(f"/{ROBOT}/obstacles", types.OBSTACLES)
    game = bench.hear(f"/{ROBOT}/game", types.GAME)
    all_read(bench, "odom", "ball", "obstacles", "game")
    bench.see(
        100, at=(1.0, 2.0, math.pi / 2), velocity=(0.0, 1.5, 0.3), ball=(3.0, 4.0, 0.5, 0.6), obstacles=((5.0, 6.0),)
    )
    (moved,) = wait_for(lambda: odometry)
    assert (moved.header.frame_id, moved.child_frame_id) == ("cyan2/odom", "cyan2/base_link")
    assert moved.header.stamp.sec == 2
    place, turn, twist = moved.pose.pose.position, moved.pose.pose.orientation, moved.twist.twist
    assert (place.x, place.y) == (1.0, 2.0)
    assert 2 * math.atan2(turn.z, turn.w) == pytest.approx(math.pi / 2)
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == pytest.approx((1.5, 0.0, 0.3))
    (seen,) = wait_for(lambda: ball)
    assert (seen.known, seen.visible, seen.holding, seen.kicker_ready) == (True, True, False, True)
    assert (seen.position.x, seen.position.y, seen.velocity.x) == (3.0, 4.0, 0.5)
    (bodies,) = wait_for(lambda: obstacles)
    assert [(one.x, one.y, one.radius) for one in bodies.obstacles] == [(5.0, 6.0, 0.25)]
    (state,) = wait_for(lambda: game)
    assert (state.phase, state.stage, state.running) == ("play", "regular", True)
    assert math.isnan(state.spot_x)


def test_a_sight_is_read_whole_only_while_a_node_reads_it(bench: Bench):
    runner, payload = bench.runners[ROBOT], make_sight(7, ROBOT, holding=True).encode()
    assert runner.read(payload) == SightHead(tick=7, time=0.14, holding=True, kicker_ready=True)
    assert runner.read(b'{"tick": "soon"}') is None
    assert runner.read(b"[" * 100_000) is None
    assert runner.invalid == 2
    bench.hear(f"/{ROBOT}/ball", types.BALL)
    all_read(bench, "ball")
    assert runner.read(payload) == Sight.decode(payload)


def test_a_ball_that_was_never_seen_is_not_known(bench: Bench):
    ball = bench.hear(f"/{ROBOT}/ball", types.BALL)
    all_read(bench, "ball")
    bench.see(0, ball=None)
    (seen,) = wait_for(lambda: ball)
    assert (seen.known, seen.visible, seen.position.x) == (False, False, 0.0)


def test_a_range_finder_becomes_a_scan_once_for_each_reading(lockstep: Setup, make_bench: Callable[..., Bench]):
    sensor = RangeFinder(beams=3, span=1.5, max_distance=8.0, rate=25.0, x=0.1, height=0.2)
    bench = make_bench(lockstep.replace(sensors={"standard": {"laser": sensor}}))
    scans = bench.hear(f"/{ROBOT}/scan", types.SCAN)
    all_read(bench, "scan")
    reading = RangeReading(age=0.0, angle_min=-0.5, angle_increment=0.5, distances=[1.0, None, 3.0])
    bench.see(4, sensors={"laser": reading})
    old = RangeReading(age=0.02, angle_min=-0.5, angle_increment=0.5, distances=[1.0, None, 3.0])
    bench.see(5, sensors={"laser": old})
    new = RangeReading(age=0.0, angle_min=-0.5, angle_increment=0.5, distances=[2.0, None, 3.0])
    bench.see(6, sensors={"laser": new})
    wait_for(lambda: len(scans) == 2)
    first = scans[0]
    assert list(first.ranges) == [1.0, math.inf, 3.0]
    assert (first.header.frame_id, first.header.stamp.nanosec) == ("cyan2/laser", 80_000_000)
    assert (first.angle_min, first.angle_max, first.range_max, first.scan_time) == pytest.approx((-0.5, 0.5, 8.0, 0.04))
    (message,) = bench.late_frames()
    places = {one.child_frame_id: (one.header.frame_id, one.transform.translation.x) for one in message.transforms}
    assert places == {"cyan2/odom": ("map", 0.0), "cyan2/laser": ("cyan2/base_link", 0.1)}


def test_the_frames_that_do_not_move_reach_nodes_that_come_later_and_turn_with_the_side(
    make_bench: Callable[..., Bench],
):
    bench = make_bench(make_setup(pace="lockstep"), ("cyan2", "magenta1"))
    bench.see(0, "cyan2")
    (message,) = bench.late_frames()
    turned = {one.child_frame_id: one.transform.rotation.w for one in message.transforms}
    assert turned == pytest.approx({"cyan2/odom": 1.0, "magenta1/odom": 0.0})


def test_the_clock_follows_once_the_sights_of_all_robots_are_published(make_bench: Callable[..., Bench]):
    bench = make_bench(make_setup(pace="lockstep"), ("cyan1", "cyan2"))
    clock, odometry = bench.hear("/clock", types.CLOCK), bench.hear("/cyan2/odom", types.ODOMETRY)
    all_read(bench, "odom")
    wait_for(lambda: bench.keeper.clock.is_read)
    bench.see(10, "cyan2")
    wait_for(lambda: odometry)
    assert clock == []
    bench.see(10, "cyan1")
    (told,) = wait_for(lambda: clock)
    assert (told.clock.sec, told.clock.nanosec) == (0, 200_000_000)
    bench.see(11, "cyan2")
    bench.see(12, "cyan2")
    wait_for(lambda: len(clock) == 3)  # cyan1, which has left, is waited for once
    assert [one.clock.nanosec for one in clock[1:]] == [220_000_000, 240_000_000]


@pytest.mark.parametrize("stamped", [True, False])
def test_a_command_of_a_node_answers_the_sight(bench: Bench, stamped: bool):
    publisher = bench.driver(stamped)
    bench.see(5)
    assert bench.no_command()
    publisher.put(bench.twist(1.25, 5 if stamped else None))
    command = bench.command()
    assert (command.answers_tick, command.drive) == (5, Drive(vx=1.25, omega=0.25))


def test_a_sight_that_comes_again_gets_the_same_answer_again(bench: Bench):
    publisher = bench.driver()
    bench.see(5)
    publisher.put(bench.twist(1.25, 5))
    first = bench.command()
    bench.see(5)
    assert bench.command() == first


def test_a_sight_without_an_answer_is_published_again_after_a_second(bench: Bench):
    odometry = bench.hear(f"/{ROBOT}/odom", types.ODOMETRY)
    bench.driver()
    all_read(bench, "odom")
    bench.see(5)
    wait_for(lambda: odometry)
    bench.see(5)
    bench.clock.sleep_until(bench.clock.now() + 1.0)
    bench.see(5)
    wait_for(lambda: len(odometry) == 2)


def test_without_a_node_and_when_it_leaves_the_robot_brakes(bench: Bench, capfd: pytest.CaptureFixture[str]):
    bench.see(1)
    assert bench.command().drive == Drive()
    node = bench.join("short")
    bench.driver(node=node)
    bench.see(2)
    node.close()
    command = bench.command()
    assert (command.answers_tick, command.drive) == (2, Drive())
    assert "cyan2: no node drives it any more (left; further ones are counted in" in capfd.readouterr().err


def test_two_nodes_are_named_and_the_robot_brakes(bench: Bench, capfd: pytest.CaptureFixture[str]):
    first, other = bench.driver(), bench.join("second")
    second = bench.driver(node=other)
    bench.see(1)
    first.put(bench.twist(1.0, 1))
    assert bench.command().drive.vx == 1.0
    bench.see(2)
    second.put(bench.twist(1.0, 2))
    assert bench.command().drive == Drive()
    assert "cyan2: /second drives it, and another node does" in capfd.readouterr().err
    other.close()


def test_a_message_of_another_form_is_named_and_the_robot_brakes(bench: Bench, capfd: pytest.CaptureFixture[str]):
    publisher = bench.driver()
    bench.see(1)
    publisher.put(b"\x00\x01\x00\x00rubbish")
    assert bench.command().drive == Drive()
    assert "cyan2: /team: no geometry_msgs/msg/TwistStamped: " in capfd.readouterr().err


def test_a_topic_of_commands_with_another_type_is_named(bench: Bench, capfd: pytest.CaptureFixture[str]):
    bench.node.publisher(f"/{ROBOT}/cmd_vel", types.TEXT)
    said: list[str] = []  # by the thread of the graph, just after it has counted the fault
    wait_for(lambda: said.append(capfd.readouterr().err) or "as std_msgs/msg/String, RIHS01_" in "".join(said))
    assert "cyan2: /team publishes /cyan2/cmd_vel as std_msgs/msg/String, RIHS01_" in "".join(said)
    assert bench.robots[ROBOT].counts[Fault.OTHER_TYPE] == 1


def test_what_was_wrong_is_counted_in_the_diagnostics(bench: Bench):
    heard = bench.hear(f"/{ROBOT}/diagnostics", types.DIAGNOSTICS)
    publisher = bench.driver()
    all_read(bench, "diagnostics")
    bench.see(1)
    publisher.put(bench.twist(math.nan, 1))
    bench.command()
    bench.see(60)
    last = wait_for(lambda: heard[1:])[-1].status[0]
    assert (last.name, last.level, last.hardware_id) == ("cyan2: commands", 1, "cyan2")
    assert {one.key: one.value for one in last.values}["invalid"] == "1"


def request(bench: Bench, mode: str, speed: float, attachment: bytes) -> list[Any]:
    """The replies to a request of a kick, each with its attachment, as a client of rmw_zenoh asks for them."""
    store, key = typestore(), data_key(0, f"/{ROBOT}/kick", types.KICK, hash_of(types.KICK))
    asked = store.types["touchline_msgs/srv/Kick_Request"](mode, speed)
    with raw_session(bench.graph.endpoint) as session:
        replies = session.get(
            key,
            payload=bytes(store.serialize_cdr(asked, "touchline_msgs/srv/Kick_Request")),
            attachment=attachment,
            target=zenoh.QueryTarget.ALL_COMPLETE,
            consolidation=zenoh.ConsolidationMode.NONE,
        )
        found = []
        for reply in replies:
            answer = store.deserialize_cdr(reply.ok.payload.to_bytes(), "touchline_msgs/srv/Kick_Response")
            found.append((answer, reply.ok.attachment.to_bytes()))
        return found


def test_a_kick_is_replied_to_and_goes_with_the_next_command(bench: Bench):
    publisher = bench.driver()
    bench.see(1, holding=True)
    sent = Attachment(9, 123, bytes(range(16)))
    ((answer, raw),) = request(bench, "", 6.0, sent.pack())
    assert (answer.success, answer.message) == (True, "")
    replied = Attachment.unpack(raw)
    assert replied is not None
    assert (replied.sequence, replied.gid) == (sent.sequence, sent.gid)
    assert replied.sent_ns != sent.sent_ns
    publisher.put(bench.twist(1.0, 1))
    kick = bench.command().kick
    assert (kick.mode, kick.speed) == (KickMode.GROUND, 6.0)


@pytest.mark.parametrize(
    ("mode", "speed", "reason"),
    [("ground", 5.0, "the robot does not hold the ball"), ("throw", 5.0, "mode"), ("lob", math.nan, "speed")],
)
def test_a_kick_that_is_impossible_is_refused_with_the_reason(bench: Bench, mode: str, speed: float, reason: str):
    bench.see(1)
    ((answer, _),) = request(bench, mode, speed, Attachment(1, 1, bytes(16)).pack())
    assert not answer.success
    assert reason in answer.message


def test_the_dribbler_is_switched_by_a_topic(bench: Bench):
    publisher, switch = bench.driver(), bench.node.publisher(f"/{ROBOT}/dribble", types.FLAG)
    wait_for(lambda: switch.is_read)
    bench.see(1)
    switch.put(bench.build.encode(bench.build.make(types.FLAG.message, True), types.FLAG))
    publisher.put(bench.twist(1.0, 1))
    assert bench.command().dribble


def test_messages_are_numbered_from_one_with_the_identity_of_their_token(bench: Bench):
    heard: list[Any] = []
    bench.node.subscribe(f"/{ROBOT}/odom", types.ODOMETRY, heard.append)
    all_read(bench, "odom")
    for tick in range(3):
        bench.see(tick)
    wait_for(lambda: len(heard) == 3)
    assert [one.attachment.sequence for one in heard] == [1, 2, 3]
    assert {one.attachment.gid for one in heard} == {bench.robots[ROBOT].messages.writers["odom"].gid}


def test_a_replay_or_another_match_of_the_same_robot_begins_anew(bench: Bench, lockstep: Setup):
    publisher = bench.driver()
    bench.see(500)
    publisher.put(bench.twist(1.0, 500))
    assert bench.command().answers_tick == 500
    bench.runners[ROBOT].restart(bench.robots[ROBOT].begin(lockstep))
    bench.see(0)
    publisher.put(bench.twist(1.0, 0))
    assert bench.command().answers_tick == 0
