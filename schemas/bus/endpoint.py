"""Endpoints in words: `tcp/HOST:PORT`, whether one stays on this machine, and a free port for `:0`."""

import ipaddress
import re
import socket
import sys

from schemas.bus.contract import BusError

DEFAULT_ENDPOINT = "tcp/127.0.0.1:7447"
"""Where a host listens and everyone else connects when nobody says otherwise: this machine alone."""


def parse_endpoint(endpoint: str) -> tuple[str, str, int]:
    """Protocol, host and port of an endpoint.

    Raises:
        BusError: it is not `PROTOCOL/HOST:PORT`.
    """
    found = re.fullmatch(r"(tcp|tls|quic|udp|ws)/(\[[^\]]+\]|[^:/\[\]]+):(\d{1,5})", endpoint)
    if found is None or int(found[3]) > 65_535:
        raise BusError(f'endpoint is "{endpoint}"; write it as tcp/127.0.0.1:7447')
    return found[1], found[2].strip("[]"), int(found[3])


def is_loopback(endpoint: str) -> bool:
    """Whether nothing outside this machine can reach the endpoint."""
    _, host, _ = parse_endpoint(endpoint)
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def local_endpoint(listen: str) -> str:
    """Where this machine reaches who listens there: on loopback where that is every address."""
    protocol, host, port = parse_endpoint(listen)
    here = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)
    return f"{protocol}/{here}:{port}"


def with_free_port(endpoint: str) -> str:
    """The endpoint itself, or with a free port where it says `:0`, which is then given to nobody else."""
    protocol, host, port = parse_endpoint(endpoint)
    if port:
        return endpoint
    free = reserve_port(host)
    return f"{protocol}/[{host}]:{free}" if ":" in host else f"{protocol}/{host}:{free}"


def reserve_port(host: str) -> int:
    """A free TCP port of this address, to be listened on by this process or by one that it launches.

    Between the choice and the listening, a second for a process that has to start, the system could give the port to
    somebody else. Linux does not while a socket is bound to it, and lets others listen on it all the same if both allow
    it, as Zenoh and the page's server do. That socket stays as long as this process.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as holder:
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind((host, 0))
        port = int(holder.getsockname()[1])
        if sys.platform == "linux":
            holder.detach()
    return port
