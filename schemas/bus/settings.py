"""Settings of a process for the bus: the endpoint and the match to connect to, or the endpoint to listen on."""

import re
from typing import Annotated

from pydantic import AfterValidator

from schemas.bus.contract import BusError
from schemas.bus.endpoint import DEFAULT_ENDPOINT, parse_endpoint
from schemas.config.settings import CommandLine, Settings


def _endpoint(endpoint: str) -> str:
    try:
        parse_endpoint(endpoint)
    except BusError:
        raise ValueError(f"write it as {DEFAULT_ENDPOINT}") from None
    return endpoint


def match_name(name: str) -> str:
    """The name of a match, unchanged.

    Raises:
        ValueError: the name is not a key chunk.
    """
    if re.fullmatch(r"[a-z][a-z0-9_]{0,31}", name) is None:
        raise ValueError("a match name is a key chunk: lower-case letters, digits and _")
    return name


Endpoint = Annotated[str, AfterValidator(_endpoint)]
"""`PROTOCOL/HOST:PORT` on the bus."""
MatchName = Annotated[str, AfterValidator(match_name)]
"""Name of a match, a key chunk."""


class ClientSettings(Settings):
    """Settings of a process that joins a match."""

    connect: Annotated[Endpoint | None, CommandLine(environment="TOUCHLINE_CONNECT")] = None
    """Endpoint of the host; by default that of the running match on this machine."""
    match: Annotated[MatchName | None, CommandLine(environment="TOUCHLINE_MATCH")] = None
    """Name of the match; by default the match that the host plays."""


class ListenSettings(Settings):
    """Settings of a process that listens for the others of its match."""

    listen: Endpoint | None = None
    """Endpoint of the host; port 0 takes a free one. By default tcp/127.0.0.1:7447, or a free port if it is in use."""
    insecure: bool = False
    """Accept connections of other machines, without authentication."""
