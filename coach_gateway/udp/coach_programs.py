"""The sessions of all coach programs: which datagrams are acknowledged at once, and which become requests. Pure."""

import hmac
import secrets
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from coach_gateway.access import rights
from coach_gateway.access.refusals import Refusals
from coach_gateway.access.roles import COACHES, TokenRole
from coach_gateway.udp.coach_record import BY_NUMBER, FOR_COACH, TEST_MODES, MatchMode, for_referee
from coach_gateway.udp.protocol import (
    MAX_BYTES,
    Ack,
    Bye,
    Hello,
    ProgramAction,
    ProgramEvents,
    ProgramMatchMode,
    ProgramOrder,
    ProgramRequest,
)
from coach_gateway.udp.session import Address, SequenceStatus, Session
from schemas.messages.coach import CoachMode
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName
from schemas.wire.faults import FaultError
from schemas.wire.part import json_object
from schemas.wire.part_faults import decoded

MOST_WAITING = 8
"""Datagrams of one program that may wait for the host's reply; a stop is always accepted."""
MOST_OF_A_ROLE = 20
"""Programs of one role that may be connected at the same time: each side's coach leaves room for the others."""


@dataclass(frozen=True, slots=True)
class PendingRequest:
    """An action or an order of a program that is carried out before it is acknowledged."""

    session: Session
    address: Address
    sequence: int
    kind: str
    action: RefereeAction | None = None
    sides: tuple[Side, ...] = ()
    """The sides that an order is for."""
    order: Mapping[str, Any] | None = None

    @property
    def is_stop(self) -> bool:
        """Whether the request stops the game."""
        return self.action is not None and self.action.action is ActionName.STOP


@dataclass(frozen=True, slots=True)
class DatagramResult:
    """What follows from a datagram: an acknowledgement, a request to carry out, or nothing."""

    ack: Ack | None = None
    request: PendingRequest | None = None
    events_since: int | None = None
    """Number of the first event to send again."""


_NOTHING = DatagramResult()
_Pending = Callable[..., PendingRequest]
"""Makes the request of a datagram, which names its program and its number."""


class CoachPrograms:
    """The sessions, by the source address of their datagrams."""

    def __init__(self, role_of: Callable[[str], TokenRole | None], log: Callable[[str], None] = lambda _: None) -> None:
        """`role_of` returns the role of a token."""
        self._role_of = role_of
        self.refusals = Refusals("coach programs", log)
        """Refused datagrams by kind."""
        self.sessions: dict[Address, Session] = {}

    def handle(self, data: bytes, address: Address, now: float, robots: Mapping[str, Side]) -> DatagramResult:
        """Handle a datagram at wall time `now` in s; `robots` are all robots of the match with their sides."""
        ask = _read(data)
        if isinstance(ask, Ack):
            self._note("unreadable datagram", address, ask.reason)
            return DatagramResult(ask)
        if isinstance(ask, Hello):
            ack = self._begin(ask, address, now)
            if not ack.accepted:
                self._note("hello", address, ack.reason)
            return DatagramResult(ack)
        session = self.sessions.get(address)
        if session is None or not hmac.compare_digest(session.key.encode(), ask.session.encode()):
            self._note("datagram of an unknown session", address)
            return DatagramResult(
                _refused(ask, "unknown session; send a hello, and use the session of its acknowledgement")
            )
        session.heard_at = now
        return self._dispatch(session, ask, address, robots)

    def _note(self, kind: str, address: Address, reason: str = "") -> None:
        self.refusals.note(kind, str(address[0]), reason)

    def end(self, address: Address) -> None:
        """End the session of an address."""
        self.sessions.pop(address, None)

    def finish(self, request: PendingRequest, ack: Ack) -> None:
        """Keep the acknowledgement of a request, in case its datagram comes again."""
        request.session.answered(request.sequence, ack)

    def _begin(self, hello: Hello, address: Address, now: float) -> Ack:
        """Begin a session; a repeated hello gets the acknowledgement of the session that it began.

        A hello after any other datagram is from a restarted program, whatever its number.
        """
        session = self.sessions.get(address)
        role = self._role_of(hello.token)
        if role is None or role is TokenRole.SPECTATOR:
            return _refused(hello, "unknown token; use that of a side's coach or of the referee")
        if session is not None and session.role is role and hello.sequence == session.newest:
            known = session.answer(hello.sequence)
            if known is not None and known.of == "hello":
                session.heard_at = now
                return known.replace(duplicate=True)
        if sum(other.role is role for at, other in self.sessions.items() if at != address) >= MOST_OF_A_ROLE:
            return _refused(hello, f"{MOST_OF_A_ROLE} programs with {role.value}'s token are connected: the limit")
        session = Session(secrets.token_urlsafe(12), role, hello.name, now, hello.rate)
        self.sessions[address] = session
        session.check(hello.sequence)
        ack = Ack(sequence=hello.sequence, of=hello.kind, accepted=True, session=session.key, role=role)
        session.answered(hello.sequence, ack)
        return ack

    def _dispatch(self, session: Session, ask: Any, address: Address, robots: Mapping[str, Side]) -> DatagramResult:
        status = session.check(ask.sequence)
        if status is SequenceStatus.LATE:
            reason = "late: a datagram with a larger number has been received; send it again with a new number"
            return DatagramResult(_refused(ask, reason))
        if status is SequenceStatus.UNANSWERED:
            return _NOTHING
        if status is SequenceStatus.ANSWERED:
            before = session.answer(ask.sequence)
            return DatagramResult(before.replace(duplicate=True)) if before is not None else _NOTHING
        done = self._do(session, ask, address, robots)
        if isinstance(done, PendingRequest) and session.waiting > MOST_WAITING and not done.is_stop:
            done = f"{MOST_WAITING} datagrams of this program still wait for their acknowledgements"
        if isinstance(done, PendingRequest):
            return DatagramResult(request=done)
        ack = Ack(sequence=ask.sequence, of=ask.kind, accepted=not done, reason=done)
        session.answered(ask.sequence, ack)
        if isinstance(ask, Bye):
            self.end(address)
        return DatagramResult(ack, events_since=ask.since if isinstance(ask, ProgramEvents) else None)

    def _do(
        self, session: Session, ask: ProgramRequest, address: Address, robots: Mapping[str, Side]
    ) -> PendingRequest | str:
        """The request to carry out; otherwise the reason of a refusal, empty where nothing is left to do."""
        pending = partial(PendingRequest, session, address, ask.sequence, ask.kind)
        match ask:
            case ProgramAction():
                return _act(pending, session, ask.action, robots)
            case ProgramOrder():
                return _order(pending, session, ask, robots)
            case ProgramMatchMode():
                return _match_mode(pending, session, ask, robots)
        return ""


