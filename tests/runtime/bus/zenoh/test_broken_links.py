"""A link that breaks, for record batches also while what was missed is fetched: over real sockets."""

import time
from collections.abc import Iterator

import pytest

from recordings.recorder.batch_reader import BatchReader
from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, ReceivedMessage, Subscription
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_client, open_host
from runtime.process.clock import WallClock
from schemas.topics import COMMAND, STATE
from support.process_story import wait_for
from support.tunnel import Tunnel

LIMIT = 60.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""


@pytest.fixture
def ends() -> Iterator[tuple[Bus, Tunnel]]:
    """A host, and the cable that leads to it."""
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("test", WallClock(), endpoint) as host:
        cable = Tunnel(int(endpoint.rpartition(":")[2]))
        yield host, cable
        cable.close()


def hear(reader: Subscription, count: int, limit: float = LIMIT) -> list[int]:
    """The numbers of the next messages, as they come."""
    numbers: list[int] = []
    deadline = time.monotonic() + limit
    while len(numbers) < count and time.monotonic() < deadline:
        received = reader.receive(limit)
        if received is not None and received.stamp is not None:
            numbers.append(received.stamp.sequence)
    return numbers


def test_what_was_missed_while_the_link_was_down_arrives_in_order_when_it_is_back(ends: tuple[Bus, Tunnel]) -> None:
    host, cable = ends
    with open_client("test", WallClock(), f"tcp/127.0.0.1:{cable.port}", patience=LIMIT) as client:
        reader, writer = client.subscribe(STATE), host.publisher(STATE)
        said = 0
        heard: list[int] = []

        def say(size: int) -> None:
            nonlocal said
            writer.put_payload(b" " * size)
            said += 1

        while not heard:
            say(2)
            heard = hear(reader, 1, limit=0.1)
        cable.cut()
        wait_for(lambda: not client.connected())
        for _ in range(100):
            say(1000)
        cable.is_cut = False
        wait_for(client.connected)
        say(2)  # its reader detects the gap
        heard += hear(reader, said - 1 - heard[0])
    assert heard == list(range(heard[0], said))


def test_a_recorder_has_all_batches_though_the_link_breaks_again_while_they_are_fetched(
    ends: tuple[Bus, Tunnel],
) -> None:
    host, cable = ends
    batches, filler = BatchPublisher(host), b" " * 2000
    with open_client("test", WallClock(), f"tcp/127.0.0.1:{cable.port}", patience=LIMIT) as client:
        reader = BatchReader(client)
        published = 0
        found: list[int] = []

        def publish(count: int) -> None:
            nonlocal published
            for _ in range(count):
                batches.add_received(ReceivedMessage(COMMAND, "robot/cyan1/command", filler, None))
                batches.send()
                published += 1

        def look() -> bool:
            batches.process()
            found.extend(batch.number for batch in reader.read())
            return len(found) == published

        def has_some() -> bool:
            publish(1)
            return look() or bool(found)

        wait_for(has_some)
        wait_for(look)
        cable.cut()
        wait_for(lambda: not client.connected())
        publish(250)
        cable.left, cable.is_cut = 60_000, False
        while cable.left is not None:
            publish(1)  # until the link has broken once more
            look()
            time.sleep(0.05)
        wait_for(look)
    assert cable.count >= 3
    assert found == list(range(published))
    assert reader.lost == 0
