"""The whole examination: this machine, the way to a host, and the host; each step needs the one before."""

from collections.abc import Iterator

from runtime.access.accounts import Account
from runtime.access.credentials import Credentials, read_credentials
from runtime.bus.announcement import running_hosts
from runtime.bus.endpoint import with_tls
from runtime.bus.find_host import find_host
from runtime.bus.settings import ClientSettings
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import Clock
from runtime.process.timing import REQUEST_S
from schemas.errors import TouchlineError
from touchline.commands.diagnosis.doctor.finding import Finding, Status
from touchline.commands.diagnosis.doctor.link import examine_link
from touchline.commands.diagnosis.doctor.machine import MachineFacts, examine_machine
from touchline.commands.diagnosis.doctor.route import examine_route


def examine(connection: ClientSettings, clock: Clock, facts: MachineFacts) -> Iterator[Finding]:
    """All findings; without an endpoint, of the running match of this machine, if there is one."""
    yield from examine_machine(facts)
    try:
        known = read_credentials(connection.credentials) if connection.credentials is not None else None
    except TouchlineError as error:
        yield _failed("credentials", error)
        return
    connect = connection.connect or (known.connect if known is not None else None)
    if connect is None and not running_hosts():
        yield Finding("match", Status.NOTE, "no match of yours runs on this machine", "--connect examines another host")
        return
    try:
        address = find_host(connection.match, connect)
        known = known or address.credentials_of(Account.VIEWER)
    except TouchlineError as error:
        yield _failed("match", error)
        return
    yield from _examine_host(connection, address.endpoint, known, clock)


def _examine_host(
    connection: ClientSettings, connect: str, known: Credentials | None, clock: Clock
) -> Iterator[Finding]:
    root = known.root_certificate if known is not None else None
    endpoint = with_tls(connect) if root is not None else connect
    for finding in examine_route(endpoint, root, clock.unix_ns() * 1e-9):
        yield finding
        if finding.status is Status.FAILED:
            return
    try:
        bus = open_client(connection.match, clock, endpoint, REQUEST_S, connection.credentials, account=Account.VIEWER)
    except TouchlineError as error:
        yield _failed("host", error)
        return
    with bus:
        who = f'accepted as "{known.user.value}"' if known is not None else "not needed: the host admits everybody"
        yield Finding("credentials", Status.OK, who)
        yield from examine_link(bus)


def _failed(name: str, error: TouchlineError) -> Finding:
    """The finding of an error, whose line ends with its remedy."""
    text, _, remedy = str(error).partition("; ")
    return Finding(name, Status.FAILED, text, remedy.split(":\n")[0])
