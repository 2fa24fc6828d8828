"""The page's server, one of the gateway's services: a web server, and what follows the match for it."""

import asyncio
import contextlib
import logging
from collections.abc import Callable, Iterator

import uvicorn

from coach_gateway.web.desk import Desk
from coach_gateway.web.door import Door
from coach_gateway.web.entrance import Entrance
from coach_gateway.web.pages import Pages
from coach_gateway.web.protocol import MAX_BYTES
from coach_gateway.web.site import site
from coach_gateway.web.stage import Stage
from schemas.bus.contract import Bus

_SPARE = 100
"""Connections beside those of open pages: who fetches files, and who is refused."""
_PING_S = 10.0
"""Wall time between two signs of life that a page is asked for, and that it has to give one."""


class WebServer:
    """Serves the page of one match."""

    def __init__(self, bus: Bus, entrance: Entrance, say: Callable[[str], None] = lambda _: None) -> None:
        self._bus, self._entrance, self._say = bus, entrance, say
        settings = entrance.settings
        self.pages = Pages(settings.pages)
        desk = Desk(bus)
        self._stage = Stage(bus, self.pages, desk, settings.beliefs)
        self._door = Door(self._stage, self.pages, desk, entrance.tokens, entrance.origins, bus.clock)

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set, then say what was refused; pages are told to come again later."""
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
                limit_concurrency=self._entrance.settings.pages + _SPARE,
                timeout_graceful_shutdown=1,
            )
        )
        logging.getLogger("uvicorn").setLevel(logging.WARNING)
        self._bus.declare_alive("coach", "page")
        serving = asyncio.create_task(server.serve([self._entrance.listener]))
        following = asyncio.create_task(self._stage.follow(stop))
        try:
            await asyncio.wait([serving, following], return_when=asyncio.FIRST_COMPLETED)
        finally:
            stop.set()
            server.should_exit = True
            await asyncio.gather(serving, following, return_exceptions=True)
        if account := self.pages.account():
            self._say(f"refused: {account}")
        following.result()
        serving.result()


class _Server(uvicorn.Server):
    """Leaves signals to the process, which has more to end than a web server."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield
