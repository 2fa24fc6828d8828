"""A program with the credentials of one account that does what is another's: nothing of it reaches the host.

The table below stands here a second time on purpose, apart from the topic table that the rules are derived from.
"""

import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import zenoh

from runtime.access.accounts import Account
from runtime.access.credentials import account_file, new_credentials, write_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import PresenceKind
from runtime.bus.zenoh.bus import ZenohBus, open_host
from runtime.bus.zenoh.router_limits import router_limits
from runtime.process.clock import WallClock
from schemas.side import Side
from schemas.topics import key_prefix
from support.attacker import STAMP, open_session, user_of

pytestmark = pytest.mark.timeout(120)

LIMIT = 30.0
ROUNDS = 3
MATCH = "accounts"
PREFIX = key_prefix(MATCH)
ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}
COMMANDS = {side: {f"robot/{side.value}{number}/command" for number in (1, 2)} for side in Side}
MANUAL = {side: {f"robot/{side.value}{number}/manual" for number in (1, 2)} for side in Side}
WRITTEN = {
    Account.CYAN: COMMANDS[Side.CYAN],
    Account.MAGENTA: COMMANDS[Side.MAGENTA],
    Account.CYAN_COACH: {"team/cyan/order", *MANUAL[Side.CYAN]},
    Account.MAGENTA_COACH: {"team/magenta/order", *MANUAL[Side.MAGENTA]},
    Account.REFEREE: set(),
    Account.OPERATOR: {"team/cyan/order", "team/magenta/order", *MANUAL[Side.CYAN], *MANUAL[Side.MAGENTA]},
    Account.RECORDER: {"record/recorder/progress"},
    Account.VIEWER: set(),
}
"""Account → the keys below on which it may publish."""
PATTERNS = {Account.OPERATOR: {"team/*/order"}}
"""Keys with wildcards that lie within the rights of an account: they pass the router, not the host's bus."""
OFFICIATING = {"game/action", "game/referee_seat", "host/admission"}
QUERIED = {
    Account.CYAN: {"robot/cyan1/claim"},
    Account.MAGENTA: {"robot/magenta1/claim"},
    Account.CYAN_COACH: set(),
    Account.MAGENTA_COACH: set(),
    Account.REFEREE: OFFICIATING,
    Account.OPERATOR: {*OFFICIATING, "host/parameters", "host/scene"},
    Account.RECORDER: {"host/record_batches"},
    Account.VIEWER: set(),
}
"""Account → the services below that it may use, beside the setup that all may request."""
TOKENS = {
    Account.CYAN: {"agent/cyan1", "session/cyan_1"},
    Account.MAGENTA: {"agent/magenta1", "session/magenta_1"},
    Account.CYAN_COACH: {"coach/page"},
    Account.MAGENTA_COACH: {"coach/page"},
    Account.REFEREE: {"coach/page", "referee/box", "refbox/cyan"},
    Account.OPERATOR: {"coach/page", "referee/box", "refbox/cyan"},
    Account.RECORDER: {"recorder/tape"},
    Account.VIEWER: {"coach/page"},
}
"""Account → the tokens below that it may declare."""
HOST_KEYS = (
    "world",
    "robot/cyan1/sight",
    "team/cyan/belief/cyan1",
    "team/cyan/standing",
    "game/state",
    "game/event",
    "host/applied",
    "host/health",
    "host/record_batch",
    "game/event/@adv/pub/0/0/_",
)
WILDCARDS = ("**", "robot/**", "robot/*/command", "team/**", "team/*/order", "record/**", "host/**", "*/*/*")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("credentials")


@pytest.fixture
def host(folder: Path) -> Iterator[ZenohBus]:
    credentials = new_credentials()
    write_credentials(folder, credentials)
    limits = router_limits(MATCH, [robot for robots in ROBOTS.values() for robot in robots])
    protection = Protection.of(credentials, MATCH, ROBOTS)
    with open_host(MATCH, WallClock(), "tcp/127.0.0.1:0", protection, limits) as bus:
        bus.declare_alive(PresenceKind.HOST, "host")
        yield bus


