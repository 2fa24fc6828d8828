"""A rival as client, peer and router: what it sends in another's name, and what it listens to, does not get through.

With credentials it is the other team. Without, it is anybody; then only the host itself cannot be impersonated.
"""

import time
from collections.abc import Iterator

import pytest
import zenoh

from schemas.access.accounts import Account
from schemas.access.credentials import account_file, new_credentials, read_credentials, write_credentials
from schemas.access.protection import Protection
from schemas.bus.contract import NoReplyError, PresenceKind
from schemas.bus.zenoh.bus import ZenohBus, open_client, open_host
from schemas.bus.zenoh.open_access import open_access
from schemas.bus.zenoh.router_limits import router_limits
from schemas.messages.command import Command
from schemas.messages.setup import SetupRequest
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topics import (
    BELIEF,
    COMMAND,
    EVENT,
    MANUAL,
    ORDER,
    RECORD_BATCH,
    RECORDER_PROGRESS,
    SETUP,
    SIGHT,
    STATE,
    WORLD,
    key_prefix,
)
from support.attacker import STAMP, open_session

pytestmark = pytest.mark.timeout(120)

LIMIT = 30.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
MATCH = "rivals"
ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}
PREFIX = key_prefix(MATCH)
MODES = ["peer", "router"]
"""What an account sends as a client is in `test_accounts.py`."""
GUARDED, OPEN = "with credentials", "without credentials"
COMMAND_OF_A_RIVAL = Command(answers_tick=3).encode()
FOREIGN_KEYS = [
    "robot/cyan1/command",
    "robot/cyan1/sight",
    "robot/*/command",
    "robot/**",
    "robot/magenta1/manual",
    "team/cyan/order",
    "team/magenta/order",
    "team/cyan/belief/cyan1",
    "record/recorder/progress",
    "host/record_batch",
    "game/state",
    "game/event",
    "world",
    "**",
]
"""Keys on which a team's robots have nothing to say."""
HOST_KEYS = ("host/record_batch", "**", "host/**", "world", "robot/cyan1/sight", "game/state", "game/event")
SECRETS = (SIGHT, "cyan1"), (BELIEF, "cyan1"), (WORLD, None), (RECORD_BATCH, None)


@pytest.fixture(scope="module", params=[GUARDED, OPEN])
def any_host(request, tmp_path_factory) -> Iterator[tuple[ZenohBus, dict[str, str]]]:
    """A host with its limits, and what a rival needs to connect."""
    limits = router_limits(MATCH, [robot for robots in ROBOTS.values() for robot in robots])
    folder = tmp_path_factory.mktemp("credentials")
    protection, user = None, {}
    if request.param == GUARDED:
        credentials = new_credentials()
        write_credentials(folder, credentials)
        protection = Protection.of(credentials, MATCH, ROBOTS)
        magenta = read_credentials(account_file(folder, Account.MAGENTA))
        user = {
            "transport/auth/usrpwd/user": magenta.user.value,
            "transport/auth/usrpwd/password": magenta.password,
        }
    else:
        limits["access_control"] = open_access(MATCH, ROBOTS)
    with open_host(MATCH, WallClock(), "tcp/127.0.0.1:0", protection, limits) as bus:
        bus.declare_alive(PresenceKind.HOST, "host")
        bus.folder = folder if user else None
        yield bus, user


@pytest.fixture
def guarded(any_host):
    if not any_host[1]:
        pytest.skip("without credentials any client may speak for any robot; the host counts and limits it")
    return any_host


def rival(host, mode) -> zenoh.Session:
    bus, user = host
    return open_session(bus.endpoint, mode, **user)


def client(bus, account) -> ZenohBus:
    if bus.folder is None:
        return open_client(MATCH, WallClock(), bus.endpoint)
    return open_client(None, WallClock(), bus.endpoint, credentials=account_file(bus.folder, account))


