"""The TCP connections that are open in this process, whichever library holds them: what each received, and its end.

Linux reports both. Elsewhere no connection is found.
"""

import os
import socket
import struct
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from ipaddress import IPv6Address, ip_address
from pathlib import Path

Peer = tuple[str, int]
"""Address and port of the other end."""
_DESCRIPTORS = Path("/proc/self/fd")
_INFO_SIZE = 256
_RECEIVED = struct.Struct("<128xQ")
"""The field `tcpi_bytes_received` of Linux's `tcp_info`."""
_LINGER = struct.Struct("ii")
"""Linux's `linger`: whether closing waits for data that was not sent, and for how many seconds."""
_DISCARD = _LINGER.pack(1, 0)
"""The end of the connection discards data that was not sent, so that nothing waits for a peer that does not read."""
_IN_BACKGROUND = _LINGER.pack(0, 0)
"""Closing returns at once; the system sends what was not sent."""


def plain_address(address: str) -> str:
    """An address in one form: an IPv4 address that is written as IPv6 is the IPv4 address; without an interface."""
    try:
        parsed = ip_address(address.partition("%")[0])
    except ValueError:
        return address
    mapped = parsed.ipv4_mapped if isinstance(parsed, IPv6Address) else None
    return str(mapped or parsed)


def received_bytes() -> dict[Peer, int]:
    """Peer → bytes received from it since its connection was opened.

    Other threads close connections at any moment: one that is closed meanwhile is left out.
    """
    received = {}
    for descriptor in _open_sockets():
        with _borrowed(descriptor) as connection, suppress(OSError):
            if connection is not None and (peer := _peer(connection)) is not None:
                info = connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, _INFO_SIZE)
                received[peer] = _RECEIVED.unpack_from(info)[0]
    return received


def close_connection(peer: Peer) -> bool:
    """End the connection to a peer at once, in both directions; returns whether there was one."""
    for descriptor in _open_sockets():
        with _borrowed(descriptor) as connection:
            is_wanted = connection is not None and _peer(connection) == peer
        if is_wanted and _end(descriptor, peer):
            return True
    return False


def close_in_background(peer: Peer) -> bool:
    """Let nobody wait who closes the connection to a peer; returns whether there is one."""
    for descriptor in _open_sockets():
        with _borrowed(descriptor) as connection, suppress(OSError):
            if connection is not None and _peer(connection) == peer:
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _IN_BACKGROUND)
                return True
    return False


def duplicate(descriptor: int) -> socket.socket:
    """A socket with a descriptor of its own for the same connection.

    Raises:
        OSError: the descriptor is closed, or no socket's; nothing stays open.
    """
    copy = os.dup(descriptor)
    try:
        return socket.socket(fileno=copy)
    except OSError:
        os.close(copy)
        raise


def _end(descriptor: int, peer: Peer) -> bool:
    """End the connection, unless its descriptor has meanwhile become that of another one."""
    try:
        with duplicate(descriptor) as connection:
            if _peer(connection) != peer:
                return False
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _DISCARD)
            connection.shutdown(socket.SHUT_RDWR)
    except OSError:
        return False  # the other end has closed it
    return True


def _open_sockets() -> Iterator[int]:
    """The descriptors that are sockets; none where the list cannot be read, as without a free descriptor."""
    if not hasattr(socket, "TCP_INFO"):
        return
    try:
        entries = list(_DESCRIPTORS.iterdir())
    except OSError:
        return
    for entry in entries:
        try:
            target = str(entry.readlink())
        except OSError:
            continue  # closed meanwhile
        if target.startswith("socket:"):
            yield int(entry.name)


@contextmanager
def _borrowed(descriptor: int) -> Iterator[socket.socket | None]:
    """A socket object of a descriptor that stays open and another's; None where it has been closed."""
    try:
        connection = socket.socket(fileno=descriptor)
    except OSError:
        yield None
        return
    try:
        yield connection
    finally:
        connection.detach()


def _peer(connection: socket.socket) -> Peer | None:
    """The other end; None where this is no TCP connection, or an ended one."""
    if connection.family not in (socket.AF_INET, socket.AF_INET6) or connection.type != socket.SOCK_STREAM:
        return None
    try:
        address, port = connection.getpeername()[:2]
    except OSError:
        return None
    return plain_address(address), port
