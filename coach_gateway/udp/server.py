"""The socket that coach programs speak to: nobody waits for anybody, and what is lost is known by its number."""

import asyncio
from collections.abc import Callable
from typing import Any

from coach_gateway.live import Live, pause
from coach_gateway.ports import cannot_listen
from coach_gateway.udp import DEFAULT_PORT
from coach_gateway.udp.coach_record import MatchMode
from coach_gateway.udp.coaches import Address, Coaches, Deed
from coach_gateway.udp.protocol import Ack, BeliefNews, EventNews, Farewell, Frame, SideOrder
from coach_gateway.udp.session import SILENCE_S, Session
from coach_gateway.web.access import sides_shown
from coach_gateway.web.protocol import Role
from schemas.errors import TouchlineError
from schemas.game import TeamPhase
from schemas.message import Part
from schemas.side import Side

_LOOK_S = 0.01
"""s of wall time between two looks at which program is due."""
_EVENTS_AT_ONCE = 50
"""Told at most with one frame, or for one datagram that asks for them: more would be lost in a full buffer."""


class UdpCoaches(asyncio.DatagramProtocol):
    """All coach programs of a match."""

    def __init__(
        self,
        live: Live,
        role_of: Callable[[str], Role | None],
        say: Callable[[str], None],
        port: int = DEFAULT_PORT,
        host: str = "127.0.0.1",
    ) -> None:
        """`role_of` tells whom a token stands for; `say` is given a line whenever people should know something."""
        self._live = live
        self._say = say
        self._at = (host, port)
        self._coaches = Coaches(role_of, live.now)
        self._transport: asyncio.DatagramTransport | None = None
        self._full = False
        """The socket takes no more just now: frames are left out."""
        self._doing: dict[asyncio.Task[None], None] = {}
        self.port = 0
        """Where it listens, once it does."""

    async def serve(self, stop: asyncio.Event) -> None:
        """Hear coach programs, and tell them how things stand, until `stop` is set.

        Raises:
            TouchlineError: the port is taken.
        """
        loop = asyncio.get_running_loop()
        try:
            transport, _ = await loop.create_datagram_endpoint(lambda: self, local_addr=self._at)
        except OSError as error:
            raise cannot_listen("--udp", *self._at, error) from None
        self._transport = transport
        self.port = transport.get_extra_info("sockname")[1]
        self._say(f"coach programs over UDP on {self._at[0]}:{self.port}")
        try:
            while not await pause(stop, _LOOK_S):
                self._tell()
        finally:
            for task in tuple(self._doing):
                task.cancel()
            for address in self._coaches.sessions:
                self._send(Farewell(reason="the gateway ends"), address)
            transport.close()

    def datagram_received(self, data: bytes, addr: Address) -> None:
        """A datagram came."""
        heard = self._coaches.hear(data, addr, self._live.now, self._live.sides)
        if heard.ack is not None:
            self._send(heard.ack, addr)
            if heard.ack.of == "hello" and heard.ack.accepted and not heard.ack.duplicate:
                self._say(f"{heard.ack.role} program from {addr[0]}:{addr[1]}")
        if heard.events_since is not None:
            for number in range(heard.events_since, min(len(self._live.events), heard.events_since + _EVENTS_AT_ONCE)):
                self._tell_event(number, addr)
        if heard.deed is not None:
            task = asyncio.get_running_loop().create_task(self._do(heard.deed))
            self._doing[task] = None
            task.add_done_callback(lambda done: self._doing.pop(done, None))

    def pause_writing(self) -> None:
        """The socket is full."""
        self._full = True

    def resume_writing(self) -> None:
        """The socket takes datagrams again."""
        self._full = False

    def error_received(self, exc: Exception) -> None:
        """A program's port is closed: its session ends by its silence."""

    async def _do(self, deed: Deed) -> None:
        """Ask the referee or give an order, and answer."""
        ack: dict[str, Any] = {"sequence": deed.sequence, "of": deed.kind}
        if deed.action is not None:
            reply = await self._live.act(deed.action)
            answer = Ack(**ack, accepted=reply.accepted, reason=reply.reason)
        else:
            answer = await self._order(deed, ack)
        self._coaches.finish(deed, answer)
        self._send(answer, deed.address)

    async def _order(self, deed: Deed, ack: dict[str, Any]) -> Ack:
        number: int | None = None
        try:
            for side in deed.sides:
                order = await self._live.order(side, **(deed.order or {}))
                number = order.sequence
        except TouchlineError as error:
            return Ack(**ack, accepted=False, reason=str(error))
        receipts = [self._live.orders.book.receipt(side, number or 0) for side in deed.sides]
        had = [name for receipt in receipts for name in receipt.acknowledged]
        robots = [name for name, its in self._live.sides.items() if its in deed.sides]
        missing = [name for name in robots if name not in had]
        return Ack(**ack, accepted=True, order=number, acknowledged=had, missing=missing)

    def _tell(self) -> None:
        """Frames to those who are due, and an end to those who have fallen silent."""
        now = self._live.now
        for address, session in tuple(self._coaches.sessions.items()):
            if session.is_over(now):
                self._coaches.end(address)
                self._send(Farewell(reason=f"nothing was heard for {SILENCE_S:g} s"), address)
                self._say(f"{session.role} program {session.name} has fallen silent")
            elif now >= session.due_at:
                session.due_at = max(session.due_at + 1.0 / session.rate, now)
                self._tell_one(session, address)

    def _tell_one(self, session: Session, address: Address) -> None:
        if self._full:
            return
        session.frames += 1
        own = sides_shown(session.role, to_all=False)
        self._send(self._frame(session, own), address)
        for side in own:
            for robot, belief in self._live.beliefs([side]).items():
                if session.beliefs_told.get(robot) != belief.time:
                    session.beliefs_told[robot] = belief.time
                    self._send(BeliefNews(number=session.frames, side=side, belief=belief), address)
        told = min(session.events_told, len(self._live.events)) if session.hosts == self._live.hosts else 0
        session.hosts = self._live.hosts
        session.events_told = min(len(self._live.events), told + _EVENTS_AT_ONCE)
        for number in range(told, session.events_told):
            self._tell_event(number, address)

    def _frame(self, session: Session, own: list[Side]) -> Frame:
        live, state = self._live, self._live.state
        modes = {}
        if state is not None:
            phases = {side: TeamPhase.of(state.phase, state.side, side) for side in Side}
            modes = {side: MatchMode.of_game(phase, running=state.running) for side, phase in phases.items()}
        orders = {}
        for side in own:
            standing = live.orders.book.standing(side)
            if standing is not None:
                orders[side] = SideOrder(order=standing.order.sequence, acknowledged=standing.acknowledged)
        return Frame(
            number=session.frames,
            host=live.there,
            match_mode=modes,
            state=state,
            events=len(live.events),
            orders=orders,
        )

    def _tell_event(self, number: int, address: Address) -> None:
        self._send(EventNews(number=number, event=self._live.events[number]), address)

    def _send(self, message: Part, address: Address) -> None:
        if self._transport is not None and not self._transport.is_closing():
            self._transport.sendto(message.model_dump_json().encode(), address)
