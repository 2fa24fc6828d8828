"""Where pages wait while there is no host: they are served, and told that nobody plays yet."""

import asyncio
import contextlib

from starlette.websockets import WebSocket, WebSocketDisconnect

from coach_gateway.access.roles import Role
from coach_gateway.web.binding import PageBinding
from coach_gateway.web.protocol import Alive, HostUpdate, Welcome
from coach_gateway.web.site import site
from coach_gateway.web.uvicorn_server import web_server

_ALIVE_S = 1.0
"""s of wall time between two signs of life."""


class WaitingPage:
    """Serves the page before there is a match. What a page asks for is not answered: it asks again when one begins."""

    def __init__(self, binding: PageBinding, match: str) -> None:
        self._binding, self._match = binding, match

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set; then pages come again by themselves, and whoever serves next lets them in."""
        server = web_server(site(self._enter), self._binding.settings.pages)
        serving = asyncio.create_task(server.serve([self._binding.listener.dup()]))  # it closes what it is given
        stopped = asyncio.create_task(stop.wait())
        try:
            await asyncio.wait([serving, stopped], return_when=asyncio.FIRST_COMPLETED)
        finally:
            server.should_exit = True
            stopped.cancel()
            await serving

    async def _enter(self, socket: WebSocket) -> None:
        """One page, from its coming to its going."""
        if not self._binding.origins.allows(socket.headers.get("origin"), socket.headers.get("host")):
            await socket.close(1008)
            return
        await socket.accept()
        welcome = Welcome(
            role=Role.SPECTATOR, match=self._match, setup=None, live=True, deeds=[], beliefs=[], orders=[]
        )
        reading = asyncio.create_task(_read_until_closed(socket))
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # it goes while it is told something
            for news in (welcome, HostUpdate(there=False)):
                await socket.send_text(news.model_dump_json())
            while not reading.done():
                await socket.send_text(Alive().model_dump_json())
                await asyncio.wait([reading], timeout=_ALIVE_S)
        await reading


async def _read_until_closed(socket: WebSocket) -> None:
    """Until the page goes."""
    while (await socket.receive())["type"] != "websocket.disconnect":
        pass
