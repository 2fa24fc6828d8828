"""A client on the bus of a running match, for the duration of one command."""

from runtime.access.accounts import Account
from runtime.bus.contract import Bus
from runtime.bus.settings import ClientSettings
from runtime.process.clock import WallClock
from runtime.process.timing import REQUEST_S


def bus_client(connection: ClientSettings, account: Account = Account.VIEWER) -> Bus:
    """A client of a match, to be closed; without `--credentials` with those of `account` of the running match.

    Raises:
        TouchlineError: no host answers, or it is not clear which match is meant.
    """
    from runtime.bus.zenoh.bus import open_client

    return open_client(connection.match, WallClock(), connection.connect, REQUEST_S, connection.credentials, account)
