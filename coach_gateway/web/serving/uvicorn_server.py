"""The web server, with the limits that uvicorn documents."""

import logging

import uvicorn
from starlette.types import ASGIApp

from coach_gateway.timing import CLIENT_S

MAX_MESSAGE_BYTES = 65_536
"""A longer message of a page ends its connection."""
_LOADING = 600
"""Connections in addition to open pages: a hundred browsers that load the page use six each."""
_MAX_HEADER_BYTES = 16_384
"""Bytes of a request's first line and headers."""


def web_server(app: ASGIApp, most_pages: int) -> uvicorn.Server:
    """A server that leaves the log to the process."""
    logging.getLogger("uvicorn").setLevel(logging.ERROR)  # without what clients do wrong
    return uvicorn.Server(
        uvicorn.Config(
            app,
            http="h11",
            ws="websockets-sansio",
            loop="asyncio",
            lifespan="off",
            log_config=None,
            access_log=False,
            proxy_headers=False,
            server_header=False,
            limit_concurrency=most_pages + _LOADING,
            ws_max_size=MAX_MESSAGE_BYTES,
            h11_max_incomplete_event_size=_MAX_HEADER_BYTES,
            timeout_graceful_shutdown=CLIENT_S,
        )
    )
