"""What reaches no reader, though Zenoh delivers it: messages and queries on keys of no topic, tokens without a name."""

from collections.abc import Iterator

import pytest
import zenoh

from runtime.bus.contract import Bus, PresenceKind
from runtime.bus.endpoint import with_free_port
from runtime.bus.refusals import NO_KEY, Refusal
from runtime.bus.zenoh.bus import open_host
from runtime.bus.zenoh.presence import NO_NAME
from runtime.bus.zenoh.queries import MAX_WAITING, TOO_MANY
from runtime.process.clock import WallClock
from schemas.messages.command import Command
from schemas.messages.setup import SetupRequest
from schemas.topics import COMMAND, ORDER, RECORDER_PROGRESS, SETUP
from support.attacker import BELIEF, PROGRESS, open_session

PREFIX = "touchline/test/"
LIMIT = 30.0
WILDCARDS = [
    "**",
    f"{PREFIX}**",
    f"{PREFIX}robot/**",
    f"{PREFIX}*/*/*",
    f"{PREFIX}robot/*/command",
    f"{PREFIX}**/order",
]


@pytest.fixture
def ends() -> Iterator[tuple[Bus, zenoh.Session]]:
    """A host without limits of its router, and an attacker."""
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("test", WallClock(), endpoint) as host, open_session(endpoint) as session:
        yield host, session


@pytest.mark.parametrize("key", WILDCARDS)
def test_a_message_on_a_key_with_wildcards_reaches_no_reader_and_is_counted(
    ends: tuple[Bus, zenoh.Session], key: str
) -> None:
    host, session = ends
    readers = [host.subscribe(topic) for topic in (COMMAND, ORDER, RECORDER_PROGRESS)]
    for payload in (b"", b"?", BELIEF, PROGRESS, Command(answers_tick=0).encode()):
        session.put(key, payload)
    session.put(f"{PREFIX}robot/cyan1/command", b"last")
    received = readers[0].receive(LIMIT)
    assert received is not None
    assert (received.key, received.payload) == ("robot/cyan1/command", b"last")
    assert [reader.receive() for reader in readers] == [None, None, None]
    refused = host.refusals.pop()
    assert refused
    assert {refusal.reason for refusal in refused} == {NO_KEY}
    assert {refusal.key for refusal in refused} == {key.removeprefix(PREFIX)}


def test_a_key_with_a_very_long_chunk_reaches_no_reader(ends: tuple[Bus, zenoh.Session]) -> None:
    host, session = ends
    commands = host.subscribe(COMMAND)
    session.put(f"{PREFIX}robot/{'x' * 5000}/command", b"?")
    session.put(f"{PREFIX}robot/cyan1/command", b"last")
    received = commands.receive(LIMIT)
    assert received is not None
    assert received.payload == b"last"
    (refusal,) = host.refusals.pop()
    assert len(refusal.key) < 100


def test_a_query_on_a_key_with_wildcards_is_not_answered_and_counted(ends: tuple[Bus, zenoh.Session]) -> None:
    host, session = ends
    setups = host.serve(SETUP)
    assert list(session.get(f"{PREFIX}**", payload=SetupRequest().encode(), timeout=LIMIT)) == []
    assert setups.receive() is None
    assert host.refusals.pop() == [Refusal("**", NO_KEY, 1, 0)]


def test_only_so_many_queries_wait_and_the_others_end_at_once(ends: tuple[Bus, zenoh.Session]) -> None:
    host, session = ends
    setups = host.serve(SETUP)
    answers = [
        session.get(f"{PREFIX}host/setup", zenoh.handlers.FifoChannel(4), payload=b"{}", timeout=LIMIT)
        for _ in range(MAX_WAITING + 10)
    ]
    for dropped in answers[MAX_WAITING:]:
        assert list(dropped) == []
    assert host.refusals.pop() == [Refusal("host/setup", TOO_MANY, 10, 0)]
    waiting = 0
    while (query := setups.receive()) is not None:
        query.fail("no")
        waiting += 1
    assert waiting == MAX_WAITING


def test_a_reply_to_a_client_that_has_gone_is_no_error(ends: tuple[Bus, zenoh.Session]) -> None:
    host, session = ends
    setups = host.serve(SETUP)
    answers = session.get(f"{PREFIX}host/setup", zenoh.handlers.FifoChannel(4), payload=b"{}", timeout=LIMIT)
    query = setups.receive(LIMIT)
    session.close()  # type: ignore[no-untyped-call]
    assert query is not None
    query.fail("too late")
    assert list(answers) == []


@pytest.mark.parametrize("kind", [PresenceKind.AGENT, PresenceKind.RECORDER, PresenceKind.REFEREE])
def test_a_token_whose_name_is_no_name_is_ignored_and_counted(
    ends: tuple[Bus, zenoh.Session], kind: PresenceKind
) -> None:
    host, session = ends
    watch = host.watch_alive()
    names = ["No Name", "Ω", "UPPER", "9", "x" * 500, "{}"]
    strange = [session.liveliness().declare_token(f"{PREFIX}alive/{kind}/{name}") for name in names]
    real = session.liveliness().declare_token(f"{PREFIX}alive/{kind}/cyan1")
    presence = watch.receive(LIMIT)
    assert presence is not None
    assert presence.name == "cyan1"
    assert host.refusals.pop() == [Refusal(f"alive/{kind}/*", NO_NAME, len(names), 0)]
    del strange, real


def test_stamps_that_are_ahead_do_not_move_the_hosts_time(ends: tuple[Bus, zenoh.Session]) -> None:
    """The host measures latencies by its router's stamps, of which each is later than the one before."""
    from datetime import UTC, datetime, timedelta

    host, session = ends
    commands = host.subscribe(COMMAND)
    ahead = zenoh.Timestamp(datetime.now(UTC) + timedelta(milliseconds=390), session.new_timestamp().get_id())
    session.put(f"{PREFIX}robot/cyan1/command", b"ahead", timestamp=ahead)
    session.put(f"{PREFIX}robot/cyan2/command", b"next")
    for _ in range(2):
        received = commands.receive(LIMIT)
        assert received is not None
        assert received.arrived_ns < host.clock.unix_ns() + 50_000_000
