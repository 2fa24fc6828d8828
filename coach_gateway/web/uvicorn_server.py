"""How the web server is run: for the page, and for the page that waits for a match."""

import contextlib
import logging
from collections.abc import Iterator

import uvicorn
from starlette.types import ASGIApp

from coach_gateway.web.protocol import MAX_BYTES

_SPARE = 100
"""Connections beyond those of open pages: requests for files, and pages that are refused."""
_PING_S = 10.0
"""s of wall time between two pings to a page, and until a ping must be answered."""


def web_server(app: ASGIApp, pages: int) -> uvicorn.Server:
    """A server for this number of pages, which leaves signals and log to the process."""
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
            ws_per_message_deflate=True,
            ws_ping_interval=_PING_S,
            ws_ping_timeout=_PING_S,
            limit_concurrency=pages + _SPARE,
            timeout_graceful_shutdown=1,
        )
    )


class _Server(uvicorn.Server):
    """Leaves signals to the process, which ends more than a web server."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield
