"""Settings of a process for the bus: the endpoint and the match to connect to, or the endpoint to listen on."""

import re
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator

from runtime.bus.contract import BusError
from runtime.bus.endpoint import DEFAULT_ENDPOINT, ENCRYPTED, is_loopback, parse_endpoint
from schemas.config.settings import CommandLine, Settings
from schemas.errors import TouchlineError


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
    """Endpoint of the host; by default the running match on this machine."""
    match: Annotated[MatchName | None, CommandLine(environment="TOUCHLINE_MATCH")] = None
    """Name of the match; by default the match that the host plays."""
    credentials: Annotated[Path | None, CommandLine(environment="TOUCHLINE_CREDENTIALS")] = None
    """File of the account to join with; by default the file of the running match on this machine."""


class ListenSettings(Settings):
    """Settings of a process that listens for the others of its match."""

    listen: Endpoint | None = None
    """Endpoint of the host; port 0 takes a free one. By default tcp/127.0.0.1:7447, or a free port if it is in use."""
    credentials: Path | None = None
    """File of the host, host.json, of `touchline credentials new`: only clients with its accounts may join."""
    insecure: bool = False
    """Admit everybody without credentials, also from other machines."""


def check_protected(settings: ListenSettings) -> None:
    """Check that others can reach the endpoint only if they need credentials, or if that is wanted.

    Raises:
        TouchlineError: open to other machines without credentials and without `--insecure`, or TLS without credentials.
    """
    listen = settings.listen
    if listen is None or settings.credentials is not None:
        return
    if parse_endpoint(listen)[0] in ENCRYPTED:
        raise TouchlineError(
            f"--listen {listen} needs a certificate; make one with `touchline credentials new --tls`, and add "
            "--credentials credentials/host.json"
        )
    if not settings.insecure and not is_loopback(listen):
        raise TouchlineError(
            f"--listen {listen} is open to other machines; make passwords with `touchline credentials new` and add "
            "--credentials credentials/host.json, or add --insecure to admit everybody"
        )
