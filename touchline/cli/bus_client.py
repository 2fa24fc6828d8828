"""A client on the bus of a running match, for the duration of one command."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from schemas.access.accounts import Account
from schemas.bus.settings import ClientSettings

if TYPE_CHECKING:
    from schemas.bus.contract import Bus

PATIENCE = 3.0
"""Wall time to wait for a running host, s."""


@contextmanager
def bus_client(connection: ClientSettings, account: Account = Account.VIEWER) -> "Iterator[Bus]":
    """A client of a match, within the block; without `--credentials` with those of `account` of the running match.

    Raises:
        TouchlineError: no host answers, or it is not clear which match is meant.
    """
    from schemas.bus.zenoh.bus import open_client
    from schemas.process.clock import WallClock

    with open_client(
        connection.match, WallClock(), connection.connect, PATIENCE, connection.credentials, account
    ) as bus:
        yield bus
