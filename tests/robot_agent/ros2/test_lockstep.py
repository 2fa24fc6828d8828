"""A host in lockstep whose robot a ROS 2 node drives: a node that hangs is treated like any agent."""

import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("xxhash")

from robot_agent.ros2.clock_keeper import ClockKeeper
from robot_agent.ros2.robot import RosRobot, RosRunner
from runtime.process.clock import WallClock
from runtime.ros2 import topic_type as types
from runtime.ros2.graph import Arrived, Graph, open_graph
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.message_types import typestore
from schemas.config.match_config import MatchConfig
from schemas.messages.command import Drive
from sim_host.server.admission.agent_stats import SILENT_TICKS
from support.host_rig import TEAMS, Agent, HostRig

ROBOT = "cyan2"
LIMIT_S = 30.0


class Node:
    """Answers each `/clock` with a stamped command, unless it hangs."""

    def __init__(self, graph: Graph) -> None:
        self.hangs = False
        self._build = MessageBuilder()
        self._commands = graph.publisher(f"/{ROBOT}/cmd_vel", types.TWIST_STAMPED)
        graph.subscribe("/clock", types.CLOCK, self._answer)

    def _answer(self, arrived: Arrived) -> None:
        if self.hangs:
            return
        told: Any = typestore().deserialize_cdr(arrived.payload, types.CLOCK.message)
        header = self._build.header(told.clock, "")
        message = self._build.make(types.TWIST_STAMPED.message, header, self._build.twist(1.0, 0.0, 0.0, 0.0))
        self._commands.put(self._build.encode(message, types.TWIST_STAMPED))


@pytest.fixture(params=[[], ["cyan1"]], ids=["alone", "beside a robot that no node drives"])
def played(request: pytest.FixtureRequest) -> Iterator[tuple[HostRig, Node]]:
    """A small match at tick 0, whose `cyan2` the node drives."""
    rig = HostRig(MatchConfig.model_validate({"seed": 7, "teams": TEAMS, "patience": {"answer": 2.0}}))
    with (
        open_graph("touchline", WallClock(), 0, "tcp/127.0.0.1:0", None, 10.0) as graph,
        open_graph("team", WallClock(), 0, None, graph.endpoint, 10.0) as other,
    ):
        rig.join_all()
        rig.leave(ROBOT)
        bus = rig.seat()
        keeper = ClockKeeper(graph, bus)
        robot = RosRobot(graph, ROBOT, keeper, 1)
        idle = [RosRobot(graph, name, keeper, 1) for name in request.param]
        keeper.follow([one.messages for one in (robot, *idle)])
        node = Node(other)
        deadline = time.monotonic() + LIMIT_S
        while not (robot.is_driven and keeper.clock.is_read) and time.monotonic() < deadline:
            time.sleep(0.002)
        rig.agents[ROBOT] = Agent(bus, RosRunner(bus, robot.begin(rig.host.simulation.setup()), ROBOT))
        bus.declare_alive("agent", ROBOT)
        rig.idle.append(lambda: threading.Event().wait(0.0002))  # for the threads of Zenoh
        rig.begin()
        yield rig, node
    rig.host.simulation.close()


def test_every_tick_is_answered_by_the_node(played: tuple[HostRig, Node]) -> None:
    rig, _ = played
    rig.ticks(60)
    inputs = rig.inputs(ROBOT)
    assert [given.answers_tick for given in inputs] == list(range(60))
    assert all(given.drive == Drive(vx=1.0) for given in inputs)
    assert rig.truth(ROBOT)["vx"] > 0.5


def test_a_node_that_hangs_is_waited_for_like_any_agent_and_plays_on_when_it_answers(
    played: tuple[HostRig, Node],
) -> None:
    rig, node = played
    rig.ticks(30)
    node.hangs = True
    rig.ticks(SILENT_TICKS + 60)
    assert abs(rig.truth(ROBOT)["vx"]) < 1e-3
    assert rig.truth("cyan1")["vx"] > 0.5
    assert rig.silences() == [f"{ROBOT} does not answer, its robot stops"]
    node.hangs = False
    deadline = time.monotonic() + LIMIT_S
    while not rig.silences() and time.monotonic() < deadline:
        rig.ticks(1)
        time.sleep(0.005)
    assert rig.truth(ROBOT)["vx"] >= 0.0
    rig.read_all()
    rig.ticks(20)
    assert [given.drive.vx for given in rig.inputs(ROBOT)].count(1.0) >= 18
