"""Endpoints as text, `tcp/HOST:PORT`: parsing, whether one is on loopback, and a free port for `:0`."""

import ipaddress
import re
import socket
import sys

from runtime.bus.contract import BusError
from runtime.process.timing import PROBE_S

DEFAULT_ENDPOINT = "tcp/127.0.0.1:7447"
"""The first choice of a host without `--listen`: on loopback, reachable only from this machine."""
FREE_ENDPOINT = "tcp/127.0.0.1:0"
"""Its second choice, where another process listens on the first: a free port."""
ENCRYPTED = ("tls", "quic")
"""Protocols whose listener needs a certificate."""
_CONNECTIONLESS = ("udp", "quic")


def parse_endpoint(endpoint: str) -> tuple[str, str, int]:
    """Protocol, host and port of an endpoint.

    Raises:
        BusError: the text is not `PROTOCOL/HOST:PORT`.
    """
    name = r"[^:/\[\].]{1,63}(?:\.[^:/\[\].]{1,63})*\.?"  # a longer or empty part is none that could be looked up
    found = re.fullmatch(rf"(tcp|tls|quic|udp|ws)/(\[[^\]]+\]|{name}):(\d{{1,5}})", endpoint)
    if found is None or int(found[3]) > 65_535:
        raise BusError(f'endpoint is "{endpoint}"; write it as tcp/127.0.0.1:7447')
    return found[1], found[2].strip("[]"), int(found[3])


def is_loopback(endpoint: str) -> bool:
    """Whether only this machine can reach the endpoint."""
    _, host, _ = parse_endpoint(endpoint)
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def is_cut_off(endpoint: str) -> bool:
    """Whether nothing answers at an endpoint: its machine is off, or the network to it is cut.

    False where it accepts a connection or refuses it, and for protocols without connections.
    """
    protocol, host, port = parse_endpoint(endpoint)
    if protocol in _CONNECTIONLESS:
        return False
    try:
        socket.create_connection((host, port), PROBE_S).close()
    except ConnectionError:
        return False
    except OSError:  # no answer, or no way to the machine
        return True
    return False


def local_endpoint(listen: str) -> str:
    """The endpoint at which this machine reaches a listener; on loopback for one that listens on every address."""
    protocol, host, port = parse_endpoint(listen)
    here = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)
    return f"{protocol}/{here}:{port}"


def with_tls(endpoint: str) -> str:
    """The endpoint with TLS: the same address and port.

    Raises:
        BusError: the protocol has no TLS.
    """
    protocol, _, _ = parse_endpoint(endpoint)
    if protocol not in ("tcp", *ENCRYPTED):
        raise BusError(f"{endpoint}: {protocol} has no TLS, which these credentials ask for; use tls/ or tcp/")
    return endpoint.replace("tcp/", "tls/", 1)


def with_free_port(endpoint: str) -> str:
    """The endpoint, with a reserved free port in place of `:0`.

    Raises:
        BusError: the protocol uses UDP, whose ports cannot be reserved for a listener.
        OSError: the address is none of this machine.
    """
    protocol, host, port = parse_endpoint(endpoint)
    if port:
        return endpoint
    if protocol in _CONNECTIONLESS:
        raise BusError(f"--listen {endpoint}: {protocol} has no free port to take; name a port, or use tcp")
    return f"{protocol}/{f'[{host}]' if ':' in host else host}:{reserve_port(host)}"


def reserve_port(host: str) -> int:
    """A free TCP port of this address, for this process or one that it launches.

    A process takes about a second until it listens, and meanwhile the system could assign the port to another. On Linux
    a bound socket prevents that, and does not prevent listening where both sockets set `SO_REUSEADDR`, as Zenoh and the
    page's server do. The socket stays bound until this process ends.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as holder:
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind((host, 0))
        port = int(holder.getsockname()[1])
        if sys.platform == "linux":
            holder.detach()
    return port
