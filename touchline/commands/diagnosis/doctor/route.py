"""Examines the way to an endpoint below the bus: name, port, path MTU and certificate."""

import socket
import ssl
from collections.abc import Iterator
from contextlib import closing

from runtime.bus.endpoint import ENCRYPTED, parse_endpoint
from runtime.process.timing import REQUEST_S
from touchline.commands.diagnosis.doctor.finding import Finding, Status

_STREAMS = ("tcp", "tls", "ws")
_IP_MTU, _IPV6_MTU = 14, 24
"""Linux's numbers of the socket options with the path MTU of a connection."""
_SMALLEST_MTU = 1280
"""Bytes that every network of IPv6 carries; a smaller one is a tunnel in a tunnel, or wrongly set."""
_SOON_S = 7 * 86_400
"""A certificate that expires within this wall time is reported, in s."""


def examine_route(endpoint: str, root: str | None, now_s: float) -> Iterator[Finding]:
    """The findings on name, port, MTU and certificate, up to the first that fails.

    Args:
        endpoint: where the host is said to be.
        root: root certificate of the host, PEM; None without one.
        now_s: wall time in s since 1970.
    """
    protocol, host, port = parse_endpoint(endpoint)
    try:
        addresses = list(dict.fromkeys(found[4][0] for found in socket.getaddrinfo(host, port)))
    except OSError as error:
        yield Finding(
            "name",
            Status.FAILED,
            f"{host} has no address ({_reason(error)})",
            "check the spelling, or write the address of the host: tcp/192.168.1.5:7447",
        )
        return
    yield Finding("name", Status.OK, f"{host} is {', '.join(map(str, addresses))}")
    if protocol not in _STREAMS:
        yield Finding("port", Status.NOTE, f"{protocol} has no connection that could be examined before the handshake")
        return
    try:
        link = socket.create_connection((host, port), timeout=REQUEST_S)
    except OSError as error:
        yield _unreachable(host, port, error)
        return
    with closing(link):
        yield Finding("port", Status.OK, f"port {port} of {host} accepts connections")
        yield from _mtu(link)
        if protocol in ENCRYPTED:
            yield _certificate(link, host, root, now_s)


def _unreachable(host: str, port: int, error: OSError) -> Finding:
    if isinstance(error, ConnectionRefusedError):
        return Finding(
            "port",
            Status.FAILED,
            f"nothing listens on port {port} of {host}",
            "start the host (`touchline host`); its first line has its endpoint; on other machines than its own it "
            "must listen on an address of the network: --listen tcp/[::]:7447",
        )
    if isinstance(error, TimeoutError):
        return Finding(
            "port",
            Status.FAILED,
            f"port {port} of {host} does not answer within {REQUEST_S:g} s",
            "is the machine on, in the same network? A firewall on the way must let this port through",
        )
    return Finding(
        "port", Status.FAILED, f"port {port} of {host} cannot be reached ({_reason(error)})", "check cable and route"
    )


def _mtu(link: socket.socket) -> Iterator[Finding]:
    level, option = (socket.IPPROTO_IPV6, _IPV6_MTU) if link.family == socket.AF_INET6 else (socket.IPPROTO_IP, _IP_MTU)
    try:
        mtu = link.getsockopt(level, option)
    except OSError:
        return  # not every system has this option
    if mtu < _SMALLEST_MTU:
        remedy = "set the MTU of the interface to 1500, or that of the tunnel to 1280 or more"
        yield Finding("mtu", Status.WARNING, f"packets on this way have at most {mtu} bytes", remedy)
    else:
        yield Finding("mtu", Status.OK, f"packets on this way have at most {mtu} bytes")


def _certificate(link: socket.socket, host: str, root: str | None, now_s: float) -> Finding:
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    if root is not None:
        context.load_verify_locations(cadata=root)
    try:
        with context.wrap_socket(link, server_hostname=host) as encrypted:
            shown = encrypted.getpeercert() or {}
    except ssl.SSLCertVerificationError as error:
        remedy = (
            f"`touchline credentials new --tls --host-name {host}` makes another; all clients need the new files"
            if root is not None
            else "add --credentials FILE with the root certificate of the host"
        )
        return Finding("certificate", Status.FAILED, f"not valid for {host}: {error.verify_message}", remedy)
    except OSError as error:
        return Finding(
            "certificate",
            Status.FAILED,
            f"no TLS handshake ({_reason(error)})",
            "does the host listen with TLS? Otherwise connect to tcp/",
        )
    return _valid_certificate(shown, now_s)


def _valid_certificate(shown: object, now_s: float) -> Finding:
    content = shown if isinstance(shown, dict) else {}
    names = ", ".join(str(value) for _, value in content.get("subjectAltName", ()))
    expiry = str(content.get("notAfter", ""))
    text = f"valid, for {names}, expires {expiry}"
    if expiry and ssl.cert_time_to_seconds(expiry) - now_s < _SOON_S:
        return Finding("certificate", Status.WARNING, text, "`touchline credentials new --tls` makes another")
    return Finding("certificate", Status.OK, text)


def _reason(error: OSError) -> str:
    return error.strerror or str(error) or type(error).__name__
