"""The limits of the host's router: what a match sends passes, what is far above does not."""

import time
from collections.abc import Iterator
from itertools import combinations

import pytest
import zenoh

from runtime.bus.contract import Bus
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_host
from runtime.bus.zenoh.router_limits import router_limits
from runtime.process.clock import WallClock
from schemas.topic import Delivery, Party
from schemas.topics import COMMAND, ORDER, TOPICS, key_prefix
from support.attacker import open_session

LIMIT = 30.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
ROBOTS = [f"{side}{number}" for side in ("cyan", "magenta") for number in range(1, 12)]
PREFIX = key_prefix("test")
LIMITS = router_limits("test", ROBOTS)


@pytest.fixture
def ends() -> Iterator[tuple[Bus, zenoh.Session]]:
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("test", WallClock(), endpoint, limits=LIMITS) as host, open_session(endpoint) as session:
        yield host, session


def test_every_message_of_the_topic_table_is_within_the_size_for_its_key() -> None:
    for topic in TOPICS.values():
        if topic.writer is Party.HOST or topic.message is None:
            continue
        key = PREFIX + topic.fill()
        sizes = [rule["size_limit"] for rule in LIMITS["low_pass_filter"] if key in rule["key_exprs"]]
        assert len(sizes) == 1, topic.key
        assert min(sizes) >= topic.message.max_bytes


def test_a_command_has_a_rate_of_its_robot_and_every_other_key_one_of_its_kind() -> None:
    limits = router_limits("test", ROBOTS)
    rules = {(rule["id"], item["key_expr"]): item["freq"] for rule in limits["downsampling"] for item in rule["rules"]}
    assert [rule["messages"] for rule in limits["downsampling"]] == [["put", "delete"], ["query"]]
    assert {rule["flows"][0] for rule in LIMITS["downsampling"] + LIMITS["low_pass_filter"]} == {"ingress"}
    for robot in ROBOTS:
        assert rules["messages", PREFIX + COMMAND.fill(robot=robot)] == 200_000.0
    assert rules["messages", PREFIX + ORDER.fill(side="cyan")] == rules["messages", PREFIX + ORDER.fill(side="magenta")]
    assert rules["messages", PREFIX + ORDER.fill(side="cyan")] == 1000.0
    for topic in TOPICS.values():
        if topic.writer is not Party.HOST and topic.message is not None and topic.delivery is Delivery.QUERY:
            keys = [
                key for kind, key in rules if kind == "queries" and zenoh.KeyExpr(key).intersects(PREFIX + topic.fill())
            ]
            assert keys and {rules["queries", key] for key in keys} == {500.0}, topic.key
        if topic.delivery is Delivery.RECOVERED:
            caches = zenoh.KeyExpr(PREFIX + topic.fill() + "/@adv/**")
            keys = [key for kind, key in rules if kind == "queries" and caches.intersects(key)]
            assert keys and {rules["queries", key] for key in keys} == {200.0}, topic.key


def test_no_two_rules_match_the_same_key() -> None:
    """Zenoh does not define which of them would apply."""
    for kind in ("low_pass_filter", "downsampling"):
        for messages in (("put",), ("query",)):
            items = [item for item in LIMITS[kind] if set(messages) & set(item["messages"])]
            keys = [key for item in items for key in item.get("key_exprs", [])]
            keys += [rule["key_expr"] for item in items for rule in item.get("rules", [])]
            exprs = [zenoh.KeyExpr(key) for key in keys]
            overlaps = [(str(a), str(b)) for a, b in combinations(exprs, 2) if a.intersects(b)]
            assert overlaps == []
            assert exprs


def test_commands_of_all_robots_in_one_burst_of_one_program_arrive(ends: tuple[Bus, zenoh.Session]) -> None:
    host, session = ends
    commands = host.subscribe(COMMAND)
    for tick in range(50):
        for robot in ROBOTS:
            key = f"{PREFIX}robot/{robot}/command"
            session.put(key, b"%d" % tick, congestion_control=zenoh.CongestionControl.BLOCK)
        time.sleep(0.002)  # no robot answers two sights in less
        for robot in ROBOTS:
            received = commands.receive(LIMIT)
            assert received is not None
            assert (received.key, received.payload) == (f"robot/{robot}/command", b"%d" % tick)


def test_a_long_message_arrives_for_the_host_to_report_and_a_huge_one_does_not(ends: tuple[Bus, zenoh.Session]) -> None:
    host, session = ends
    commands = host.subscribe(COMMAND)
    for size in (10_000, 40_000, 3_000_000, 20_000_000, 12_000):
        session.put(f"{PREFIX}robot/cyan1/command", b"x" * size, congestion_control=zenoh.CongestionControl.BLOCK)
        time.sleep(0.01)
    arrived: list[int] = []
    deadline = time.monotonic() + LIMIT
    while 12_001 not in arrived and time.monotonic() < deadline:
        session.put(f"{PREFIX}robot/cyan1/command", b"x" * 12_001)
        received = commands.receive(0.1)
        arrived += [len(received.payload)] if received is not None else []
    assert arrived[0] == 10_000
    assert set(arrived) <= {10_000, 12_000, 12_001}


def test_of_a_flood_only_a_part_reaches_the_host_and_the_rest_of_the_link_works(
    ends: tuple[Bus, zenoh.Session],
) -> None:
    host, session = ends
    commands, orders = host.subscribe(COMMAND), host.subscribe(ORDER)
    began = time.monotonic()
    for _ in range(50_000):
        session.put(f"{PREFIX}robot/cyan1/command", b"x", congestion_control=zenoh.CongestionControl.BLOCK)
    session.put(f"{PREFIX}team/cyan/order", b"last", congestion_control=zenoh.CongestionControl.BLOCK)
    last = orders.receive(LIMIT)
    assert last is not None
    took = time.monotonic() - began
    arrived = sum(1 for _ in iter(commands.receive, None))
    assert 0 < arrived <= 200_000 * took + 1