def put_until_received(session, key, payload, reader):
    """The messages that a reader received until this payload arrived on a key on which the rival may publish."""
    received, deadline = [], time.monotonic() + LIMIT
    while time.monotonic() < deadline:
        session.put(PREFIX + key, payload)
        while (one := reader.receive(0.05)) is not None:
            if one.payload == payload and one.key == key:
                return received
            received.append((one.key, one.payload))
    raise AssertionError(f"nothing arrived on {key}")


@pytest.mark.parametrize("mode", MODES)
def test_what_a_team_sends_in_anothers_name_reaches_no_reader_of_the_host(guarded, mode):
    bus, _ = guarded
    topics = (MANUAL, ORDER, RECORDER_PROGRESS, SIGHT, BELIEF, STATE, EVENT, WORLD, RECORD_BATCH)
    commands, others = bus.subscribe(COMMAND), [bus.subscribe(topic) for topic in topics]
    with rival(guarded, mode) as session:
        for key in FOREIGN_KEYS:
            session.put(PREFIX + key, COMMAND_OF_A_RIVAL, attachment=STAMP.pack(10**6, 0, 0))
            session.delete(PREFIX + key)
        assert put_until_received(session, "robot/magenta1/command", b"own", commands) == []
    assert [reader.receive() for reader in others] == [None] * len(others)
    for reader in (commands, *others):
        reader.close()


def test_a_team_receives_nothing_that_is_anothers(guarded):
    bus, _ = guarded
    keys = [*FOREIGN_KEYS, "**/@adv/**", "host/**"]
    own, leaked = [], []
    publishers = [bus.publisher(topic, **_chunks(topic, robot)) for topic, robot in SECRETS]
    sight = bus.publisher(SIGHT, robot="magenta1")
    with rival(guarded, "client") as session:

        def note(sample):
            key = str(sample.key_expr).removeprefix(PREFIX)
            (own if key == "robot/magenta1/sight" else leaked).append(key)

        readers = [session.declare_subscriber(PREFIX + key, zenoh.handlers.Callback(note)) for key in keys]
        readers.append(session.declare_subscriber(PREFIX + "robot/magenta1/sight", zenoh.handlers.Callback(note)))
        deadline = time.monotonic() + LIMIT
        while not own and time.monotonic() < deadline:
            for publisher in publishers:
                publisher.put_payload(b"secret")
            sight.put_payload(b"own")
            time.sleep(0.02)
        for reader in readers:
            reader.undeclare()
    assert own
    assert leaked == []


def _chunks(topic, robot):
    chunks = {"robot": robot} if robot is not None else {}
    return chunks | ({"side": "cyan"} if "side" in topic.chunks else {})


@pytest.mark.parametrize("mode", MODES)
def test_nobody_publishes_as_the_host_with_credentials_or_without(any_host, mode):
    bus, _ = any_host
    with client(bus, Account.RECORDER) as recorder:
        batches = recorder.subscribe(RECORD_BATCH)
        writer = bus.publisher(RECORD_BATCH)
        with rival(any_host, mode) as session:
            deadline, received = time.monotonic() + LIMIT, []
            while received.count(b"real") < 10 and time.monotonic() < deadline:
                for key in HOST_KEYS:
                    session.put(PREFIX + key, b"false", attachment=STAMP.pack(10**6, 0, 0))
                writer.put_payload(b"real")
                received += [one.payload for one in iter(lambda: batches.receive(0.02), None)]
    assert set(received) == {b"real"}


@pytest.mark.parametrize("mode", MODES)
def test_nobody_answers_in_place_of_the_host_with_credentials_or_without(any_host, mode):
    bus, _ = any_host
    with client(bus, Account.VIEWER) as viewer, rival(any_host, mode) as session:
        asked = []
        for key in ("host/setup", "host/**", "**"):
            session.declare_queryable(PREFIX + key, zenoh.handlers.Callback(asked.append))
        with pytest.raises(NoReplyError):
            viewer.query(SETUP, SetupRequest(), 1.0).payload(2.0)
        assert asked == []
