"""Whether a page is served yet: its address is printed when a browser that opens it gets an answer."""

import socket
from collections.abc import Callable, Iterable

from coach_gateway.web.listener import listening_address
from coach_gateway.web.settings import WebSettings

_CONNECT_S = 0.05
"""s of wall time that an attempt to connect may take; the server is on this machine."""
_REQUEST = b"GET /icon.svg HTTP/1.0\r\n\r\n"


class PageProbe:
    """Asks for a file of the page without waiting, until one is sent."""

    def __init__(self, web: WebSettings) -> None:
        self._address = (listening_address(web.listen_web), web.port)
        self._link: socket.socket | None = None

    def is_served(self) -> bool:
        """Whether a file has been sent; once it has, no further question is useful."""
        try:
            if self._link is None:
                self._link = socket.create_connection(self._address, timeout=_CONNECT_S)
                self._link.sendall(_REQUEST)
                self._link.setblocking(False)
            served = self._link.recv(1) != b""
        except BlockingIOError:
            return False  # connected, not answered yet
        except OSError:
            served = False
        self.close()
        return served

    def close(self) -> None:
        """Give up an attempt."""
        if self._link is not None:
            self._link.close()
            self._link = None


class AddressLines:
    """Prints the lines with a page's address once it is served."""

    def __init__(self, web: WebSettings, lines: Callable[[], Iterable[str]], log: Callable[[str], None]) -> None:
        self._probe: PageProbe | None = PageProbe(web)
        self._lines, self._log = lines, log

    def update(self) -> None:
        """Print the lines if the page is served now and was not before."""
        if self._probe is not None and self._probe.is_served():
            self._probe = None
            for line in self._lines():
                self._log(line)
