"""The tokens of pages: each request's is checked, after a pause where its network guesses at tokens."""

import asyncio
from collections.abc import Callable

from coach_gateway.access.roles import Role
from coach_gateway.access.token_checks import TokenChecks
from coach_gateway.access.tokens import UNKNOWN_TOKEN
from coach_gateway.web.pages import Page, Pages
from coach_gateway.web.protocol import PageRequest, Reply
from schemas.process.clock import Clock

_WAIT = "too many unknown tokens have come from your address; one token of a page is checked each second"

CarryOut = Callable[[Page, Role, PageRequest], None]


class TokenGate:
    """Finds the role of each request."""

    def __init__(self, checks: TokenChecks, pages: Pages, clock: Clock) -> None:
        self._checks, self._pages, self._clock = checks, pages, clock

    def check(self, page: Page, request: PageRequest, carry_out: CarryOut) -> None:
        """Call `carry_out` with the role of a request's token, at once or later; an unknown one is refused."""
        if page.has_proven(request.token) or not (pause := self._checks.pause(page.network, self._clock.now())):
            self._check(page, request, carry_out)
        elif page.checks_later:
            page.note_bad()
            _refuse(page, request, _WAIT)
        else:
            page.checks_later = True
            task = asyncio.create_task(self._check_later(page, request, carry_out, pause))
            page.pending.add(task)
            task.add_done_callback(page.pending.discard)

    async def role_at_door(self, page: Page, token: str) -> Role:
        """The role of the token with which a page asks for room beyond the limit; spectator for an unknown one."""
        now = self._clock.now()
        await asyncio.sleep(self._checks.pause(page.network, now))
        return self._role(page, token) or Role.SPECTATOR

    async def _check_later(self, page: Page, request: PageRequest, carry_out: CarryOut, pause: float) -> None:
        await asyncio.sleep(pause)
        page.checks_later = False
        self._check(page, request, carry_out)

    def _check(self, page: Page, request: PageRequest, carry_out: CarryOut) -> None:
        role = self._role(page, request.token)
        if role is None:
            page.note_wrong_token()
            _refuse(page, request, UNKNOWN_TOKEN)
        else:
            carry_out(page, role, request)

    def _role(self, page: Page, token: str) -> Role | None:
        role = self._checks.role_of(token)
        if role is None:
            now = self._clock.now()
            self._pages.refusals.note("wrong token", page.network, now)
            self._checks.note_unknown(page.network, now)
        elif token:
            page.note_right_token(token)
        return role


def _refuse(page: Page, request: PageRequest, why: str) -> None:
    page.queue.put(Reply(id=request.id, accepted=False, reason=why).model_dump_json())