def _read(data: bytes) -> Any:
    """The valid datagram, or the refusal of an invalid one."""
    if len(data) > MAX_BYTES:
        return Ack(sequence=None, accepted=False, reason=f"{len(data)} bytes, at most {MAX_BYTES}")
    try:
        return decoded(ProgramRequest, data)
    except FaultError as error:
        said = json_object(data)
        number, kind = said.get("sequence"), said.get("kind")
        return Ack(
            sequence=number if isinstance(number, int) and not isinstance(number, bool) else None,
            of=kind if isinstance(kind, str) and len(kind) <= 20 else "",
            accepted=False,
            reason=str(error)[:300],
        )


def _refused(ask: Any, reason: str) -> Ack:
    return Ack(sequence=ask.sequence, of=ask.kind, accepted=False, reason=reason)


def _act(
    pending: _Pending, session: Session, action: RefereeAction, robots: Mapping[str, Side]
) -> PendingRequest | str:
    why = rights.refusal(session.role, action.action.value, robots, robot=action.robot)
    if why is not None:
        return why
    return pending(action=action.replace(source=f"coach program {session.name}", referee=None))


def _order(pending: _Pending, session: Session, ask: ProgramOrder, robots: Mapping[str, Side]) -> PendingRequest | str:
    side = ask.side or COACHES.get(session.role)
    if side is None:
        return "the referee's order has to name its side"
    why = rights.refusal(session.role, "order", robots, side=side)
    if why is not None:
        return why
    content = ask.order.content()
    if ask.test_mode is not None:
        tested = TEST_MODES.get(ask.test_mode)
        if tested is None:
            return f"test_mode is {ask.test_mode}; known: {', '.join(map(str, TEST_MODES))}"
        content |= {"mode": CoachMode.TEST, **tested._asdict()}
    return pending(sides=(side,), order=content)


def _match_mode(
    pending: _Pending, session: Session, ask: ProgramMatchMode, robots: Mapping[str, Side]
) -> PendingRequest | str:
    mode = ask.mode if isinstance(ask.mode, MatchMode) else BY_NUMBER.get(ask.mode)
    if mode is None:
        return f"mode is {ask.mode}; known: {', '.join(str(known.number) for known in MatchMode)}"
    if mode is MatchMode.TEST:
        return "a test is an order, which names the test"
    own = COACHES.get(session.role)
    if own is not None and ask.side not in (None, own):
        return f"the match mode of {ask.side} is not for {own.value}'s coach"
    meaning = FOR_COACH.get(mode) if own is not None else for_referee(mode, ask.side or Side.CYAN)
    if meaning is None:
        return f"{mode.value} is for the referee alone: it needs the referee's token"
    if meaning.action is not None:
        return _act(pending, session, RefereeAction(action=meaning.action, side=meaning.side), robots)
    sides = (own,) if own is not None else tuple(Side) if ask.side is None else (ask.side,)
    return pending(sides=sides, order={"mode": meaning.order})
