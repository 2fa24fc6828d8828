"""A host with credentials over real Zenoh: what an account may do arrives, and nothing else does, in any mode."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import zenoh

from runtime.access.accounts import Account
from runtime.access.credentials import account_file, new_credentials, read_credentials, write_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import BusError, NoReplyError, PresenceKind
from runtime.bus.zenoh.bus import ZenohBus, open_client, open_host
from runtime.bus.zenoh.protection_settings import client_settings
from runtime.process.clock import WallClock
from schemas.messages.command import Command
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.messages.setup import SetupRequest
from schemas.side import Side
from schemas.topics import ACTIVE_ORDER, COMMAND, EVENT, SCENE, SETUP, SIGHT, WORLD, key_prefix
from support.process_story import wait_for

LIMIT = 30.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
MATCH = "guarded"
ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}
PREFIX = key_prefix(MATCH)
OWN = "robot/cyan1/command"
FOREIGN_PUTS = (
    "robot/magenta1/command",
    "robot/*/command",
    "robot/**",
    "**",
    "robot/cyan1/sight",
    "robot/cyan1/manual",
    "team/cyan/order",
    "team/magenta/order",
    "team/cyan/belief/cyan1",
    "world",
    "game/event",
    "game/event/@adv/pub/0/0/_",
    "host/record_batch",
    "record/recorder/progress",
)
FOREIGN_READS = (
    "**",
    "robot/magenta1/sight",
    "robot/*/sight",
    "team/magenta/belief/*",
    "team/*/debug/*",
    "team/*/order",
    "world",
    "*/*/*",
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("credentials")
    write_credentials(folder, new_credentials())
    return folder


@pytest.fixture
def host(folder: Path) -> Iterator[ZenohBus]:
    credentials = new_credentials()
    write_credentials(folder, credentials)
    protection = Protection.of(credentials, MATCH, ROBOTS)
    with open_host(MATCH, WallClock(), "tcp/127.0.0.1:0", protection) as bus:
        bus.declare_alive(PresenceKind.HOST, "host")
        yield bus


@pytest.fixture(params=["client", "peer", "router"])
def attacker(request: pytest.FixtureRequest, host: ZenohBus, folder: Path) -> Iterator[zenoh.Session]:
    """A program of its own with the credentials of cyan's robots."""
    config = zenoh.Config()
    settings: dict[str, object] = {
        "mode": request.param,
        "connect/endpoints": [host.endpoint],
        "listen/endpoints": [],
        "scouting/multicast/enabled": False,
        "scouting/delay": 0,
        "transport/shared_memory/enabled": False,
        **client_settings(read_credentials(account_file(folder, Account.CYAN))),
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    with zenoh.open(config) as session:
        wait_for(lambda: bool([*session.info.routers_zid()]))
        yield session


def join(host: ZenohBus, folder: Path, account: Account) -> ZenohBus:
    return open_client(None, WallClock(), host.endpoint, LIMIT, account_file(folder, account))


def keys_until(reader: Any, last: str) -> list[str]:
    """The keys of all samples up to the one on `last`."""
    found: list[str] = []
    while last not in found:
        wait_for(lambda: (sample := reader.try_recv()) is not None and found.append(key_of(sample)) is None)
    return found


def answer(query: zenoh.Query) -> None:
    query.reply(query.key_expr, b"{}")


def key_of(sample: zenoh.Sample) -> str:
    return str(sample.key_expr).removeprefix(PREFIX)


def test_a_team_s_commands_arrive_and_it_receives_its_own_sights(host: ZenohBus, folder: Path) -> None:
    commands, sight = host.subscribe(COMMAND), host.publisher(SIGHT, robot="cyan1")
    with join(host, folder, Account.CYAN) as robot:
        assert (robot.match, robot.account) == (MATCH, Account.CYAN)
        reader = robot.subscribe(SIGHT, robot="cyan1")
        robot.publisher(COMMAND, robot="cyan1").put(Command(answers_tick=7))
        received = commands.receive(LIMIT)
        assert received is not None and received.message().answers_tick == 7
        wait_for(sight.has_subscribers)
        sight.put_payload(b"{}")
        assert reader.receive_payload(LIMIT) == b"{}"


def test_of_all_that_a_team_publishes_only_its_own_commands_reach_the_host(
    host: ZenohBus, attacker: zenoh.Session, request: pytest.FixtureRequest
) -> None:
    arrived = host.session.declare_subscriber(PREFIX + "**", zenoh.handlers.FifoChannel(1000))
    host.subscribe(COMMAND)  # a router sends only what it knows to be subscribed to
    caches = host.session.declare_subscriber(PREFIX + "**/@adv/**", zenoh.handlers.FifoChannel(1000))
    host.session.declare_queryable(PREFIX + "host/setup", zenoh.handlers.Callback(answer, indirect=False))
    is_router = "router" in request.node.name
    command = attacker.declare_publisher(PREFIX + OWN)
    if not is_router:  # it sends nothing before it knows that somebody subscribes
        wait_for(lambda: command.matching_status.matching)
    for key in FOREIGN_PUTS:
        attacker.put(PREFIX + key, b"{}")
        attacker.delete(PREFIX + key)
    attacker.put(PREFIX + OWN, b"{}")
    wait_for(lambda: any(reply.ok is not None for reply in attacker.get(PREFIX + "host/setup", timeout=0.5)))
    own = [] if is_router else [OWN]  # even these are no router's to send on
    assert [key_of(sample) for sample in iter(arrived.try_recv, None)] == own
    assert caches.try_recv() is None


def test_a_team_receives_only_its_own_sights_and_public_news(host: ZenohBus, attacker: zenoh.Session) -> None:
    readers = [attacker.declare_subscriber(PREFIX + key, zenoh.handlers.FifoChannel(1000)) for key in FOREIGN_READS]
    own = attacker.declare_subscriber(PREFIX + "robot/cyan1/sight", zenoh.handlers.FifoChannel(1000))
    sight = host.publisher(SIGHT, robot="cyan1")
    wait_for(sight.has_subscribers)
    foreign = ("robot/magenta1/sight", "team/magenta/belief/magenta1", "team/magenta/order", "world", "host/applied")
    for key in (*foreign, "team/cyan/debug/cyan1", "team/magenta/debug/magenta1"):
        host.session.put(PREFIX + key, b"{}")
    sight.put_payload(b"{}")
    assert keys_until(own, "robot/cyan1/sight") == ["robot/cyan1/sight"]
    heard = [key_of(sample) for reader in readers for sample in iter(reader.try_recv, None)]
    assert set(heard) <= {"robot/cyan1/sight"}


def test_history_and_recovery_of_a_topic_work_under_the_rules(host: ZenohBus, folder: Path) -> None:
    writer = host.publisher(EVENT)
    for number in range(5):
        writer.put_payload(b"%d" % number)
    with join(host, folder, Account.VIEWER) as viewer:
        reader = viewer.subscribe(EVENT, history=True)
        received = [reader.receive(LIMIT) for _ in range(5)]
        assert [one.payload for one in received if one is not None] == [b"0", b"1", b"2", b"3", b"4"]
        writer.put_payload(b"5")
        assert reader.receive_payload(LIMIT) == b"5"


def test_a_coach_subscribes_to_its_own_side_where_no_side_is_given(host: ZenohBus, folder: Path) -> None:
    writers = {side: host.publisher(ACTIVE_ORDER, side=side.value) for side in Side}
    with join(host, folder, Account.CYAN_COACH) as coach:
        reader = coach.subscribe(ACTIVE_ORDER, history=True)
        writers[Side.MAGENTA].put_payload(b"magenta")
        writers[Side.CYAN].put_payload(b"cyan")
        assert reader.receive_payload(LIMIT) == b"cyan"


def test_a_robot_sees_the_host_s_token_and_no_other(host: ZenohBus, folder: Path) -> None:
    with join(host, folder, Account.MAGENTA) as other, join(host, folder, Account.CYAN) as robot:
        other.declare_alive(PresenceKind.SESSION, "magenta_7")
        watch = host.watch_alive()
        wait_for(lambda: (seen := watch.receive()) is not None and seen.name == "magenta_7")
        seen = robot.watch_alive()
        first = seen.receive(LIMIT)
        assert first is not None and first.kind is PresenceKind.HOST
        assert seen.is_empty()


def test_what_an_account_may_not_send_is_reported_by_its_own_process(host: ZenohBus, folder: Path) -> None:
    with join(host, folder, Account.VIEWER) as viewer:
        with pytest.raises(BusError, match=r"^the account viewer may not send host/scene; use .* with operator\.json$"):
            viewer.query(SCENE, SceneRequest(operation=SceneOperation.RESET))
        with pytest.raises(BusError, match="may not send world"):
            viewer.publisher(WORLD)


def test_a_query_of_an_account_that_nobody_serves_ends_at_once(host: ZenohBus, folder: Path) -> None:
    with join(host, folder, Account.VIEWER) as viewer, pytest.raises(NoReplyError):
        viewer.query(SETUP, SetupRequest(), timeout=LIMIT).payload(LIMIT)
