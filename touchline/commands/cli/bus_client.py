"""A client on the bus of a running match, for the duration of one command."""

from typing import Any

from coach_gateway.match.host_client import HostClient
from runtime.access.accounts import Account
from runtime.bus.contract import Bus
from runtime.bus.settings import ClientSettings
from runtime.process.clock import WallClock
from runtime.process.timing import REQUEST_S
from schemas.errors import MatchFailedError
from schemas.topic import Topic
from schemas.wire.message import Message


def bus_client(connection: ClientSettings, account: Account = Account.VIEWER) -> Bus:
    """A client of a match, to be closed; without `--credentials` with those of `account` of the running match.

    Raises:
        TouchlineError: no host answers, or it is not clear which match is meant.
    """
    from runtime.bus.zenoh.bus import open_client

    return open_client(connection.match, WallClock(), connection.connect, REQUEST_S, connection.credentials, account)


def ask_host(connection: ClientSettings, topic: Topic, request: Message, account: Account = Account.OPERATOR) -> Any:
    """The reply of the host of a running match, which has accepted the request.

    Raises:
        MatchFailedError: it was refused.
        TouchlineError: no host answers, or it is not clear which match is meant.
    """
    with bus_client(connection, account) as bus:
        reply = HostClient(bus).ask(topic, request)
    if not reply.accepted:
        raise MatchFailedError(f"refused: {reply.reason}")
    return reply
