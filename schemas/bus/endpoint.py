"""Endpoints in words: `tcp/HOST:PORT`, whether one stays on this machine, and a free port for `:0`."""

import ipaddress
import re
import socket

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


def near(listen: str) -> str:
    """Where this machine reaches who listens there: on loopback where that is every address."""
    protocol, host, port = parse_endpoint(listen)
    here = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)
    return f"{protocol}/{here}:{port}"


def with_port(endpoint: str) -> str:
    """The endpoint itself, or with a port that is free just now where it says `:0`."""
    protocol, host, port = parse_endpoint(endpoint)
    if port:
        return endpoint
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as probe:
        probe.bind((host, 0))
        free = probe.getsockname()[1]
    return f"{protocol}/[{host}]:{free}" if family == socket.AF_INET6 else f"{protocol}/{host}:{free}"
