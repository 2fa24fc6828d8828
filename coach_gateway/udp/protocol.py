"""Messages between coach programs and the gateway: one JSON object a datagram, described in `docs/coach_programs.md`.

Each datagram of a coach has a number larger than those before it, and gets an `ack` with that number. A datagram
without an `ack` may be sent again with its number: it is carried out once, and acknowledged again.
"""

from typing import Annotated

from msgspec import Meta

from coach_gateway.access.roles import TokenRole
from coach_gateway.match.orders import OrderContent
from coach_gateway.match.team_obstacles import TeamObstacle
from coach_gateway.udp.coach_record import MatchMode
from schemas.messages.radio import Belief
from schemas.messages.soccer.game import GameEvent, GameState, RefereeAction
from schemas.side import Side
from schemas.wire.message import PRINTABLE, Name
from schemas.wire.part import Part
from schemas.wire.units import MAX_WHOLE

MAX_BYTES = 8192
"""A datagram that is longer is refused unread."""
DEFAULT_RATE, MAX_RATE = 20.0, 50.0
"""Frames per second of wall time."""


class _NumberedRequest(Part, tag_field="kind"):
    """Fields of every datagram of a coach."""

    sequence: Annotated[int, Meta(ge=1, le=MAX_WHOLE)]
    """Larger than the sequence of every datagram before it in this session."""

    @property
    def kind(self) -> str:
        """Its kind, as in the datagram."""
        return str(self.__struct_config__.tag)


class _InSession(_NumberedRequest):
    session: Annotated[str, Meta(max_length=64)]
    """The session in the acknowledgement of the hello."""


class Hello(_NumberedRequest, tag="hello"):
    """Begins a session; a further hello from the same address begins another one."""

    token: Annotated[str, Meta(max_length=200)]
    """The token of a side's coach, or of the referee."""
    name: Annotated[str, Meta(max_length=40, pattern=PRINTABLE)] = "coach"
    """The name that the match records for its actions."""
    rate: Annotated[float, Meta(ge=1.0, le=MAX_RATE)] = DEFAULT_RATE
    """Frames per second of wall time."""


class ProgramOrder(_InSession, tag="order"):
    """Sends a side its new order."""

    side: Side | None = None
    """By default the coach's own side; required from the referee."""
    order: OrderContent
    """A `CoachOrder` without its number; points in that team's frame, SI."""
    test_mode: Annotated[int, Meta(ge=0, le=99)] | None = None
    """The paper's number of a test, in place of `mode`, `test`, `with_ball` and `avoid` in the order."""


class ProgramMatchMode(_InSession, tag="match_mode"):
    """Requests what is to be played, by a word or number of the paper's coach record."""

    mode: MatchMode | int
    side: Side | None = None
    """The side whose point of view it is; by default the coach's own, cyan for the referee."""


class ProgramAction(_InSession, tag="action"):
    """Asks the referee for an action; source and referee are filled in by the server."""

    action: RefereeAction


class ProgramEvents(_InSession, tag="events"):
    """Asks for past events again, after one was lost."""

    since: Annotated[int, Meta(ge=0)]
    """Number of the first event to send."""


class KeepAlive(_InSession, tag="alive"):
    """Keeps the session alive, as does any other datagram."""


class Bye(_InSession, tag="bye"):
    """Ends the session."""


ProgramRequest = Hello | ProgramOrder | ProgramMatchMode | ProgramAction | ProgramEvents | KeepAlive | Bye
"""Any datagram of a coach."""


class Ack(Part, tag_field="kind", tag="ack"):
    """The acknowledgement of the datagram of that number."""

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
    role: TokenRole | None = None
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


class Frame(Part, tag_field="kind", tag="frame"):
    """The state of the match, at the rate of the hello."""

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
    obstacles: dict[Side, list[TeamObstacle]] = {}
    """Opponents and other bodies as the coach's own side believes them; as both sides do for the referee."""


class BeliefUpdate(Part, tag_field="kind", tag="belief"):
    """A robot's newest belief; sent after a frame for every robot with a new one."""

    number: int
    """Number of the frame that it belongs to."""
    side: Side
    belief: Belief
    """In its team's frame."""


class EventUpdate(Part, tag_field="kind", tag="event"):
    """Something that happened, sent once; `events` requests a lost one."""

    number: int
    """Counts the match's events, from 0."""
    event: GameEvent


class SessionEnd(Part, tag_field="kind", tag="bye"):
    """The session is over."""

    reason: str
