"""How the web server is run: for the page, and for those who wait for a match."""

import contextlib
import logging
from collections.abc import Iterator

import uvicorn
from starlette.types import ASGIApp

from coach_gateway.web.protocol import MAX_BYTES

_SPARE = 100
"""Connections beside those of open pages: who fetches files, and who is refused."""
_PING_S = 10.0
"""Wall time between two signs of life that a page is asked for, and that it has to give one."""


def web_server(app: ASGIApp, pages: int) -> uvicorn.Server:
    """A server for so many pages, that leaves signals and log to the process."""
    logging.getLogger("uvicorn").setLevel(logging.WARNING)
    return _Server(
        uvicorn.Config(
            app,
            ws="websockets-sansio",
            http="h11",
            loop="asyncio",
            lifespan="off",
            log_config=None,
            access_log=False,
            proxy_headers=False,
            server_header=False,
            ws_max_size=4 * MAX_BYTES,
            ws_per_message_deflate=False,
            ws_ping_interval=_PING_S,
            ws_ping_timeout=_PING_S,
            limit_concurrency=pages + _SPARE,
            timeout_graceful_shutdown=1,
        )
    )


class _Server(uvicorn.Server):
    """Leaves signals to the process, which has more to end than a web server."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield
