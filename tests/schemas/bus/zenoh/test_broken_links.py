"""A link that breaks, for record batches also while what was missed is fetched: over real sockets."""

import select
import socket
import threading
import time
from collections.abc import Callable, Iterator

import pytest

from recordings.recorder.batch_reader import BatchReader
from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import Bus, ReceivedMessage, Subscription
from schemas.bus.endpoint import parse_endpoint, with_free_port
from schemas.bus.zenoh.bus import open_client, open_host
from schemas.process.clock import WallClock
from schemas.topics import COMMAND, STATE

LIMIT = 60.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
_AT_ONCE = 65_536


class Cable:
    """Lies between clients and a host: carries their bytes one client at a time, and can be cut."""

    def __init__(self, endpoint: str) -> None:
        self._host = parse_endpoint(endpoint)[1:]
        self._server = socket.create_server(("127.0.0.1", 0))
        self.endpoint = f"tcp/127.0.0.1:{self._server.getsockname()[1]}"
        self.whole = True
        self.left: int | None = None
        """Bytes that are still carried to the client; then the link breaks, once."""
        self.links = 0
        self._closed = False
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self.whole, self._closed = False, True
        self._thread.join()
        self._server.close()

    def _run(self) -> None:
        while not self._closed:
            if not select.select([self._server], [], [], 0.02)[0]:
                continue
            near, _ = self._server.accept()
            with near:
                if self.whole:
                    with socket.create_connection(self._host) as far:
                        self.links += 1
                        self._carry(near, far)

    def _carry(self, near: socket.socket, far: socket.socket) -> None:
        """Until it is cut, or one of the two leaves."""
        while self.whole:
            for end in select.select([near, far], [], [], 0.02)[0]:
                try:
                    content = end.recv(_AT_ONCE)
                    if end is near:
                        far.sendall(content)
                    elif self.left is None or len(content) <= self.left:
                        self.left = None if self.left is None else self.left - len(content)
                        near.sendall(content)
                    else:
                        near.sendall(content[: self.left])
                        self.left, content = None, b""
                except OSError:
                    return
                if not content:
                    return


@pytest.fixture
def ends() -> Iterator[tuple[Bus, Cable]]:
    """A host, and the cable that leads to it."""
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("test", WallClock(), endpoint) as host:
        cable = Cable(endpoint)
        yield host, cable
        cable.close()


def wait_until(true: Callable[[], bool]) -> None:
    deadline = time.monotonic() + LIMIT
    while not true():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def hear(reader: Subscription, count: int, limit: float = LIMIT) -> list[int]:
    """The numbers of the next messages, as they come."""
    numbers: list[int] = []
    deadline = time.monotonic() + limit
    while len(numbers) < count and time.monotonic() < deadline:
        received = reader.receive(limit)
        if received is not None and received.stamp is not None:
            numbers.append(received.stamp.sequence)
    return numbers


def test_what_was_missed_while_the_link_was_down_arrives_in_order_when_it_is_back(ends: tuple[Bus, Cable]) -> None:
    host, cable = ends
    with open_client("test", WallClock(), cable.endpoint, patience=LIMIT) as client:
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
        cable.whole = False
        wait_until(lambda: not client.connected())
        for _ in range(100):
            say(1000)
        cable.whole = True
        wait_until(client.connected)
        say(2)  # its reader detects the gap
        heard += hear(reader, said - 1 - heard[0])
    assert heard == list(range(heard[0], said))


def test_a_recorder_has_all_batches_though_the_link_breaks_again_while_they_are_fetched(
    ends: tuple[Bus, Cable],
) -> None:
    host, cable = ends
    batches, filler = BatchPublisher(host), b" " * 2000
    with open_client("test", WallClock(), cable.endpoint, patience=LIMIT) as client:
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

        wait_until(has_some)
        wait_until(look)
        cable.whole = False
        wait_until(lambda: not client.connected())
        publish(250)
        cable.left, cable.whole = 60_000, True
        while cable.left is not None:
            publish(1)  # until the link has broken once more
            look()
            time.sleep(0.05)
        wait_until(look)
    assert cable.links >= 3
    assert found == list(range(published))
    assert reader.lost == 0