@pytest.fixture(params=list(Account))
def account(request: pytest.FixtureRequest) -> Account:
    return request.param


@pytest.fixture
def attacker(host: ZenohBus, folder: Path, account: Account) -> Iterator[zenoh.Session]:
    with open_session(host.endpoint, **user_of(account_file(folder, account))) as session:
        yield session


def key_of(entry: zenoh.Sample | zenoh.Query) -> str:
    return str(entry.key_expr).removeprefix(PREFIX)


def repeat(attempt, is_done, session: zenoh.Session) -> None:
    """Repeat an attempt until it has had all the effect that it may, and the host has replied after that.

    A client sends nothing before it has learned who reads it. The reply shows that all before it has arrived.
    """
    deadline = time.monotonic() + LIMIT
    replied = 0
    while not (is_done() and replied >= ROUNDS):
        assert time.monotonic() < deadline
        attempt()
        replies = session.get(PREFIX + "host/setup", payload=b"{}", timeout=0.5)
        replied += bool([reply.ok for reply in replies if reply.ok is not None])


@pytest.fixture
def setup_service(host: ZenohBus) -> Iterator[None]:
    def reply(query: zenoh.Query) -> None:
        query.reply(query.key_expr, b"{}")

    service = host.session.declare_queryable(PREFIX + "host/setup", zenoh.handlers.Callback(reply, indirect=False))
    yield
    service.undeclare()


def test_of_all_that_an_account_publishes_only_its_own_keys_reach_the_host(host, setup_service, attacker, account):
    arrived, deleted = set(), []

    def note(sample: zenoh.Sample) -> None:
        arrived.add(key_of(sample))
        deleted.extend([key_of(sample)] if sample.kind == zenoh.SampleKind.DELETE else [])

    def attempt() -> None:
        for key in sorted({*HOST_KEYS, *WILDCARDS, *set().union(*WRITTEN.values())}):
            attacker.put(PREFIX + key, b"{}", attachment=STAMP.pack(10**6, 0, 0))
            attacker.delete(PREFIX + key)

    with host.session.declare_subscriber(PREFIX + "**", zenoh.handlers.Callback(note, indirect=False)):
        repeat(attempt, lambda: arrived >= WRITTEN[account], attacker)
    assert arrived - PATTERNS.get(account, set()) == WRITTEN[account]
    assert deleted == []


def test_of_all_services_an_account_reaches_only_its_own(host, setup_service, attacker, account):
    asked = set()

    def attempt() -> None:
        for key in sorted({*set().union(*QUERIED.values()), "host/claim", "robot/*/claim", "**"}):
            attacker.get(PREFIX + key, zenoh.handlers.RingChannel(1), payload=b"{}", timeout=0.5)

    callback = zenoh.handlers.Callback(lambda query: asked.add(key_of(query)), indirect=False)
    with host.session.declare_queryable(PREFIX + "**", callback):
        repeat(attempt, lambda: asked >= QUERIED[account], attacker)
    assert asked - {"host/setup"} == QUERIED[account]


def test_an_account_declares_only_its_own_tokens(host, setup_service, attacker, account):
    tokens, held = set(), []

    def attempt() -> None:
        names = sorted({*set().union(*TOKENS.values()), "host/host", "replay/replay", "**"})
        held[:] = [attacker.liveliness().declare_token(f"{PREFIX}alive/{name}") for name in names]

    callback = zenoh.handlers.Callback(lambda token: tokens.add(key_of(token).removeprefix("alive/")), indirect=False)
    with host.session.liveliness().declare_subscriber(PREFIX + "**", callback):
        repeat(attempt, lambda: tokens >= TOKENS[account], attacker)
    assert tokens == TOKENS[account]
