"""The page's server, one of the gateway's services: a web server, and what follows the match for it."""

import asyncio
from collections.abc import Callable

from coach_gateway.web.desk import Desk
from coach_gateway.web.door import Door
from coach_gateway.web.entrance import Entrance
from coach_gateway.web.pages import Pages
from coach_gateway.web.serving import web_server
from coach_gateway.web.site import site
from coach_gateway.web.stage import Stage
from schemas.bus.contract import Bus


class WebServer:
    """Serves the page of one match."""

    def __init__(self, bus: Bus, entrance: Entrance, say: Callable[[str], None] = lambda _: None) -> None:
        self._bus, self._entrance, self._say = bus, entrance, say
        settings = entrance.settings
        self.pages = Pages(settings.pages, settings.pages_each)
        desk = Desk(bus)
        self._stage = Stage(bus, self.pages, desk, settings.beliefs)
        self._door = Door(self._stage, self.pages, desk, entrance.tokens, entrance.origins, bus.clock)

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set, then say what was refused; pages are told to come again later."""
        server = web_server(site(self._door.enter), self._entrance.settings.pages)
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
