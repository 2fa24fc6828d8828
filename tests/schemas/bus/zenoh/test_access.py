"""A host with credentials over real Zenoh: what each account may do arrives, and nothing else does."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from schemas.access.accounts import Account
from schemas.access.credentials import HostCredentials, account_file, new_credentials, write_credentials
from schemas.access.protection import Protection
from schemas.bus.contract import PresenceKind
from schemas.bus.zenoh.bus import ZenohBus, open_client, open_host
from schemas.messages.command import Command
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topics import COMMAND, SIGHT, key_prefix

LIMIT = 30.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
MATCH = "guarded"
ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}
PREFIX = key_prefix(MATCH)


def protection_of(credentials: HostCredentials) -> Protection:
    return Protection.of(credentials, MATCH, ROBOTS)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("credentials")


@pytest.fixture(scope="module")
def host(folder: Path) -> Iterator[ZenohBus]:
    credentials = new_credentials()
    write_credentials(folder, credentials)
    with open_host(MATCH, WallClock(), "tcp/127.0.0.1:0", protection_of(credentials)) as bus:
        bus.declare_alive(PresenceKind.HOST, "host")
        yield bus


def join(host: ZenohBus, folder: Path, account: Account) -> ZenohBus:
    return open_client(None, WallClock(), host.endpoint, credentials=account_file(folder, account))


def test_a_team_s_commands_arrive_and_it_receives_its_own_sights(host: ZenohBus, folder: Path) -> None:
    commands = host.subscribe(COMMAND)
    sight = host.publisher(SIGHT, robot="cyan1")
    with join(host, folder, Account.CYAN) as robot:
        assert robot.match == MATCH
        reader = robot.subscribe(SIGHT, robot="cyan1")
        writer = robot.publisher(COMMAND, robot="cyan1")
        writer.put(Command(answers_tick=7))
        received = commands.receive(LIMIT)
        assert received is not None and received.message().answers_tick == 7
        wait_for_subscriber(sight)
        sight.put_payload(b"{}")
        assert reader.receive_payload(LIMIT) == b"{}"


def wait_for_subscriber(publisher: object) -> None:
    clock = WallClock()
    until = clock.now() + LIMIT
    while not publisher.has_subscribers():  # type: ignore[attr-defined]
        assert clock.now() < until
        clock.sleep_until(clock.now() + 0.005)
