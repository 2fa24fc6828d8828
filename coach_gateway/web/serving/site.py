"""The web site: the page's files and the WebSocket, with headers that forbid to load anything from elsewhere."""

import mimetypes
from collections.abc import Awaitable, Callable
from pathlib import Path

from starlette.applications import Starlette
from starlette.datastructures import Headers, MutableHeaders
from starlette.middleware import Middleware
from starlette.responses import PlainTextResponse
from starlette.routing import Mount, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket

import schemas

PAGE = Path(__file__).parent.parent / "page"
"""The page's files, which run in the browser."""
SHARED = Path(schemas.__file__).parent / "page"
"""Modules that the page of a match's statistics uses too; served below `/shared`."""

_RESULT = "/result"

HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    # Revalidated each time, and sent again only when changed: a server of another version has another page.
    "Cache-Control": "no-cache",
}
"""Headers of every response."""

_TYPES = {".js": "text/javascript", ".css": "text/css", ".html": "text/html", ".svg": "image/svg+xml"}
"""Media types that some machines map differently."""


RESULT_HEADERS = HEADERS | {
    "Content-Security-Policy": (
        "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
        "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
}
"""Headers of the statistics: one file with its scripts in it, which reaches neither the page nor its server."""


def site(
    enter: Callable[[WebSocket], Awaitable[None]],
    is_known: Callable[[str | None], bool],
    result: Path | None = None,
) -> Starlette:
    """The whole site; `enter` handles the WebSocket of a page, `result` is the folder of a match's result.

    `is_known` returns whether a Host header names this server.
    """
    for ending, kind in _TYPES.items():
        mimetypes.add_type(kind, ending)
    return Starlette(
        routes=[
            WebSocketRoute("/ws", enter),
            Mount("/shared", _Files(directory=SHARED)),
            *([Mount(_RESULT, _Files(directory=result, check_dir=False))] if result is not None else []),
            Mount("/", _Files(directory=PAGE, html=True)),
        ],
        middleware=[Middleware(_Strict, is_known=is_known)],
    )


_MISDIRECTED = (
    "This server does not have that name: open the page by a numeric address, "
    "or start it with --allow-origin and the origin that your browser shows.\n"
)


class _Files(StaticFiles):
    """The page's files; a WebSocket to any other path is refused."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handle one request."""
        if scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1000})
            return
        if not Path(self.directory or "").exists():  # a match that is not over has no result
            await PlainTextResponse("Not Found", 404)(scope, receive, send)
            return
        await super().__call__(scope, receive, send)


class _Strict:
    """Adds the headers to every response, and refuses requests for another host: they come by a forged DNS entry."""

    def __init__(self, app: ASGIApp, is_known: Callable[[str | None], bool]) -> None:
        self._app, self._is_known = app, is_known

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Handle one request."""
        headers = RESULT_HEADERS if scope.get("path", "").startswith(f"{_RESULT}/") else HEADERS

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(headers)
            await send(message)

        if scope["type"] != "http":
            await self._app(scope, receive, send)
        elif not self._is_known(Headers(scope=scope).get("host")):
            await PlainTextResponse(_MISDIRECTED, 421)(scope, receive, with_headers)
        else:
            await self._app(scope, receive, with_headers)
