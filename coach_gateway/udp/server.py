"""The socket that coach programs use. No program waits for another; lost datagrams show as gaps in the numbers."""

import asyncio
import socket
from collections.abc import Callable
from typing import Any

from coach_gateway.access.rights import sides_shown
from coach_gateway.access.roles import TokenRole
from coach_gateway.match.live import LiveMatch
from coach_gateway.service import pause
from coach_gateway.timing import POLL_S, SILENCE_S
from coach_gateway.udp.coach_programs import CoachPrograms, PendingRequest
from coach_gateway.udp.coach_record import MatchMode
from coach_gateway.udp.protocol import Ack, BeliefUpdate, EventUpdate, Frame, SessionEnd, SideOrder
from coach_gateway.udp.session import Address, Session
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.soccer.game import TeamPhase
from schemas.wire.part import Part

_EVENTS_AT_ONCE = 50
"""Events sent at most with one frame, or for one request for events: more would be lost in a full buffer."""


class UdpServer(asyncio.DatagramProtocol):
    """All coach programs of a match."""

    def __init__(
        self,
        live: LiveMatch,
        role_of: Callable[[str], TokenRole | None],
        log: Callable[[str], None],
        bound: socket.socket,
    ) -> None:
        """`role_of` returns the role of a token; `log` is called with lines for people; `bound` is the socket."""
        self._live = live
        self._log = log
        self._bound = bound
        self._coaches = CoachPrograms(role_of, log)
        self._transport: asyncio.DatagramTransport | None = None
        self._full = False
        """The socket's buffer is full: frames are left out."""
        self._tasks: dict[asyncio.Task[None], None] = {}
        self.port = 0
        """Where it listens, once it does."""

    async def serve(self, stop: asyncio.Event) -> None:
        """Receive datagrams of coach programs and send them frames until `stop` is set."""
        loop = asyncio.get_running_loop()
        transport, _ = await loop.create_datagram_endpoint(lambda: self, sock=self._bound)
        self._transport = transport
        host, self.port = transport.get_extra_info("sockname")[:2]
        self._log(f"coach programs over UDP on {host}:{self.port}")
        try:
            while not await pause(stop, POLL_S):
                self._send_due()
        finally:
            for task in tuple(self._tasks):
                task.cancel()
            for address in self._coaches.sessions:
                self._send(SessionEnd(reason="the gateway is shutting down"), address)
            transport.close()
            self._coaches.refusals.log_summary()

    def datagram_received(self, data: bytes, addr: Address) -> None:
        """Handle a datagram."""
        result = self._coaches.handle(data, addr, self._live.now, self._live.sides)
        if result.ack is not None:
            self._send(result.ack, addr)
            if result.ack.of == "hello" and result.ack.accepted and not result.ack.duplicate:
                self._log(f"{result.ack.role} program from {addr[0]}:{addr[1]}")
        if result.events_since is not None:
            for number in range(
                result.events_since, min(len(self._live.follower.events), result.events_since + _EVENTS_AT_ONCE)
            ):
                self._send_event(number, addr)
        if result.request is not None:
            task = asyncio.get_running_loop().create_task(self._do(result.request))
            self._tasks[task] = None
            task.add_done_callback(lambda done: self._tasks.pop(done, None))

    def pause_writing(self) -> None:
        """Leave out frames: the socket's buffer is full."""
        self._full = True

    def resume_writing(self) -> None:
        """Send frames again: the socket's buffer has room."""
        self._full = False

    def error_received(self, exc: Exception) -> None:
        """Ignore that a program's port is closed: its session ends by its silence."""

    async def _do(self, request: PendingRequest) -> None:
        """Ask the referee or send an order, and acknowledge the datagram."""
        ack: dict[str, Any] = {"sequence": request.sequence, "of": request.kind}
        if request.action is not None:
            reply = await self._live.act(request.action)
            answer = Ack(**ack, accepted=reply.accepted, reason=reply.reason)
        else:
            answer = await self._order(request, ack)
        self._coaches.finish(request, answer)
        self._send(answer, request.address)

    async def _order(self, request: PendingRequest, ack: dict[str, Any]) -> Ack:
        number: int | None = None
        try:
            for side in request.sides:
                order = await self._live.order(side, **(request.order or {}))
                number = order.sequence
        except TouchlineError as error:
            return Ack(**ack, accepted=False, reason=str(error))
        receipts = [self._live.follower.orders.receipt(side, number or 0) for side in request.sides]
        had = [name for receipt in receipts for name in receipt.acknowledged]
        robots = [name for name, its in self._live.sides.items() if its in request.sides]
        missing = [name for name in robots if name not in had]
        refused = {name: why for receipt in receipts for name, why in receipt.refused.items()}
        return Ack(**ack, accepted=True, order=number, acknowledged=had, missing=missing, refused=refused)

    def _send_due(self) -> None:
        """Send frames to sessions that are due, and end those that have fallen silent."""
        now = self._live.now
        for address, session in tuple(self._coaches.sessions.items()):
            if session.is_over(now):
                self._coaches.end(address)
                self._send(SessionEnd(reason=f"nothing was received for {SILENCE_S:g} s"), address)
                self._log(f"{session.role} program {session.name} has fallen silent")
            elif now >= session.due_at:
                session.due_at = max(session.due_at + 1.0 / session.rate, now)
                self._send_frame(session, address)

    def _send_frame(self, session: Session, address: Address) -> None:
        if self._full:
            return
        session.frames += 1
        own = sides_shown(session.role, to_all=False)
        self._send(self._frame(session, own), address)
        for side in own:
            for robot, belief in self._live.beliefs([side]).items():
                if session.beliefs_sent.get(robot) != belief.time:
                    session.beliefs_sent[robot] = belief.time
                    self._send(BeliefUpdate(number=session.frames, side=side, belief=belief), address)
        match = self._live.follower
        sent = min(session.events_sent, len(match.events)) if session.host_changes == match.host_changes else 0
        session.host_changes = match.host_changes
        session.events_sent = min(len(match.events), sent + _EVENTS_AT_ONCE)
        for number in range(sent, session.events_sent):
            self._send_event(number, address)

    def _frame(self, session: Session, own: list[Side]) -> Frame:
        live, state = self._live, self._live.state
        modes = {}
        if state is not None:
            phases = {side: TeamPhase.of(state.phase, state.side, side) for side in Side}
            modes = {side: MatchMode.of_game(phase, running=state.running) for side, phase in phases.items()}
        orders = {}
        for side in own:
            active = live.follower.orders.active(side)
            if active is not None:
                orders[side] = SideOrder(
                    order=active.order.sequence, acknowledged=active.acknowledged, refused=active.refused
                )
        return Frame(
            number=session.frames,
            host=live.follower.host_present,
            match_mode=modes,
            state=state,
            events=len(live.follower.events),
            orders=orders,
            obstacles={side: live.obstacles(side) for side in own},
        )

    def _send_event(self, number: int, address: Address) -> None:
        self._send(EventUpdate(number=number, event=self._live.follower.events[number]), address)

    def _send(self, message: Part, address: Address) -> None:
        if self._transport is not None and not self._transport.is_closing():
            self._transport.sendto(message.json().encode(), address)
