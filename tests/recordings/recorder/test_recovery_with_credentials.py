"""A recorder with its own credentials recovers batches that it has missed from a host that asks for credentials."""

import time

import pytest

from recordings.recorder.batch_reader import BatchReader
from schemas.access.accounts import Account
from schemas.access.credentials import account_file, new_credentials, write_credentials
from schemas.access.protection import Protection
from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import PresenceKind
from schemas.bus.zenoh.bus import open_client, open_host
from schemas.bus.zenoh.router_limits import router_limits
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topics import RECORD_BATCH

pytestmark = pytest.mark.timeout(120)

LIMIT = 60.0
LAST = 30
LOST = {5, 6, 11, LAST}
"""Numbers of the batches that do not arrive by themselves; the last is missed without any gap to be seen."""
ROBOTS = {side: [f"{side.value}1"] for side in Side}


class LosingBus:
    """The host's bus, which loses some of the batches that it publishes."""

    def __init__(self, bus):
        self._bus = bus

    def __getattr__(self, name):
        return getattr(self._bus, name)

    def publisher(self, topic, **chunks):
        writer = self._bus.publisher(topic, **chunks)
        return LosingWriter(writer) if topic is RECORD_BATCH else writer


class LosingWriter:
    """Publishes all but the lost ones."""

    def __init__(self, writer):
        self._writer, self._number = writer, -1

    def put_payload(self, payload):
        self._number += 1
        if self._number not in LOST:
            self._writer.put_payload(payload)


def test_a_recorder_gets_every_batch_in_order_though_some_were_lost(tmp_path):
    credentials, clock = new_credentials(), WallClock()
    write_credentials(tmp_path, credentials)
    protection, robots = (
        Protection.of(credentials, "taped", ROBOTS),
        [name for names in ROBOTS.values() for name in names],
    )
    limits = router_limits("taped", robots)
    with open_host("taped", clock, "tcp/127.0.0.1:0", protection, limits) as host:
        host.declare_alive(PresenceKind.HOST, "host")
        batches = BatchPublisher(LosingBus(host))
        file = account_file(tmp_path, Account.RECORDER)
        with open_client(None, clock, host.endpoint, LIMIT, file) as bus:
            reader, read, sent = BatchReader(bus, since_ns=0), [], 0
            deadline = time.monotonic() + LIMIT
            while (not read or read[-1] < LAST) and time.monotonic() < deadline:
                if sent <= LAST:
                    batches.send()
                    sent += 1
                batches.process()
                read += [batch.number for batch in reader.read()]
                time.sleep(0.005)
    assert read == list(range(LAST + 1))
    assert (reader.lost, reader.unreadable) == (0, 0)
