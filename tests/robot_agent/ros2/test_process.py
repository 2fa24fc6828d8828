"""What `touchline ros2` refuses before it joins, and which robots it serves."""

import pytest

pytest.importorskip("xxhash")

from robot_agent.ros2 import process
from robot_agent.ros2.settings import Ros2Settings
from runtime.bus.contract import BusError
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from runtime.ros2.graph import open_graph
from schemas.errors import TouchlineError
from schemas.side import Side
from support.messages import make_setup


class ServedError(Exception):
    """Instead of a match."""


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch):
    """Run the process with settings up to where it serves robots; which ones."""

    def serve(bus, graph, robots, every, patience):
        raise ServedError(robots, every, graph.node.domain)

    monkeypatch.setattr(process, "serve_robots", serve)
    monkeypatch.setattr(process, "ask_setup", lambda bus, patience: make_setup())
    monkeypatch.setattr(process.signal, "signal", lambda *_: None)

    def run(**settings):
        with open_host("friendly", WallClock(), "tcp/127.0.0.1:0") as host:
            process.run(Ros2Settings(connect=host.endpoint, match="friendly", **settings))

    return run


def test_robots_of_a_side_and_further_ones_are_served(served) -> None:
    with pytest.raises(ServedError) as found:
        served(side=Side.CYAN, robot=["cyan2", "magenta3"], domain=7, every=2, listen="tcp/127.0.0.1:0")
    assert found.value.args == (["cyan1", "cyan2", "cyan3", "cyan4", "cyan5", "magenta3"], 2, 7)


def test_a_robot_that_the_match_does_not_have_is_named(served) -> None:
    with pytest.raises(TouchlineError, match='robot is "cyan9", which is not in match "friendly"'):
        served(robot=["cyan9"])


def test_a_graph_that_other_machines_reach_needs_accounts(served) -> None:
    with pytest.raises(TouchlineError, match=r"--listen tcp/0\.0\.0\.0:0 is open to other machines; add --accounts"):
        served(robot=["cyan1"], listen="tcp/0.0.0.0:0")


def test_a_router_that_does_not_answer_is_named() -> None:
    with pytest.raises(BusError, match=r"--connect tcp/127\.0\.0\.1:9: no host answers there"):
        open_graph("touchline", WallClock(), 0, None, "tcp/127.0.0.1:9", 0.0)
