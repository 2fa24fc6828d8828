"""Which origins may use this server: its own, and those that its operator allows.

A browser sends the page's origin, which a page cannot forge. The host name in it must be one that no foreign DNS entry
can point here: a numeric address, `localhost`, or this machine's own name.
"""

import ipaddress
import socket
from collections.abc import Iterable
from urllib.parse import urlsplit

from schemas.errors import TouchlineError


class Origins:
    """The allowed origins."""

    def __init__(self, allowed: Iterable[str] = (), names: Iterable[str] = ()) -> None:
        """`allowed` are whole origins; `names` are host names of this machine, by default its own.

        Raises:
            TouchlineError: an invalid origin.
        """
        self._allowed = frozenset(_checked(origin) for origin in allowed)
        own = socket.gethostname().lower()
        self._names = frozenset(names or ("localhost", own, f"{own}.local"))

    def allows(self, origin: str | None, host: str | None) -> bool:
        """Whether a page of this origin may connect; `host` is the Host header, `127.0.0.1:8080`."""
        if origin is None:
            return False
        if origin in self._allowed:
            return True
        try:
            parts = urlsplit(origin)
        except ValueError:  # no browser sends such an origin
            return False
        if parts.scheme != "http" or host is None or parts.netloc.lower() != host.lower():
            return False
        return self._is_own(parts.hostname or "")

    def knows(self, host: str | None) -> bool:
        """Whether a Host header names this server: a foreign DNS entry that points here is not its name.

        Without the header it is no browser that asks.
        """
        if host is None or any(urlsplit(origin).netloc == host.lower() for origin in self._allowed):
            return True
        try:
            return self._is_own(urlsplit(f"http://{host}").hostname or "")
        except ValueError:
            return False

    def _is_own(self, name: str) -> bool:
        return name in self._names or _is_numeric(name)


def _is_numeric(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _checked(origin: str) -> str:
    """An origin as browsers write it, in lower case."""
    plain = origin.lower()
    try:
        parts = urlsplit(plain)
    except ValueError:
        parts = urlsplit("")
    if parts.scheme not in ("http", "https") or not parts.netloc or plain != f"{parts.scheme}://{parts.netloc}":
        raise TouchlineError(f'--allow-origin is "{origin}"; write it as https://cup.example.org, without a path')
    return plain
