"""What coach programs and the gateway say to each other: one JSON object a datagram, described in `docs/coach.md`.

Each datagram of a coach has a number larger than those before it, and is answered by an `ack` with that number. What
was not answered may be sent again with its number: it is done once, and answered again.
"""

from typing import Annotated, Literal

from pydantic import Field, StringConstraints, TypeAdapter

from coach_gateway.access.roles import Role
from coach_gateway.match.orders import OrderContent
from coach_gateway.udp.coach_record import MatchMode
from schemas.game import GameEvent, GameState, RefereeAction
from schemas.message import Name, Part
from schemas.messages.host import Belief
from schemas.side import Side

MAX_BYTES = 8192
"""A datagram that is longer is refused unread."""
DEFAULT_RATE, MAX_RATE = 20.0, 50.0
"""Frames a second."""


class _NumberedRequest(Part):
    """What every datagram of a coach has."""

    sequence: Annotated[int, Field(ge=1, lt=2**53, strict=True)]
    """Larger than that of every datagram before it in this session."""


class _InSession(_NumberedRequest):
    session: Annotated[str, StringConstraints(max_length=64)]
    """As the answer to `hello` gave it."""


class Hello(_NumberedRequest):
    """Begins a session; said again from the same address, another."""

    kind: Literal["hello"]
    token: Annotated[str, StringConstraints(max_length=200)]
    """A side's coach's, or the referee's."""
    name: Annotated[str, StringConstraints(max_length=40, pattern=r"^[^\x00-\x1f\x7f-\x9f]*$")] = "coach"
    """By what its actions are told of."""
    rate: Annotated[float, Field(ge=1.0, le=MAX_RATE)] = DEFAULT_RATE
    """Frames a second, of wall time."""


class ProgramOrder(_InSession):
    """Gives a side its new standing order."""

    kind: Literal["order"]
    side: Side | None = None
    """A coach's own when left out; the referee says which."""
    order: OrderContent
    """A `CoachOrder` without its number; points in that team's frame, SI."""
    test_mode: Annotated[int, Field(ge=0, le=99)] | None = None
    """The paper's number of a test, in place of `mode`, `test`, `with_ball` and `avoid` in the order."""


class ProgramMatchMode(_InSession):
    """Says what is to be played, in the words or numbers of the paper's coach record."""

    kind: Literal["match_mode"]
    mode: MatchMode | int
    side: Side | None = None
    """From whose point of view; a coach's own when left out, cyan's for the referee."""


class ProgramAction(_InSession):
    """Asks the referee for an action."""

    kind: Literal["action"]
    action: RefereeAction


class ProgramEvents(_InSession):
    """Asks for events once more, of which one was lost."""

    kind: Literal["events"]
    since: Annotated[int, Field(ge=0)]
    """Number of the first one wanted."""


class KeepAlive(_InSession):
    """Says that the program is still there; any other datagram does as well."""

    kind: Literal["alive"]


class Bye(_InSession):
    """Ends the session."""

    kind: Literal["bye"]


ProgramRequest = Annotated[
    Hello | ProgramOrder | ProgramMatchMode | ProgramAction | ProgramEvents | KeepAlive | Bye,
    Field(discriminator="kind"),
]
PROGRAM_REQUEST: TypeAdapter[ProgramRequest] = TypeAdapter(ProgramRequest)
"""Reads a datagram of a coach."""


class Ack(Part):
    """The answer to the datagram of that number."""

    kind: Literal["ack"] = "ack"
    sequence: int | None
    """Nothing where the datagram was so broken that it had none."""
    of: str = ""
    """Kind of the datagram."""
    accepted: bool
    reason: str = ""
    """Why it was refused."""
    duplicate: bool = False
    """It was answered before; nothing was done a second time."""
    session: str | None = None
    """Of a hello: what all further datagrams have to say."""
    role: Role | None = None
    """Of a hello: whom the token stands for."""
    order: int | None = None
    """Of an order: its number on the bus, which the robots acknowledge."""
    acknowledged: list[Name] = []
    """Of an order: robots that have acknowledged it so far; a frame tells of the others."""
    missing: list[Name] = []
    """Of an order: robots that have not."""


class SideOrder(Part):
    """A side's standing order, and who has acknowledged it."""

    order: int
    acknowledged: dict[Name, bool]


class Frame(Part):
    """How things stand, at the rate asked for."""

    kind: Literal["frame"] = "frame"
    number: int
    """Counts this session's frames, from 1; a gap is a loss."""
    host: bool
    """The host of the match is there."""
    match_mode: dict[Side, MatchMode] = {}
    """What is played, as each side sees it, in the words of the paper's coach record."""
    state: GameState | None = None
    events: int = 0
    """How many events there were so far."""
    orders: dict[Side, SideOrder] = {}
    """Of the coach's own side; of both for the referee."""


class BeliefUpdate(Part):
    """What a robot said last, after each frame, for every robot that said something new."""

    kind: Literal["belief"] = "belief"
    number: int
    """Of the frame it belongs to."""
    side: Side
    belief: Belief
    """In its team's frame."""


class EventUpdate(Part):
    """Something that happened, once; `events` asks for one that was lost."""

    kind: Literal["event"] = "event"
    number: int
    """Counts the match's events, from 0."""
    event: GameEvent


class SessionEnd(Part):
    """The session is over."""

    kind: Literal["bye"] = "bye"
    reason: str
