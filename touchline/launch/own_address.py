"""The address at which other machines reach this one, for commands that people type there."""

import socket
import struct
from contextlib import suppress

from runtime.bus.endpoint import parse_endpoint

_ELSEWHERE = ("192.0.2.1", 9)
"""An address of no machine, reserved for documents. A UDP socket that is connected to it sends nothing."""
_SIOCGIFADDR = 0x8915
_ANY = ("0.0.0.0", "::")


def endpoint_for_others(listen: str) -> str:
    """The endpoint at which other machines reach a listener of this machine."""
    protocol, host, port = parse_endpoint(listen)
    if host in _ANY:
        host = own_address()
    return f"{protocol}/[{host}]:{port}" if ":" in host else f"{protocol}/{host}:{port}"


def names_for_others(listen: str) -> tuple[str, ...]:
    """The address and the name by which other machines connect to a listener of this machine, for its certificate."""
    return tuple(dict.fromkeys((parse_endpoint(endpoint_for_others(listen))[1], socket.gethostname())))


def own_address() -> str:
    """The address on the way to other networks; without such a way that of the first interface, or the host name."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        with suppress(OSError):
            probe.connect(_ELSEWHERE)
            return str(probe.getsockname()[0])
        for _, interface in socket.if_nameindex():
            with suppress(OSError):
                address = _address_of(probe, interface)
                if not address.startswith("127."):
                    return address
    return socket.gethostname()


def _address_of(probe: socket.socket, interface: str) -> str:
    """The IPv4 address of an interface (netdevice(7)).

    Raises:
        OSError: it has none.
    """
    import fcntl  # not on every system that imports the launcher

    answer = fcntl.ioctl(probe.fileno(), _SIOCGIFADDR, struct.pack("256s", interface.encode()[:15]))
    return socket.inet_ntoa(answer[20:24])
