"""The page's server, one of the gateway's services: its socket, its web server, and what it says at the beginning."""

import asyncio
import contextlib
import logging
from collections.abc import Callable, Iterator

import uvicorn

from coach_gateway.web.desk import Desk
from coach_gateway.web.door import Door
from coach_gateway.web.listening import listen, origin_of
from coach_gateway.web.origins import Origins
from coach_gateway.web.pages import Pages
from coach_gateway.web.protocol import MAX_BYTES, Role
from coach_gateway.web.settings import WebSettings
from coach_gateway.web.site import site
from coach_gateway.web.stage import Stage
from coach_gateway.web.tokens import Tokens, address, tokens_of
from schemas.bus.contract import Bus

_SPARE = 100
"""Connections beside those of open pages: who fetches files, and who is refused."""
_PING_S = 10.0
"""Wall time between two signs of life that a page is asked for, and that it has to give one."""


class WebServer:
    """Serves the page of one match."""

    def __init__(
        self, bus: Bus, settings: WebSettings, say: Callable[[str], None], tokens: Tokens | None = None
    ) -> None:
        """Listen, and say where; served once `serve` is called. `tokens` are those that the process has already.

        Raises:
            TouchlineError: the port is taken, the tokens cannot be read, an origin is none.
        """
        self._bus, self._settings = bus, settings
        origins = Origins(settings.origins)
        tokens = tokens or tokens_of(settings.tokens)
        self._socket = listen(settings.listen, settings.port)
        self.pages = Pages(settings.pages)
        desk = Desk(bus)
        self.stage = Stage(bus, self.pages, desk, settings.beliefs)
        self._door = Door(self.stage, self.pages, desk, tokens, origins, bus.clock)
        for line in self._lines(tokens):
            say(line)

    @property
    def origin(self) -> str:
        """Where a browser on this machine finds the page."""
        return origin_of(*self._socket.getsockname()[:2])

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set; pages are told to come again later."""
        server = _Server(
            uvicorn.Config(
                site(self._door),
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
                limit_concurrency=self._settings.pages + _SPARE,
                timeout_graceful_shutdown=1,
            )
        )
        logging.getLogger("uvicorn").setLevel(logging.WARNING)
        self._bus.declare_alive("coach", "page")
        serving = asyncio.create_task(server.serve([self._socket]))
        following = asyncio.create_task(self.stage.follow(stop))
        try:
            await asyncio.wait([serving, following], return_when=asyncio.FIRST_COMPLETED)
        finally:
            stop.set()
            server.should_exit = True
            await asyncio.gather(serving, following, return_exceptions=True)
        following.result()
        serving.result()

    def _lines(self, tokens: Tokens) -> Iterator[str]:
        """Where to find the page, and with which token: a log that others may read has none."""
        yield f"page: {self.origin}/"
        if self._settings.tokens is not None:
            yield f"tokens: {self._settings.tokens}"
            return
        for role in (Role.REFEREE, Role.CYAN, Role.MAGENTA):
            yield f"{role.value}: {address(self.origin, tokens.of(role))}"


class _Server(uvicorn.Server):
    """Leaves signals to the process, which has more to end than a web server."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield
