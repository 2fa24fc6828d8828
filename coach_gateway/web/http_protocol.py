"""HTTP connections: a request has to be complete in time, whatever its client sends meanwhile."""

import asyncio
from typing import TYPE_CHECKING

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from coach_gateway.access.client_network import client_network

if TYPE_CHECKING:
    from coach_gateway.web.uvicorn_server import PageConfig

REQUEST_S = 5.0
"""s of wall time from the connection, or from the response before, to the end of a request's headers."""
HELD_S = 1.0
"""s of wall time for which a connection is held that is refused for the rate of its network."""
RESPONSE_S = 30.0
"""s of wall time for a response, to the last byte that the client reads."""


class HttpProtocol(H11Protocol):
    """One connection, until it is closed or becomes a WebSocket."""

    config: "PageConfig"

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Take in a connection, unless its network opens too many."""
        super().connection_made(transport)
        self._is_http, self._timed = True, False
        self._timer: asyncio.TimerHandle | None = None
        self.network = client_network(self.client[0] if self.client is not None else None)
        if self.config.connections.admit(self):
            self._set_timer()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget it."""
        self.config.connections.remove(self)
        self._cancel_timer()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Handle what has come; only a complete request gets more time."""
        super().data_received(data)
        if self._is_http and self.is_serving is not self._timed:
            self._set_timer()

    def on_response_complete(self) -> None:
        """Wait for the next request, unless its network requests too many."""
        if not self.config.connections.is_within_limit(self):
            self.config.connections.refuse(self, "requests")
        super().on_response_complete()
        self._set_timer()

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Hand over to the protocol of the WebSocket."""
        self._is_http = False
        self._cancel_timer()
        self.config.connections.remove(self)
        super().handle_websocket_upgrade(event)

    def send_400_response(self, msg: str) -> None:
        """Refuse what is not HTTP."""
        self.config.connections.refusals.note("broken", self.network, self.config.connections.clock.now(), "not HTTP")
        super().send_400_response(msg)

    @property
    def holds_page(self) -> bool:
        """A page has a WebSocket."""
        return False

    @property
    def is_serving(self) -> bool:
        """Whether a request is in progress."""
        return self.cycle is not None and not self.cycle.response_complete

    def hold(self) -> None:
        """Read nothing, and close it a while later."""
        self.transport.pause_reading()
        self._timer = self.loop.call_later(HELD_S, self.cut)

    def cut(self) -> None:
        """Close it at once."""
        self._cancel_timer()
        self.transport.abort()

    def _set_timer(self) -> None:
        self._cancel_timer()
        if not self.transport.is_closing():
            self._timed = self.is_serving
            self._timer = self.loop.call_later(RESPONSE_S if self._timed else REQUEST_S, self._end)

    def _cancel_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _end(self) -> None:
        """Close a connection whose time is up; one that a browser has opened in advance is no fault."""
        if self.is_serving or self.conn.trailing_data[0]:
            self.config.connections.refuse(self, "late")
        else:
            self.cut()
