"""Messages between coach programs and the gateway: one JSON object a datagram, described in `docs/coach_programs.md`.

Each datagram of a coach has a number larger than those before it, and gets an `ack` with that number. A datagram
without an `ack` may be sent again with its number: it is carried out once, and acknowledged again.
"""

from typing import Annotated, Literal

from pydantic import Field, StringConstraints, TypeAdapter

from coach_gateway.access.roles import Role
from coach_gateway.match.orders import OrderContent
from coach_gateway.udp.coach_record import MatchMode
from schemas.messages.game import GameEvent, GameState, RefereeAction
from schemas.messages.radio import Belief
from schemas.side import Side
from schemas.wire.message import Name, Part

MAX_BYTES = 8192
"""A datagram that is longer is refused unread."""
DEFAULT_RATE, MAX_RATE = 20.0, 50.0
"""Frames per second of wall time."""


class _NumberedRequest(Part):
    """Fields of every datagram of a coach."""

    sequence: Annotated[int, Field(ge=1, lt=2**53, strict=True)]
    """Larger than the sequence of every datagram before it in this session."""


class _InSession(_NumberedRequest):
    session: Annotated[str, StringConstraints(max_length=64)]
    """The session in the acknowledgement of the hello."""


class Hello(_NumberedRequest):
    """Begins a session; a further hello from the same address begins another one."""

    kind: Literal["hello"]
    token: Annotated[str, StringConstraints(max_length=200)]
    """The token of a side's coach, or of the referee."""
    name: Annotated[str, StringConstraints(max_length=40, pattern=r"^[^\x00-\x1f\x7f-\x9f]*$")] = "coach"
    """The name that the match records for its actions."""
    rate: Annotated[float, Field(ge=1.0, le=MAX_RATE)] = DEFAULT_RATE
    """Frames per second of wall time."""


class ProgramOrder(_InSession):
    """Sends a side its new order."""

    kind: Literal["order"]
    side: Side | None = None
    """By default the coach's own side; required from the referee."""
    order: OrderContent
    """A `CoachOrder` without its number; points in that team's frame, SI."""
    test_mode: Annotated[int, Field(ge=0, le=99)] | None = None
    """The paper's number of a test, in place of `mode`, `test`, `with_ball` and `avoid` in the order."""


class ProgramMatchMode(_InSession):
    """Requests what is to be played, by a word or number of the paper's coach record."""

    kind: Literal["match_mode"]
    mode: MatchMode | int
    side: Side | None = None
    """The side whose point of view it is; by default the coach's own, cyan for the referee."""


class ProgramAction(_InSession):
    """Asks the referee for an action."""

    kind: Literal["action"]
    action: RefereeAction


class ProgramEvents(_InSession):
    """Asks for past events again, after one was lost."""

    kind: Literal["events"]
    since: Annotated[int, Field(ge=0)]
    """Number of the first event to send."""


class KeepAlive(_InSession):
    """Keeps the session alive, as does any other datagram."""

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
    """The acknowledgement of the datagram of that number."""

    kind: Literal["ack"] = "ack"
    sequence: int | None
    """None where the number of the datagram could not be read."""
    of: str = ""
    """Kind of the datagram."""
    accepted: bool
    reason: str = ""
    """Why it was refused."""
    duplicate: bool = False
    """The datagram was acknowledged before; it was not carried out again."""
    session: str | None = None
    """Of a hello: the session of all further datagrams."""
    role: Role | None = None
    """Of a hello: the role of the token."""
    order: int | None = None
    """Of an order: its number on the bus, which the robots acknowledge."""
    acknowledged: list[Name] = []
    """Of an order: robots that have acknowledged it so far; later ones are in the frames."""
    missing: list[Name] = []
    """Of an order: robots that have not acknowledged it yet."""
    refused: dict[Name, str] = {}
    """Of an order: robot that does not carry it out → the reason, as far as is known; later ones are in the frames."""


class SideOrder(Part):
    """The number of a side's active order, and its acknowledgements."""

    order: int
    acknowledged: dict[Name, bool]
    refused: dict[Name, str] = {}
    """Robot that does not carry it out → the reason."""


class BelievedObstacle(Part):
    """An opponent or another body that is no robot of the team, as the team believes it, in its team frame."""

    x: float
    """x in the team frame, in m."""
    y: float
    """y in the team frame, in m."""
    age: float
    """Simulated time since it was sent, in s."""
    seen_by: list[Name]
    """The robots that believe it, the nearest first."""


class Frame(Part):
    """The state of the match, at the rate of the hello."""

    kind: Literal["frame"] = "frame"
    number: int
    """Counts this session's frames, from 1; a gap is a loss."""
    host: bool
    """The host of the match is there."""
    match_mode: dict[Side, MatchMode] = {}
    """What is played, from each side's point of view, in the words of the paper's coach record."""
    state: GameState | None = None
    events: int = 0
    """Number of events so far."""
    orders: dict[Side, SideOrder] = {}
    """The order of the coach's own side; of both sides for the referee."""
    obstacles: dict[Side, list[BelievedObstacle]] = {}
    """Opponents and other bodies as the coach's own side believes them; as both sides do for the referee."""


class BeliefUpdate(Part):
    """A robot's newest belief; sent after a frame for every robot with a new one."""

    kind: Literal["belief"] = "belief"
    number: int
    """Number of the frame that it belongs to."""
    side: Side
    belief: Belief
    """In its team's frame."""


class EventUpdate(Part):
    """Something that happened, sent once; `events` requests a lost one."""

    kind: Literal["event"] = "event"
    number: int
    """Counts the match's events, from 0."""
    event: GameEvent


class SessionEnd(Part):
    """The session is over."""

    kind: Literal["bye"] = "bye"
    reason: str
