"""Follows the match for all pages: welcomes each, and sends all of them what is new."""

import asyncio
from contextlib import suppress

from coach_gateway.access import rights
from coach_gateway.access.roles import TokenRole
from coach_gateway.service import until_first
from coach_gateway.timing import HOST_RETRY_S, POLL_S, RELOAD_S, STATUS_S
from coach_gateway.web.pages.frame_pace import FramePace
from coach_gateway.web.pages.manual_control import ManualControl
from coach_gateway.web.pages.match_result import ResultReader
from coach_gateway.web.pages.open_pages import Page, Pages
from coach_gateway.web.pages.page_feed import PageFeed
from coach_gateway.web.pages.protocol import (
    PageDrive,
    PageOrder,
    PageReplay,
    PageRequest,
    ReplayUpdate,
    Welcome,
)
from coach_gateway.web.pages.requests import RequestHandler, refusal
from coach_gateway.web.settings import BeliefsFor
from runtime.bus.contract import Bus, PresenceKind
from schemas.config.scene import load_scene, shipped_scenes
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.side import Side
from schemas.topics import REPLAY_CONTROL

_BEGINNING_S = 1.0
"""s of simulated time from a recording's start in which its first tick is looked for."""


class PageBroadcaster:
    """Sends one match to all pages."""

    def __init__(
        self,
        bus: Bus,
        pages: Pages,
        requests: RequestHandler,
        beliefs: BeliefsFor | None,
        result: ResultReader | None = None,
    ) -> None:
        self._result = result or ResultReader(None)
        self._bus, self._pages, self.requests = bus, pages, requests
        self._beliefs = beliefs
        self._manual_control = ManualControl()
        self._pace = FramePace()
        self._scenes = {name: load_scene(name).description for name in shipped_scenes()}
        self.feed = PageFeed(bus)

    async def serve(self, stop: asyncio.Event) -> None:
        """Send all pages what is new until `stop` is set.

        With a folder of the result it ends by itself after the match, once no page is open any more, and sets `stop`.
        """
        self._bus.declare_alive(PresenceKind.COACH, "page")
        works = (self._broadcast(), self._follow_hosts(), self._follow_replay(), self._follow_result())
        try:
            await until_first(stop.wait(), *works)
        finally:
            stop.set()

    def welcome(self, page: Page) -> None:
        """Send a page its role and rights, then everything that is known of the match."""
        feed, role = self.feed, page.role
        welcome = Welcome(
            role=role,
            match=self._bus.match,
            setup=feed.setup,
            live=feed.live,
            deeds=rights.deeds_of(role, feed.setup),
            beliefs=self._beliefs_of(role),
            debug=self._own_sides(role),
            orders=self._own_sides(role),
            scenes=self._scenes,
            topics=list(feed.topics),
        )
        page.queue.restart(welcome.json())
        for text in feed.snapshot():
            page.queue.put(text)
        if self._result.result is not None:
            page.queue.put(self._result.result.json())
        page.queue.put(feed.orders(self._own_sides(role)))
        frame = feed.frame(self._beliefs_of(role), self._own_sides(role))
        if frame is not None:
            page.queue.put_frame(frame)

    def robots(self) -> dict[str, Side]:
        """All robots of the match, and their sides."""
        return self.feed.setup.sides if self.feed.setup is not None else {}

    def refusal(self, page: Page, role: TokenRole, request: PageRequest) -> str | None:
        """Why a page with this role cannot do this now; None when it can."""
        why = refusal(role, request, self.robots()) or self._why_not_now(request)
        if why is None and isinstance(request, PageDrive):
            return self._manual_control.refusal(page, request, self._bus.clock.now())
        return why

    def _why_not_now(self, request: PageRequest) -> str | None:
        """Why no role can do this now."""
        if not self.feed.host_present:
            return "the host is gone; wait until it is back"
        if self.feed.topics:
            return None if isinstance(request, PageReplay) else "this is a replay of a file without a match"
        if self.feed.setup is None:
            return "the match is not known yet; try again"
        if not self.feed.live and isinstance(request, PageOrder | PageDrive):
            return "this is a replay: what is recorded cannot be changed"
        if self.feed.live and isinstance(request, PageReplay):
            return "this is a match, not a replay"
        if isinstance(request, PageDrive) and request.robot not in self.robots():
            return f'there is no robot "{request.robot}"'
        return None

    def _beliefs_of(self, role: TokenRole) -> list[Side]:
        """The sides whose robots' beliefs a role is shown."""
        wanted = self._beliefs
        if wanted is None:
            setup = self.feed.setup
            friendly = not self.feed.live or (setup is not None and setup.rules == "friendly")
            wanted = BeliefsFor.ALL if friendly else BeliefsFor.TEAMS
        return rights.sides_shown(role, to_all=wanted is BeliefsFor.ALL)

    def _own_sides(self, role: TokenRole) -> list[Side]:
        """The sides whose orders and drawings a role is shown; in a replay both, as in the recording."""
        return rights.sides_shown(role, to_all=not self.feed.live)

    async def _broadcast(self) -> None:
        """Send what has come, poll by poll. What a poll takes beyond its period was spent on sending the frame."""
        clock, feed, pages = self._bus.clock, self.feed, self._pages
        sent_at: float | None = None
        while True:
            now = clock.now()
            if sent_at is not None:
                self._pace.took(max(0.0, now - sent_at - POLL_S))
                sent_at = None
            for text in feed.update():
                pages.send(text)
            if feed.orders_changed:
                feed.orders_changed = False
                for role in pages.roles():
                    pages.send(feed.orders(self._own_sides(role)), role)
            if feed.frame_changed and self._pace.due(now):
                feed.frame_changed = False
                sent_at = now
                self._show()
            await asyncio.sleep(POLL_S)

    def _show(self) -> None:
        """Send the newest frame to all pages; it is encoded once for all roles with the same view."""
        made: dict[tuple[tuple[Side, ...], tuple[Side, ...]], str | None] = {}
        for role in self._pages.roles():
            view = tuple(self._beliefs_of(role)), tuple(self._own_sides(role))
            if view not in made:
                made[view] = self.feed.frame(*view)
            frame = made[view]
            if frame is not None:
                self._pages.send_frame(frame, role)

    async def _follow_hosts(self) -> None:
        """Query the setup of a new host, or of one with other robots, and welcome all pages again."""
        while True:
            if self.feed.host_changed:
                self.feed.host_changed = False
                try:
                    await self._ask_host()
                except TouchlineError:
                    self.feed.host_changed = self.feed.host_present
                    await asyncio.sleep(HOST_RETRY_S)
                    continue
                for page in self._pages:
                    self.welcome(page)
            await asyncio.sleep(POLL_S)

    async def _ask_host(self) -> None:
        """Query how the match is set up and whether it is a replay, and the events of a replay's recording.

        Raises:
            TouchlineError: the host does not answer.
        """
        client, recorded = self.requests.client, None
        with suppress(TouchlineError):  # it is a match
            request = ReplayRequest(operation=ReplayOperation.EVENTS)
            recorded = await asyncio.to_thread(client.ask, REPLAY_CONTROL, request)
        if recorded is not None and recorded.topics:
            self.feed.begin(None, live=False, topics=recorded.topics)
            return
        setup = await asyncio.to_thread(client.setup)
        self.feed.begin(setup, live=recorded is None, events=recorded.events if recorded is not None else ())

    async def _follow_replay(self) -> None:
        """Send all pages the status of a replay, several times a second."""
        while True:
            if self.feed.host_present and not self.feed.live and len(self._pages):
                try:
                    status = await asyncio.to_thread(self._ask_replay)
                    self._pages.send(ReplayUpdate(replay=status).json())
                except TouchlineError:
                    await asyncio.sleep(HOST_RETRY_S)  # the follower is about to notice that the host has left
            await asyncio.sleep(STATUS_S)

    def _ask_replay(self) -> ReplayReply:
        """The status of the replay; one that starts paused is stepped to its first tick, so that there is a picture.

        Raises:
            TouchlineError: the replay does not answer.
        """
        client = self.requests.client
        status: ReplayReply = client.ask(REPLAY_CONTROL, ReplayRequest())
        shows = self.feed.has_picture or self.feed.setup is None
        if status.paused and not shows and status.time <= status.start + _BEGINNING_S:
            status = client.ask(REPLAY_CONTROL, ReplayRequest(operation=ReplayOperation.STEP))
        return status

    async def _follow_result(self) -> None:
        """Send all pages the result of the match; returns when it is known and its pages have been closed."""
        clock, seen_at = self._bus.clock, -RELOAD_S
        while True:
            if len(self._pages):
                seen_at = clock.now()
            if self._result.update() and self._result.result is not None:
                self._pages.send(self._result.result.json())
            if self._result.result is not None and clock.now() - seen_at > RELOAD_S:
                return
            await asyncio.sleep(STATUS_S)
