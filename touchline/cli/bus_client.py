"""A client on the bus of a running match, for the duration of one command."""

from collections.abc import Iterator
from contextlib import contextmanager

from schemas.access.accounts import Account
from schemas.bus.contract import Bus
from schemas.bus.settings import ClientSettings
from schemas.process.clock import WallClock
from touchline.timing import HOST_S


@contextmanager
def bus_client(connection: ClientSettings, account: Account = Account.VIEWER) -> Iterator[Bus]:
    """A client of a match, within the block; without `--credentials` with those of `account` of the running match.

    Raises:
        TouchlineError: no host answers, or it is not clear which match is meant.
    """
    from schemas.bus.zenoh.bus import open_client

    with open_client(connection.match, WallClock(), connection.connect, HOST_S, connection.credentials, account) as bus:
        yield bus
