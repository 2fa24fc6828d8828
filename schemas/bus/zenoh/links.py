"""The TCP links of a session: none is closed slowly, and a host can close those of its clients.

Zenoh itself has no call for either. It closes a link whose data was not sent, as after a cut of the network, by
waiting for up to 10 s (its sockets have `SO_LINGER`; eclipse-zenoh/zenoh, issue 2350), one link after the other: a host
that had lost five robots admitted nobody for up to 50 s.
"""

from collections.abc import Callable
from typing import Any

import zenoh

from schemas.bus.links import Link, Links
from schemas.process.open_sockets import close_connection, close_in_background, plain_address, received_bytes


class ZenohLinks(Links):
    """The TCP links of a session, with TLS or without."""

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._is_refused: Callable[[Link], bool] = _admitted
        self._listener: Any = session.info.declare_link_events_listener(
            zenoh.handlers.Callback(self._notice, indirect=False), history=True
        )

    def traffic(self) -> dict[Link, int]:
        links = [link for one in self._session.info.links() if (link := _link(one)) is not None]
        received = received_bytes() if links else {}
        return {link: received[peer] for link in links if (peer := (link.address, link.port)) in received}

    def close(self, link: Link) -> bool:
        return close_connection((link.address, link.port))

    def refuse_if(self, is_refused: Callable[[Link], bool]) -> None:
        self._is_refused = is_refused

    def _notice(self, event: zenoh.LinkEvent) -> None:
        link = _link(event.link) if event.kind == zenoh.SampleKind.PUT else None
        if link is None:
            return
        if self._is_refused(link):
            self.close(link)
        else:
            close_in_background((link.address, link.port))


def _admitted(link: Link) -> bool:
    del link
    return False


def _link(link: zenoh.Link) -> Link | None:
    """None for a link that is neither TCP nor TLS."""
    protocol, _, rest = str(link.dst).partition("/")
    host, _, port = rest.partition("?")[0].partition("#")[0].rpartition(":")
    if protocol not in ("tcp", "tls") or not port.isdigit():
        return None
    return Link(str(link.zid), plain_address(host.strip("[]")), int(port))
