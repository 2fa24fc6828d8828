"""A router of a graph admits accounts only, and lets each side's nodes drive their own robots."""

import json
import time
from collections.abc import Iterator

import pytest
import zenoh

pytest.importorskip("xxhash")

from runtime.access.accounts import Account
from runtime.access.credentials import HostCredentials
from runtime.access.protection import Protection
from runtime.process.clock import WallClock
from runtime.ros2 import topic_type as types
from runtime.ros2.graph import Arrived, Graph, open_graph
from runtime.ros2.graph_access import graph_access
from runtime.ros2.graph_names import Attachment, Endpoint, Kind, NodeName, data_key
from runtime.ros2.message_types import hash_of
from schemas.side import Side
from support.process_story import wait_for

ROBOTS = {Side.CYAN: ["cyan1", "cyan2"], Side.MAGENTA: ["magenta1"]}


@pytest.fixture
def bridge() -> Iterator[Graph]:
    known = HostCredentials(
        match=None, passwords={account: f"{account.value}-word-of-the-tests" for account in Account}
    )
    protection = Protection(known, graph_access(0, ROBOTS))
    with open_graph("touchline", WallClock(), 0, "tcp/127.0.0.1:0", None, 5.0, protection) as graph:
        yield graph


def join(endpoint: str, account: Account, password: str | None = None) -> zenoh.Session:
    """A session of a node, as rmw_zenoh opens it, with an account."""
    config = zenoh.Config()
    settings = {
        "connect/endpoints": [endpoint],
        "scouting/multicast/enabled": False,
        "transport/auth/usrpwd/user": account.value,
        "transport/auth/usrpwd/password": password or f"{account.value}-word-of-the-tests",
    }
    for name, value in settings.items():
        config.insert_json5(name, json.dumps(value))
    return zenoh.open(config)


def test_nodes_of_a_side_drive_its_robots_and_no_others(bridge: Graph) -> None:
    heard: list[tuple[str, Arrived]] = []
    seen: list[Endpoint] = []
    for robot in ("cyan1", "magenta1"):
        bridge.subscribe(f"/{robot}/cmd_vel", types.TWIST, lambda one, robot=robot: heard.append((robot, one)))
        bridge.watch(f"/{robot}/cmd_vel", Kind.PUBLISHER, lambda endpoint, _: seen.append(endpoint))
    with join(bridge.endpoint, Account.CYAN) as session:
        node = Graph(session, bridge.endpoint, WallClock(), NodeName(0, str(session.zid()), 0, "team"))
        other, own = (node.publisher(f"/{robot}/cmd_vel", types.TWIST) for robot in ("magenta1", "cyan1"))
        wait_for(lambda: own.is_read)
        other.put(b"theirs")
        own.put(b"ours")
        wait_for(lambda: heard)
        assert [(robot, one.payload) for robot, one in heard] == [("cyan1", b"ours")]
        assert {one.topic for one in seen} == {"/cyan1/cmd_vel"}


def test_everybody_reads_the_clock_and_what_is_latched_and_only_the_bridge_writes_them(bridge: Graph) -> None:
    clock, frames = bridge.publisher("/clock", types.CLOCK), bridge.publisher("/tf_static", types.TF_STATIC)
    frames.put(b"frames")
    heard: list[bytes] = []
    with join(bridge.endpoint, Account.MAGENTA) as session:
        key = data_key(0, "/tf_static", types.TF_STATIC, hash_of(types.TF_STATIC))
        zenoh.ext.declare_advanced_subscriber(
            session,
            key,
            lambda sample: heard.append(sample.payload.to_bytes()),
            history=zenoh.ext.HistoryConfig(detect_late_publishers=True, max_samples=1),
            subscriber_detection=True,
        )
        wait_for(lambda: heard == [b"frames"])
        told: list[bytes] = []
        clock_key = data_key(0, "/clock", types.CLOCK, hash_of(types.CLOCK))
        session.declare_subscriber(clock_key, lambda sample: told.append(sample.payload.to_bytes()))
        wait_for(lambda: clock.is_read)
        with join(bridge.endpoint, Account.CYAN) as liar:
            liar.put(clock_key, b"a lie")
            clock.put(b"true")
            wait_for(lambda: told)
            assert told == [b"true"]


def test_a_node_without_an_account_is_not_admitted(bridge: Graph) -> None:
    with join(bridge.endpoint, Account.CYAN) as admitted, join(bridge.endpoint, Account.CYAN, "wrong") as other:
        wait_for(lambda: [*admitted.info.routers_zid()])
        time.sleep(0.3)
        assert [*other.info.routers_zid()] == []


def test_nodes_of_the_operator_alone_control_the_match(bridge: Graph) -> None:
    bridge.serve("/touchline/step_simulation", types.KICK, lambda request: request.reply(b"done"))
    key = data_key(0, "/touchline/step_simulation", types.KICK, hash_of(types.KICK))
    replies = {}
    for account in (Account.CYAN, Account.OPERATOR):
        with join(bridge.endpoint, account) as session:
            found = session.get(key, payload=b"step", attachment=Attachment(1, 1, bytes(16)).pack(), timeout=5.0)
            replies[account] = [reply.ok.payload.to_bytes() for reply in found if reply.ok is not None]
    assert replies == {Account.CYAN: [], Account.OPERATOR: [b"done"]}
