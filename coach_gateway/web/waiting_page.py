"""Serves the page while there is no host yet: pages wait, and show that no match is played."""

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
    """Serves the page before there is a match. Requests of a page get no reply: it repeats them when a match begins."""

    def __init__(self, binding: PageBinding, match: str | None) -> None:
        """`match` is the name of the match that is waited for; None for any."""
        self._binding, self._match = binding, match

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set; then pages reconnect by themselves, to the server that serves next."""
        server = web_server(site(self._enter), self._binding.settings.pages)
        serving = asyncio.create_task(server.serve([self._binding.listener.dup()]))  # it closes its socket
        stopped = asyncio.create_task(stop.wait())
        try:
            await asyncio.wait([serving, stopped], return_when=asyncio.FIRST_COMPLETED)
        finally:
            server.should_exit = True
            stopped.cancel()
            await serving

    async def _enter(self, socket: WebSocket) -> None:
        """Serve one page from its connection to its end."""
        if not self._binding.origins.allows(socket.headers.get("origin"), socket.headers.get("host")):
            await socket.close(1008)
            return
        await socket.accept()
        welcome = Welcome(
            role=Role.SPECTATOR, match=self._match, setup=None, live=True, deeds=[], beliefs=[], orders=[]
        )
        reading = asyncio.create_task(_read_until_closed(socket))
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # the page leaves while something is sent to it
            for news in (welcome, HostUpdate(there=False)):
                await socket.send_text(news.model_dump_json())
            while not reading.done():
                await socket.send_text(Alive().model_dump_json())
                await asyncio.wait([reading], timeout=_ALIVE_S)
        await reading


async def _read_until_closed(socket: WebSocket) -> None:
    """Read and discard messages until the page leaves."""
    while (await socket.receive())["type"] != "websocket.disconnect":
        pass
