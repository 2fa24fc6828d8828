"""The process of a ROS 2 graph: a session with the match, and one with the nodes."""

import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

from robot_agent.process.claim import Membership
from robot_agent.process.runner import Member, ask_setup
from robot_agent.process.team_process import serve_team
from robot_agent.ros2.clock_keeper import ClockKeeper
from robot_agent.ros2.robot import RosRobot, RosRunner
from robot_agent.ros2.settings import Ros2Settings
from robot_agent.ros2.shown_match import show_match
from robot_agent.ros2.simulation.control import SimulationControl
from robot_agent.ros2.simulation.match_client import MatchClient
from robot_agent.sdk.contract import Briefing
from runtime.access.accounts import Account
from runtime.access.credentials import read_host_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import Bus, Subscription
from runtime.bus.endpoint import is_loopback
from runtime.bus.zenoh.bus import ZenohBus, open_client
from runtime.bus.zenoh.waiting_client import open_when_there
from runtime.process.clock import Clock, WallClock
from runtime.process.process_log import configure_log, log_line
from runtime.process.timing import RECONNECT_S
from runtime.ros2.graph import Graph, open_graph
from runtime.ros2.graph_access import graph_access
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup

NODE = "touchline"
"""Name of the node."""


def run(settings: Ros2Settings) -> int:
    """Run until the match is over, or until SIGINT or SIGTERM; the exit status of the process.

    Raises:
        TouchlineError: no host or no router answers, the host refuses a robot, or a package is not installed.
    """
    configure_log("ros2", settings.log_format)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    clock = WallClock()
    plays = settings.side is not None or bool(settings.robot)

    def connect(patience: float) -> ZenohBus:
        account = Account.VIEWER if not plays else Account.of_team(settings.side) if settings.side else None
        return open_client(settings.match, clock, settings.connect, patience, settings.credentials, account)

    try:
        client = open_when_there(connect, clock, settings.patience, log_line)
        assert client is not None  # a wait that nothing stops
        with client as bus:
            setup = ask_setup(bus, settings.patience)
            robots = _robots(settings, setup)
            where = settings.domain, settings.listen, settings.router, settings.patience
            with (
                open_graph(NODE, clock, *where, _protection(settings, setup)) as graph,
                _controlled(settings, clock, graph, setup),
            ):
                _say_where(graph, settings)
                if not robots:
                    return show_match(bus, graph, setup, settings.patience)
                return serve_robots(bus, graph, robots, settings.every, settings.patience)
    except KeyboardInterrupt:
        return 0


def serve_robots(bus: Bus, graph: Graph, robots: Sequence[str], every: int, patience: float) -> int:
    """Let nodes drive these robots until one of them ends; its status. Each robot joins once a node drives it.

    Raises:
        TouchlineError: as `serve`.
    """
    keeper = ClockKeeper(graph, bus)
    served = {name: RosRobot(graph, name, keeper, every) for name in robots}
    keeper.follow([one.messages for one in served.values()])
    told_at = bus.clock.now()

    def is_driven(robot: str) -> bool:
        nonlocal told_at
        if not served[robot].is_driven and bus.clock.now() - told_at >= RECONNECT_S:
            told_at = bus.clock.now()
            missing = [f"/{name}/cmd_vel" for name, one in served.items() if not one.is_driven]
            log_line(f"no node publishes {', '.join(missing)} yet; waiting for one")
        return served[robot].is_driven

    def member(robot: str, sights: Subscription) -> Member:
        membership = Membership(bus, robot, None, bus.match)
        runner: Any = partial(RosRunner, sights=sights)
        return Member(bus, served[robot].begin, robot, patience, membership, runner)  # type: ignore[arg-type]

    return serve_team(bus, robots, member, is_driven)


@contextmanager
def _controlled(settings: Ros2Settings, clock: Clock, graph: Graph, setup: Setup) -> Iterator[None]:
    """With --control, nodes control the match meanwhile, by a session with the rights of its operator."""
    if not settings.control:
        yield
        return
    where = settings.match, clock, settings.connect, settings.patience, settings.credentials
    with open_client(*where, Account.OPERATOR) as bus, SimulationControl(graph, MatchClient(bus, setup)):
        yield


def _robots(settings: Ros2Settings, setup: Setup) -> list[str]:
    """The robots that nodes drive.

    Raises:
        TouchlineError: the match has no such robot.
    """
    for name in settings.robot:
        Briefing.of(name, setup)
    of_side = setup.teams[settings.side].robots if settings.side is not None else []
    return list(dict.fromkeys([*of_side, *settings.robot]))


def _protection(settings: Ros2Settings, setup: Setup) -> Protection | None:
    """Who may join the graph; None for every node.

    Raises:
        TouchlineError: other machines could join without an account, or the file of accounts cannot be read.
    """
    if settings.accounts is not None:
        robots = {side: team.robots for side, team in setup.teams.items()}
        return Protection(read_host_credentials(settings.accounts), graph_access(settings.domain, robots))
    if settings.router is None and not is_loopback(settings.listen):
        raise TouchlineError(
            f"--listen {settings.listen} is open to other machines; add --accounts credentials/host.json of `touchline "
            "credentials new`, or let the nodes join on a router of yours, with --router"
        )
    return None


def _say_where(graph: Graph, settings: Ros2Settings) -> None:
    override = f"""ZENOH_CONFIG_OVERRIDE='connect/endpoints=["{graph.endpoint}"]'"""
    how = "" if settings.router is not None else f": RMW_IMPLEMENTATION=rmw_zenoh_cpp {override}"
    log_line(f"ROS 2 nodes of domain {settings.domain} reach this graph at {graph.endpoint}{how}")
