"""A client on the bus of a running match, for the duration of one command."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from schemas.bus.contract import Bus

PATIENCE = 3.0
"""Wall time to wait for a running host, s."""


@contextmanager
def bus_client(connect: str, match: str) -> "Iterator[Bus]":
    """A client of the match at an endpoint, within the block.

    Raises:
        TouchlineError: no host answers there.
    """
    from schemas.bus.zenoh.bus import open_client
    from schemas.process.clock import WallClock

    with open_client(match, WallClock(), connect, PATIENCE) as bus:
        yield bus
