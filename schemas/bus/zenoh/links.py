"""The links of a host's router, closed at their sockets: Zenoh itself has no call for that."""

from collections.abc import Callable
from typing import Any

import zenoh

from schemas.bus.links import Link, Links
from schemas.process.open_sockets import close_connection, plain_address, received_bytes


class ZenohLinks(Links):
    """The TCP links of a session, with TLS or without."""

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._listener: Any = None

    def traffic(self) -> dict[Link, int]:
        links = [link for one in self._session.info.links() if (link := _link(one)) is not None]
        received = received_bytes() if links else {}
        return {link: received[peer] for link in links if (peer := (link.address, link.port)) in received}

    def close(self, link: Link) -> bool:
        return close_connection((link.address, link.port))

    def refuse_if(self, is_refused: Callable[[Link], bool]) -> None:
        def check(event: zenoh.LinkEvent) -> None:
            if event.kind != zenoh.SampleKind.PUT:
                return
            link = _link(event.link)
            if link is not None and is_refused(link):
                self.close(link)

        self._listener = self._session.info.declare_link_events_listener(check)


def _link(link: zenoh.Link) -> Link | None:
    """None for a link that is neither TCP nor TLS."""
    protocol, _, rest = str(link.dst).partition("/")
    host, _, port = rest.partition("?")[0].partition("#")[0].rpartition(":")
    if protocol not in ("tcp", "tls") or not port.isdigit():
        return None
    return Link(str(link.zid), plain_address(host.strip("[]")), int(port))
