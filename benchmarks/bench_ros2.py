"""What the way over a ROS 2 graph adds to a command in real time, and what a robot's sight costs there.

`python benchmarks/bench_ros2.py`. Host, bridge and node are three sessions of Zenoh on loopback, in one process.
"""

import time
from collections.abc import Callable
from statistics import median, quantiles

from robot_agent.ros2.clock_keeper import ClockKeeper
from robot_agent.ros2.robot import RosRobot, RosRunner
from runtime.bus.zenoh.bus import open_client, open_host
from runtime.process.clock import WallClock
from runtime.ros2 import topic_type as types
from runtime.ros2.graph import open_graph
from runtime.ros2.message_builder import MessageBuilder
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.command import Command, Drive
from schemas.messages.setup import Setup
from schemas.messages.sight import BallSight, Motion, Obstacle, Sight
from schemas.messages.soccer.game import GameView
from schemas.side import Side
from schemas.soccer.game import TeamPhase
from schemas.topics import COMMAND

ROBOT, TICK_NS, COMMANDS = "cyan2", 20_000_000, 2000


def sight_of(tick: int) -> Sight:
    """A sight with nine obstacles."""
    return Sight(
        tick=tick,
        time=tick * TICK_NS * 1e-9,
        robot=ROBOT,
        side=Side.CYAN,
        self=Motion(x=1.0, y=2.0, heading=0.5, vx=1.0, vy=0.2, omega=0.3),
        ball=BallSight(x=3.0, y=1.0, vx=0.5, vy=0.0),
        holding=False,
        obstacles=[Obstacle(float(number), 1.0, 0.25) for number in range(9)],
        game=GameView(phase=TeamPhase.PLAY, running=True, clock=tick * 0.02, our_score=0, their_score=0),
    )


def times_of(send: Callable[[int], object], receive: Callable[[float], object], ticks: range) -> list[float]:
    """Wall time from sending the command of each tick to its arrival at the host, in ms.

    The wait leaves the interpreter to the thread of the graph, as in the process of the bridge.
    """
    found = []
    for tick in ticks:
        began = time.perf_counter()
        send(tick)
        if receive(10.0) is None:
            raise TimeoutError(f"no command arrived for tick {tick}")
        found.append(1e3 * (time.perf_counter() - began))
    return found


def main() -> None:
    """Print the figures."""
    clock, build = WallClock(), MessageBuilder()
    setup = Setup.of(load_match(None, {"pace": "realtime"}), load_profile("msl"), load_rule_book("friendly"))
    with (
        open_host("bench", clock, "tcp/127.0.0.1:0") as host,
        open_client("bench", clock, host.endpoint) as bus,
        open_graph("touchline", clock, 0, "tcp/127.0.0.1:0", None, 10.0) as graph,
        open_graph("node", clock, 0, None, graph.endpoint, 10.0) as node,
    ):
        keeper = ClockKeeper(graph, bus)
        robot = RosRobot(graph, ROBOT, keeper, 1)
        keeper.follow([robot.messages])
        runner = RosRunner(bus, robot.begin(setup), ROBOT)
        commands, direct = host.subscribe(COMMAND), bus.publisher(COMMAND, robot=ROBOT)
        publisher = node.publisher(f"/{ROBOT}/cmd_vel", types.TWIST_STAMPED)
        while not (robot.is_driven and publisher.is_read):
            time.sleep(0.01)

        def through(tick: int) -> None:
            header = build.header(build.stamp(tick * TICK_NS), "")
            message = build.make(types.TWIST_STAMPED.message, header, build.twist(1.0, 0.0, 0.0, 0.5))
            publisher.put(build.encode(message, types.TWIST_STAMPED))

        def direct_command(tick: int) -> None:
            direct.put(Command(answers_tick=tick, drive=Drive(vx=1.0, omega=0.5)))

        ways: list[tuple[float, float]] = []
        for first in range(0, COMMANDS, 200):
            times = times_of(direct_command, commands.receive, range(first, first + 200))
            graph_times = []
            for tick in range(first, first + 200):
                runner.answer(sight_of(tick))
                graph_times += times_of(through, commands.receive, range(tick, tick + 1))
            ways += zip(times, graph_times, strict=True)
        for name, found in zip(("direct", "over the graph"), zip(*ways, strict=True), strict=True):
            print(f"{name:15} median {median(found):.3f} ms, 95 % within {quantiles(found, n=20)[-1]:.3f} ms")
        print(f"added           median {median(b - a for a, b in ways):.3f} ms")
        for topic, topic_type in (
            (f"/{ROBOT}/odom", types.ODOMETRY),
            (f"/{ROBOT}/ball", types.BALL),
            (f"/{ROBOT}/obstacles", types.OBSTACLES),
            (f"/{ROBOT}/game", types.GAME),
            ("/tf", types.TF),
            ("/clock", types.CLOCK),
        ):
            node.subscribe(topic, topic_type, lambda _: None)
        while not (keeper.clock.is_read and robot.messages.writers["odom"].is_read):
            time.sleep(0.01)
        costs = []
        for tick in range(COMMANDS, COMMANDS + 1000):
            sight = sight_of(tick)
            began = time.perf_counter()
            runner.answer(sight)
            costs.append(1e3 * (time.perf_counter() - began))
        print(f"a sight         median {median(costs):.3f} ms, with all its topics read")


if __name__ == "__main__":
    main()
