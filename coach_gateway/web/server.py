"""The page's server, one of the gateway's services: a web server, and the broadcaster that follows the match."""

import asyncio
from collections.abc import Callable
from pathlib import Path

from coach_gateway.access.token_checks import TokenChecks
from coach_gateway.web.binding import PageBinding
from coach_gateway.web.broadcaster import PageBroadcaster
from coach_gateway.web.connections import Connections, host_check
from coach_gateway.web.match_result import ResultReader
from coach_gateway.web.pages import Pages
from coach_gateway.web.requests import RequestHandler
from coach_gateway.web.site import site
from coach_gateway.web.socket_endpoint import SocketEndpoint
from coach_gateway.web.token_gate import TokenGate
from coach_gateway.web.uvicorn_server import web_server
from schemas.bus.contract import Bus, PresenceKind


class WebServer:
    """Serves the page of one match."""

    def __init__(
        self, bus: Bus, binding: PageBinding, log: Callable[[str], None] = lambda _: None, result: Path | None = None
    ) -> None:
        """`result` is the folder in which the result of the match will be written."""
        self._bus, self._binding, self._log = bus, binding, log
        self._result = result
        settings = binding.settings
        self.pages = Pages(settings.pages, settings.pages_per_address, log)
        requests = RequestHandler(bus)
        self._broadcaster = PageBroadcaster(bus, self.pages, requests, settings.beliefs, ResultReader(result))
        gate = TokenGate(TokenChecks(binding.tokens), self.pages, bus.clock)
        self._endpoint = SocketEndpoint(self._broadcaster, self.pages, requests, gate, binding.origins, bus.clock)

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set, then log what was refused; pages reconnect by themselves later.

        A server that is given the result of its match ends by itself after it, once no page is open any more.
        """
        connections = Connections(self.pages.refusals, self._bus.clock)
        is_known = host_check(self._binding.origins, connections)
        server = web_server(site(self._endpoint.enter, is_known, result=self._result), connections)
        self._bus.declare_alive(PresenceKind.COACH, "page")
        serving = asyncio.create_task(server.serve([self._binding.listener]))
        following = asyncio.create_task(self._broadcaster.follow(stop))
        try:
            await asyncio.wait([serving, following], return_when=asyncio.FIRST_COMPLETED)
        finally:
            stop.set()
            server.should_exit = True
            await asyncio.gather(serving, following, return_exceptions=True)
        if faults := self.pages.fault_summary():
            self._log(f"refused or dropped: {faults}")
        following.result()
        serving.result()
