"""Why a host refuses a client: password, certificate, TLS or none, or no room. One line each, within two seconds."""

import socket
import ssl
from collections.abc import Callable

from schemas.access.credentials import Credentials
from schemas.bus.endpoint import parse_endpoint
from schemas.bus.zenoh.handshake_tap import HandshakeTap, close_reason, has_opened, is_zenoh

_CONNECT_S = 0.4
"""Wall time for a connection or a TLS handshake. A host that takes longer is reported as missing, not as refusing."""
_NO_ROOM = 2
"""Zenoh's reason of a host that has as many connections as it allows."""
_TLS_ALERT = 0x15
"""First byte with which a server of TLS replies to anything else."""
_EXPIRED, _WRONG_NAMES = (10,), (62, 63, 64)
"""Codes of OpenSSL for a certificate that cannot be verified; other codes mean an unknown authority."""
_NEW = "`touchline credentials new --tls` makes another"

Open = Callable[[str], bool]
"""Tries once to open a session at an endpoint; returns whether the host has accepted it."""


def refusal_at(connect: str, credentials: Credentials | None, try_open: Open) -> str | None:
    """Why the host at the endpoint refuses this client; None where no host answers, or it answers too late to know.

    `try_open` uses the credentials of the client.
    """
    protocol, host, port = parse_endpoint(connect)
    if protocol not in ("tcp", "tls"):
        return None
    try:
        link = socket.create_connection((host, port), timeout=_CONNECT_S)
    except OSError:
        return None
    if protocol == "tls":
        root = credentials.root_certificate if credentials is not None else None
        try:
            link = _context(root).wrap_socket(link, server_hostname=host)
        except ssl.SSLCertVerificationError as error:
            link.close()
            return _certificate_fault(connect, host, error, is_known=root is not None)
        except OSError:
            link.close()
            return _plain_refusal(connect, host, port, try_open)
    return _handshake_refusal(connect, credentials, link, try_open)


def _handshake_refusal(
    connect: str, credentials: Credentials | None, link: socket.socket, try_open: Open
) -> str | None:
    with HandshakeTap(link) as tap:
        if try_open(tap.endpoint):
            return None
    sent, answer = bytes(tap.from_client), bytes(tap.from_host)
    if answer[:1] == bytes([_TLS_ALERT]):
        return f"the host at {connect} speaks TLS; add --credentials FILE with its root certificate"
    if not is_zenoh(answer):
        return None
    if close_reason(answer) == _NO_ROOM:
        return f"the host at {connect} has as many connections as it allows; try again when a client has left"
    if close_reason(answer) is not None and credentials is None:
        return (
            f"the host at {connect} admits only clients with credentials; "
            "add --credentials FILE, or set TOUCHLINE_CREDENTIALS"
        )
    if close_reason(answer) is not None and has_opened(sent):
        assert credentials is not None
        return (
            f'user or password refused by the host at {connect} (user "{credentials.user.value}"); '
            "the file of --credentials must be of the host's own set"
        )
    if credentials is not None and close_reason(sent) is not None:
        return f"the host at {connect} is open, without credentials; leave --credentials out to join it all the same"
    return None


def _plain_refusal(connect: str, host: str, port: int, try_open: Open) -> str | None:
    """What is wrong with a host that does not complete a TLS handshake."""
    try:
        link = socket.create_connection((host, port), timeout=_CONNECT_S)
    except OSError:
        return None
    with HandshakeTap(link) as tap:
        try_open(tap.endpoint)
    if not is_zenoh(bytes(tap.from_host)):
        return None
    return f"the host at {connect} speaks no TLS; connect to tcp/, with credentials made without --tls"


def _context(root: str | None) -> ssl.SSLContext:
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    if root is not None:
        context.load_verify_locations(cadata=root)
    return context


def _certificate_fault(connect: str, host: str, error: ssl.SSLCertVerificationError, *, is_known: bool) -> str:
    start = f"the certificate of the host at {connect}"
    if error.verify_code in _EXPIRED:
        return f"{start} has expired; {_NEW}"
    if error.verify_code in _WRONG_NAMES:
        return f"{start} is not for {host}; {_NEW} with --host-name {host}"
    if not is_known:
        return f"{start} is of an unknown authority; add --credentials FILE with its root certificate"
    return f"{start} is of another authority than that of --credentials; the file must be of the host's own set"
