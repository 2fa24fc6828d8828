"""The page's server, one of the gateway's services: it serves from before there is a match until the process ends."""

import asyncio
from collections.abc import Callable
from pathlib import Path

from coach_gateway.access.refusals import Refusals
from coach_gateway.timing import PAGE_ALIVE_S
from coach_gateway.web.pages.broadcaster import PageBroadcaster
from coach_gateway.web.pages.match_result import ResultReader
from coach_gateway.web.pages.open_pages import Pages
from coach_gateway.web.pages.protocol import Alive
from coach_gateway.web.pages.requests import RequestHandler
from coach_gateway.web.serving.binding import PageBinding
from coach_gateway.web.serving.site import site
from coach_gateway.web.serving.socket_endpoint import SocketEndpoint
from coach_gateway.web.serving.uvicorn_server import web_server
from runtime.bus.contract import Bus


class WebServer:
    """Serves the page; `show` gives it a match."""

    def __init__(
        self, binding: PageBinding, match: str | None, log: Callable[[str], None], result: Path | None = None
    ) -> None:
        """`match` is the name of the match that is waited for, None for any; `result` the folder of its result."""
        self._binding, self._result = binding, result
        self.pages = Pages()
        self.refusals = Refusals("page", log)
        self._endpoint = SocketEndpoint(
            self.pages, binding.settings.pages, binding.tokens, binding.origins, self.refusals, match
        )

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set, then log what was refused; pages reconnect by themselves later."""
        app = site(self._endpoint.enter, self._binding.origins.knows, result=self._result)
        server = web_server(app, self._binding.settings.pages)
        serving = asyncio.create_task(server.serve([self._binding.listener]))
        stopped, alive = asyncio.create_task(stop.wait()), asyncio.create_task(self._send_alive())
        try:
            await asyncio.wait([serving, stopped], return_when=asyncio.FIRST_COMPLETED)
        finally:
            stop.set()
            server.should_exit = True
            for task in (stopped, alive):
                task.cancel()
            await asyncio.gather(serving, stopped, alive, return_exceptions=True)
        self.refusals.log_summary()
        serving.result()

    def show(self, bus: Bus) -> PageBroadcaster:
        """The match of this bus, as a service that sends it to all pages."""
        match = PageBroadcaster(
            bus, self.pages, RequestHandler(bus), self._binding.settings.beliefs, ResultReader(self._result)
        )
        self._endpoint.match = match
        return match

    async def _send_alive(self) -> None:
        """Send all pages a sign of life."""
        text = Alive().json()
        while True:
            self.pages.send(text)
            await asyncio.sleep(PAGE_ALIVE_S)
