"""Which pages may speak to this server: its own, and those that whoever runs it allows.

A browser names the page's origin, and a page cannot lie about it. The name in the address has to be one that nobody
else can have led here: an address in numbers, `localhost`, or this machine's own name.
"""

import ipaddress
import socket
from collections.abc import Iterable
from urllib.parse import urlsplit

from schemas.errors import TouchlineError


class Origins:
    """The origins that are ours."""

    def __init__(self, allowed: Iterable[str] = (), names: Iterable[str] = ()) -> None:
        """`allowed` are whole origins; `names` those of this machine, by default what it calls itself.

        Raises:
            TouchlineError: an origin that is none.
        """
        self._allowed = frozenset(_checked(origin) for origin in allowed)
        own = socket.gethostname().lower()
        self._names = frozenset(names or ("localhost", own, f"{own}.local"))

    def allows(self, origin: str | None, host: str | None) -> bool:
        """Whether a page of this origin may speak to us; `host` is whom it thinks it speaks to, `127.0.0.1:8080`."""
        if origin is None:
            return False
        if origin in self._allowed:
            return True
        try:
            parts = urlsplit(origin)
        except ValueError:  # no browser says such a thing
            return False
        if parts.scheme != "http" or host is None or parts.netloc.lower() != host.lower():
            return False
        name = parts.hostname or ""
        return name in self._names or _is_numeric(name)


def _is_numeric(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _checked(origin: str) -> str:
    """As browsers write it: in small letters."""
    plain = origin.lower()
    try:
        parts = urlsplit(plain)
    except ValueError:
        parts = urlsplit("")
    if parts.scheme not in ("http", "https") or not parts.netloc or plain != f"{parts.scheme}://{parts.netloc}":
        raise TouchlineError(f'--allow-origin is "{origin}"; write it as https://cup.example.org, without a path')
    return plain
