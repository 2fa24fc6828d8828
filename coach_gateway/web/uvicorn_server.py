"""How the web server is run: for the page, and for the page that waits for a match."""

import contextlib
import logging
import socket
from collections.abc import Iterator
from typing import Any

import uvicorn
from starlette.types import ASGIApp

from coach_gateway.web.connections import Connections
from coach_gateway.web.http_protocol import REQUEST_S, HttpProtocol
from coach_gateway.web.protocol import MAX_BYTES
from coach_gateway.web.socket_protocol import SocketProtocol

_PING_S = 10.0
"""s of wall time between two pings to a page, and until a ping must be answered."""
_AT_ONCE, _WAITING = 8, 1024
"""Connections that are accepted before everything else takes a turn, and that wait in the kernel meanwhile."""
_MOST_HEADER_BYTES = 16_384
"""Bytes of a request's first line and headers."""


class PageConfig(uvicorn.Config):
    """The server's configuration, with which its connections find each other."""

    def __init__(self, app: ASGIApp, connections: Connections, **options: Any) -> None:
        super().__init__(app, **options)
        self.connections = connections


def web_server(app: ASGIApp, connections: Connections) -> uvicorn.Server:
    """A server that leaves signals and log to the process."""
    logging.getLogger("uvicorn").setLevel(logging.ERROR)  # what clients do wrong is counted by `connections`
    return _Server(
        PageConfig(
            app,
            connections,
            ws=SocketProtocol,
            http=HttpProtocol,
            loop="asyncio",
            lifespan="off",
            log_config=None,
            access_log=False,
            proxy_headers=False,
            server_header=False,
            ws_max_size=4 * MAX_BYTES,
            ws_per_message_deflate=True,
            ws_ping_interval=_PING_S,
            ws_ping_timeout=_PING_S,
            h11_max_incomplete_event_size=_MOST_HEADER_BYTES,
            timeout_keep_alive=round(REQUEST_S),
            timeout_graceful_shutdown=1,
            backlog=_AT_ONCE,
        )
    )


class _Server(uvicorn.Server):
    """Leaves signals to the process, which ends more than a web server, and lets a flood of connections wait."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen; asyncio accepts as many connections in a row as its backlog has."""
        await super().startup(sockets)
        for listener in sockets or []:
            listener.listen(_WAITING)

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield
