"""A client, peer or router without credentials, on a host that asks for none: the host cannot be impersonated.

With credentials, `test_accounts.py` and `tests/runtime/bus/zenoh/test_access.py` try every account and every mode.
"""

import time
from collections.abc import Iterator

import pytest

from runtime.bus.contract import NoReplyError, PresenceKind
from runtime.bus.zenoh.bus import ZenohBus, open_client, open_host
from runtime.bus.zenoh.open_access import open_access
from runtime.bus.zenoh.router_limits import router_limits
from runtime.process.clock import WallClock
from schemas.messages.setup import SetupRequest
from schemas.side import Side
from schemas.topics import RECORD_BATCH, SETUP, key_prefix
from support.attacker import STAMP, open_session

pytestmark = [pytest.mark.timeout(120), pytest.mark.parametrize("mode", ["client", "peer", "router"])]

LIMIT = 30.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
MATCH = "rivals"
ROBOTS = {side: [f"{side.value}{number}" for number in (1, 2)] for side in Side}
PREFIX = key_prefix(MATCH)
HOST_KEYS = ("host/record_batch", "**", "host/**", "world", "robot/cyan1/sight", "game/state", "game/event")


@pytest.fixture(scope="module")
def host() -> Iterator[ZenohBus]:
    limits = router_limits(MATCH, [robot for robots in ROBOTS.values() for robot in robots])
    limits["access_control"] = open_access(MATCH, ROBOTS)
    with open_host(MATCH, WallClock(), "tcp/127.0.0.1:0", None, limits) as bus:
        bus.declare_alive(PresenceKind.HOST, "host")
        yield bus


def test_nobody_publishes_as_the_host(host: ZenohBus, mode: str) -> None:
    with open_client(MATCH, WallClock(), host.endpoint) as recorder, open_session(host.endpoint, mode) as session:
        batches, writer = recorder.subscribe(RECORD_BATCH), host.publisher(RECORD_BATCH)
        deadline, received = time.monotonic() + LIMIT, []
        while received.count(b"real") < 10 and time.monotonic() < deadline:
            for key in HOST_KEYS:
                session.put(PREFIX + key, b"false", attachment=STAMP.pack(10**6, 0, 0))
            writer.put_payload(b"real")
            received += [one.payload for one in iter(lambda: batches.receive(0.02), None)]
    assert set(received) == {b"real"}


def test_nobody_answers_in_place_of_the_host(host: ZenohBus, mode: str) -> None:
    with open_client(MATCH, WallClock(), host.endpoint) as viewer, open_session(host.endpoint, mode) as session:
        asked: list[object] = []
        held = [session.declare_queryable(PREFIX + key, asked.append) for key in ("host/setup", "host/**", "**")]
        with pytest.raises(NoReplyError):
            viewer.query(SETUP, SetupRequest(), 1.0).payload(2.0)
        assert asked == []
        assert held
