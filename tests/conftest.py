"""The process of the tests plays hosts and clients by turns, and takes a host's threads for both."""

from schemas.bus.endpoint import with_port
from schemas.bus.zenoh_bus import open_host
from schemas.clock import WallClock


def pytest_configure() -> None:
    """Zenoh chooses its threads when the first session of a process is opened."""
    open_host("first", WallClock(), with_port("tcp/127.0.0.1:0")).close()
