"""What this project did not write: MCAP files by mcap's own writer, and a session of Zenoh as anybody opens it."""

import json
import socket
from collections.abc import Iterable
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import zenoh
from mcap.writer import CompressionType, Writer

START_NS = 1_700_000_000_000_000_000
LIMIT = 30.0
"""Seconds after which something that should have happened will not."""


def write_mcap(
    path: Path,
    messages: Iterable[tuple[str, int, bytes]],
    *,
    encoding: str = "json",
    schema: tuple[str, str, bytes] | None = ("any", "jsonschema", b'{"type":"object"}'),
    start_ns: int = START_NS,
    **options: Any,
) -> Path:
    """Topic, time in ms since the start, and payload of each message; `schema` is its name, encoding and data."""
    with path.open("wb") as file:
        writer = Writer(file, **{"compression": CompressionType.LZ4, **options})
        writer.start(profile="somebody", library="else")
        number = writer.register_schema(*schema) if schema is not None else 0
        channels: dict[str, int] = {}
        for count, (topic, ms, payload) in enumerate(messages):
            if topic not in channels:
                channels[topic] = writer.register_channel(topic, encoding, number, {"by": "them"})
            log_ns = start_ns + ms * 1_000_000
            writer.add_message(channels[topic], log_ns, payload, log_ns, count)
        writer.finish()
    return path


def drive(count: int = 50, robot: str = "robot1", step: int = 10) -> list[tuple[str, int, bytes]]:
    """JSON of a robot that drives, one message in `step` ms."""
    return [(f"/{robot}/odom", step * at, json.dumps({"x": 0.1 * at}).encode()) for at in range(count)]


class Network:
    """A router of Zenoh that is none of a match, with a subscriber to all keys."""

    def __init__(self, endpoint: str | None = None, mode: str = "router") -> None:
        """Listen on a free port, or connect to `endpoint`."""
        config = zenoh.Config()
        if endpoint is None:
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                self.endpoint = f"tcp/127.0.0.1:{free.getsockname()[1]}"
        else:
            self.endpoint = endpoint
        where = "listen" if endpoint is None else "connect"
        settings = {"mode": mode, f"{where}/endpoints": [self.endpoint], "scouting/multicast/enabled": False}
        for name, value in settings.items():
            config.insert_json5(name, json.dumps(value))
        self.session = zenoh.open(config)
        self._subscriber = self.session.declare_subscriber("**", zenoh.handlers.FifoChannel(500_000))

    def received(self, count: int) -> list[zenoh.Sample]:
        """The next samples; fewer when no more come."""
        found: list[zenoh.Sample] = []
        deadline = monotonic() + LIMIT
        while len(found) < count and monotonic() < deadline:
            sample = self._subscriber.try_recv()
            if sample is None:
                sleep(0.002)
            else:
                found.append(sample)
        return found

    def wait_for_subscriber(self, key: str) -> None:
        """Until another session subscribes to this key."""
        probe = self.session.declare_publisher(key, allowed_destination=zenoh.Locality.REMOTE)
        deadline = monotonic() + LIMIT
        while not probe.matching_status.matching and monotonic() < deadline:
            sleep(0.002)

    def close(self) -> None:
        self.session.close()
