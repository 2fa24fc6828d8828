"""What happens on the page's side of the match: follows the feed, welcomes pages, and tells all of them what is new."""

import asyncio

from coach_gateway.access import rights
from coach_gateway.access.roles import Role
from coach_gateway.web.frame_pace import FramePace
from coach_gateway.web.page_feed import PageFeed
from coach_gateway.web.pages import Page, Pages
from coach_gateway.web.protocol import (
    Alive,
    PageDrive,
    PageOrder,
    PageReplay,
    PageRequest,
    PageTokenCheck,
    ReplayUpdate,
    Welcome,
)
from coach_gateway.web.requests import RequestHandler
from coach_gateway.web.settings import BeliefsFor
from schemas.bus.contract import Bus
from schemas.config.scene import load_scene, shipped_scenes
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.side import Side

_LOOK_S = 0.01
"""s of wall time between two looks at the bus."""
_STATUS_S = 0.2
"""Likewise, between two looks at how a replay status."""
_SWEEP_S = 1.0
"""Likewise, for pages that do not read; and what the line of each is tried after."""
_BEGINNING_S = 1.0
"""s of simulated time in which the first picture of a recording is looked for."""
_AGAIN_S = 0.5
"""Wall time after which a host that did not answer is asked again."""


class PageBroadcaster:
    """The match as pages see it."""

    def __init__(self, bus: Bus, pages: Pages, requests: RequestHandler, beliefs: BeliefsFor | None) -> None:
        self._bus, self._pages, self._requests = bus, pages, requests
        self._beliefs = beliefs
        self._pace = FramePace()
        self._scenes = {name: load_scene(name).description for name in shipped_scenes()}
        self.feed = PageFeed(bus)

    async def follow(self, stop: asyncio.Event) -> None:
        """Tell all pages what is new until `stop` is set."""
        works = (self._broadcast(), self._follow_hosts(), self._follow_replay(), self._sweep())
        tasks = [asyncio.create_task(work) for work in works]
        stopped = asyncio.create_task(stop.wait())
        try:
            done, _ = await asyncio.wait([*tasks, stopped], return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in (*tasks, stopped):
                task.cancel()
            await asyncio.gather(*tasks, stopped, return_exceptions=True)
        for task in done:
            task.result()

    def welcome(self, page: Page) -> None:
        """Tell a page who it is and how things stand."""
        feed, role = self.feed, page.role
        welcome = Welcome(
            role=role,
            match=self._bus.match,
            setup=feed.setup,
            live=feed.live,
            deeds=rights.deeds_of(role),
            beliefs=self._beliefs_of(role),
            orders=self._orders_of(role),
            scenes=self._scenes,
        )
        page.queue.restart(welcome.model_dump_json())
        for text in feed.snapshot():
            page.queue.put(text)
        page.queue.put(feed.orders(self._orders_of(role)))
        frame = feed.frame(self._beliefs_of(role))
        if frame is not None:
            page.queue.put_frame(frame)

    def robots(self) -> dict[str, Side]:
        """All robots that take part, and their sides."""
        if self.feed.setup is None:
            return {}
        return {name: side for side, team in self.feed.setup.teams.items() for name in team.robots}

    def refusal(self, request: PageRequest) -> str | None:
        """Why nobody can do this now, whoever asks; nothing when it can be."""
        if isinstance(request, PageTokenCheck):
            return None
        if not self.feed.there:
            return "the host is gone; wait until it is back"
        if self.feed.setup is None:
            return "the host has not said yet what it plays; try again"
        if not self.feed.live and isinstance(request, PageOrder | PageDrive):
            return "this is a replay: what is recorded cannot be changed"
        if self.feed.live and isinstance(request, PageReplay):
            return "this is a match, and no replay"
        if isinstance(request, PageDrive) and request.robot not in self.robots():
            return f'there is no robot "{request.robot}"'
        return None

    def send_replay(self, reply: ReplayReply) -> None:
        """Tell all pages how the replay status."""
        self._pages.send(ReplayUpdate(replay=reply).model_dump_json())

    def _beliefs_of(self, role: Role) -> list[Side]:
        """Whose robots' beliefs a role is shown."""
        wanted = self._beliefs
        if wanted is None:
            setup = self.feed.setup
            friendly = not self.feed.live or (setup is not None and setup.rules == "friendly")
            wanted = BeliefsFor.ALL if friendly else BeliefsFor.TEAMS
        return rights.sides_shown(role, to_all=wanted is BeliefsFor.ALL)

    def _orders_of(self, role: Role) -> list[Side]:
        """Whose orders a role is shown: those of a match that is over are no secret."""
        return rights.sides_shown(role, to_all=not self.feed.live)

    async def _broadcast(self) -> None:
        """Tell what has come, look after look; the time that one takes too long went into telling."""
        clock, feed, pages = self._bus.clock, self.feed, self._pages
        sent_at: float | None = None
        while True:
            now = clock.now()
            if sent_at is not None:
                self._pace.took(max(0.0, now - sent_at - _LOOK_S))
                sent_at = None
            for text in feed.update():
                pages.send(text)
            if feed.orders_changed:
                feed.orders_changed = False
                for role in pages.roles():
                    pages.send(feed.orders(self._orders_of(role)), role)
            if feed.frame_changed and self._pace.due(now):
                feed.frame_changed = False
                sent_at = now
                self._show()
            await asyncio.sleep(_LOOK_S)

    def _show(self) -> None:
        """Show everybody the newest frame: put together once for all who see the same."""
        made: dict[tuple[Side, ...], str | None] = {}
        for role in self._pages.roles():
            sides = tuple(self._beliefs_of(role))
            if sides not in made:
                made[sides] = self.feed.frame(sides)
            frame = made[sides]
            if frame is not None:
                self._pages.send_frame(frame, role)

    async def _follow_hosts(self) -> None:
        """Ask a host that comes, and one that lets others play, how its match is set up; welcome all pages anew."""
        while True:
            if self.feed.host_changed:
                self.feed.host_changed = False
                try:
                    await self._ask_host()
                except TouchlineError:
                    self.feed.host_changed = self.feed.there
                    await asyncio.sleep(_AGAIN_S)
                    continue
                for page in self._pages:
                    self.welcome(page)
            await asyncio.sleep(_LOOK_S)

    async def _ask_host(self) -> None:
        """How the match is set up, and whether it is a replay; then what happens in the recording.

        Raises:
            TouchlineError: it does not answer.
        """
        client = self._requests.client
        setup = await asyncio.to_thread(client.setup)
        try:
            recorded = await asyncio.to_thread(client.replay, ReplayRequest(operation=ReplayOperation.EVENTS))
        except TouchlineError:
            self.feed.begin(setup, live=True)
        else:
            self.feed.begin(setup, live=False, events=recorded.events)

    async def _follow_replay(self) -> None:
        """Tell all pages again and again how a replay status."""
        while True:
            if self.feed.there and not self.feed.live and len(self._pages):
                try:
                    self.send_replay(await asyncio.to_thread(self._ask_replay))
                except TouchlineError:
                    await asyncio.sleep(_AGAIN_S)  # it is about to be seen that the host has gone
            await asyncio.sleep(_STATUS_S)

    def _ask_replay(self) -> ReplayReply:
        """How the replay stands; one that was begun paused shows nothing, and is led to its first picture.

        Raises:
            TouchlineError: it does not answer.
        """
        status = self._requests.client.replay(ReplayRequest())
        if status.paused and not self.feed.has_picture and status.time <= status.start + _BEGINNING_S:
            return self._requests.client.replay(ReplayRequest(operation=ReplayOperation.STEP))
        return status

    async def _sweep(self) -> None:
        """Drop pages that do not read, and let the others know that their line holds."""
        alive = Alive().model_dump_json()
        while True:
            self._pages.drop_stuck(self._bus.clock.now())
            self._pages.send(alive)
            await asyncio.sleep(_SWEEP_S)
