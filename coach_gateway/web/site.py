"""The web site: the page's files and the WebSocket, under headers that let a browser load nothing from elsewhere."""

import mimetypes
from collections.abc import Awaitable, Callable
from pathlib import Path

from starlette.applications import Starlette
from starlette.datastructures import MutableHeaders
from starlette.middleware import Middleware
from starlette.routing import Mount, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket

import schemas

PAGE = Path(__file__).parent / "page"
"""What runs in the browser."""
SHARED = Path(schemas.__file__).parent / "page"
"""Modules that the page of a match's statistics uses too; served below `/shared`."""

HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    # Asked for again each time, and sent again only when it has changed: a server of another version is another page.
    "Cache-Control": "no-cache",
}
"""What every answer says."""

_TYPES = {".js": "text/javascript", ".css": "text/css", ".html": "text/html", ".svg": "image/svg+xml"}
"""File types that some machines know by other names."""


def site(enter: Callable[[WebSocket], Awaitable[None]], folder: Path = PAGE) -> Starlette:
    """The whole site; `enter` attends to a page that comes."""
    for ending, kind in _TYPES.items():
        mimetypes.add_type(kind, ending)
    return Starlette(
        routes=[
            WebSocketRoute("/ws", enter),
            Mount("/shared", _Files(directory=SHARED)),
            Mount("/", _Files(directory=folder, html=True)),
        ],
        middleware=[Middleware(_Strict)],
    )


class _Files(StaticFiles):
    """The page's files; a WebSocket elsewhere than at its door is refused."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request."""
        if scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1000})
            return
        await super().__call__(scope, receive, send)


class _Strict:
    """Lays the headers over every answer."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request."""

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(HEADERS)
            await send(message)

        await self._app(scope, receive, with_headers if scope["type"] == "http" else send)
