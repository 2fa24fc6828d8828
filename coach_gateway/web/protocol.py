"""What the page and its server say to each other: JSON over the WebSocket `/ws`, one message a frame.

The server begins with `Welcome`, then says how things stand: whether the host is there, the newest state, health and
orders, every event so far in order, the newest frame, and how a replay stands. A page forgets all that it knew whenever
a welcome comes: one comes again when the page asks what its token is worth, and when a host comes back. Each message of
the page is answered by one `Reply` with its `id`; a `drive` only where it is refused.

What the host says is handed on whole, below the word that names it: an event has a `kind` of its own.
"""

from typing import Annotated, Any, Literal

from pydantic import Field, StringConstraints, TypeAdapter

from coach_gateway.access.roles import Role
from coach_gateway.match.orders import OrderContent
from schemas.config.scene import SceneRequest
from schemas.game import GameEvent, GameState, RefereeAction
from schemas.message import Name, Part
from schemas.messages.coach import CoachOrder
from schemas.messages.host import Belief, Health, Setup
from schemas.messages.manual import ManualDrive
from schemas.messages.parameters import ParametersRequest
from schemas.messages.replay import ReplayReply, ReplayRequest
from schemas.messages.world import World
from schemas.side import Side

MAX_BYTES = 65_536
"""A message of the page that is longer is refused unread."""


class Welcome(Part):
    """Who one is and what is played; whatever was known before is void."""

    kind: Literal["welcome"] = "welcome"
    role: Role
    match: Name
    setup: Setup | None
    """Nothing while no host has said it; then another welcome brings it."""
    live: bool
    """A match; otherwise a recording that is replayed."""
    deeds: list[str]
    """What this role may do: names of the referee's actions, and `order`, `scene`, `parameters`, `read_parameters`,
    `drive`, `replay`. A coach may do them for its own side alone."""
    beliefs: list[Side]
    """Whose robots' beliefs this role is shown."""
    orders: list[Side]
    """Whose orders this role is shown."""
    scenes: dict[str, str] = {}
    """Scenes that can be loaded by name, and what each is for."""


class HostUpdate(Part):
    """Whether the host of the match is there."""

    kind: Literal["host"] = "host"
    there: bool


class Frame(Part):
    """The newest tick, up to 50 times in a second of wall time; those between are left out."""

    kind: Literal["frame"] = "frame"
    tick: int
    time: float
    world: World
    beliefs: dict[Name, Belief]
    """What robots of the sides in `Welcome.beliefs` said last, in their team's frame."""


class StateUpdate(Part):
    """The game as the referee sees it."""

    kind: Literal["state"] = "state"
    state: GameState


class EventUpdate(Part):
    """Something that happened. Of a replay all events of the recording come at the beginning, and none again."""

    kind: Literal["event"] = "event"
    event: GameEvent


class HealthUpdate(Part):
    """How the host is doing, and each robot's agent."""

    kind: Literal["health"] = "health"
    health: Health


class SideOrders(Part):
    """The standing order of a side, and who has taken it in."""

    order: CoachOrder | None = None
    acknowledged: dict[Name, bool] = {}
    """Robot of the side → it has acknowledged this order."""


class OrdersUpdate(Part):
    """The orders of the sides in `Welcome.orders`; nothing for the others."""

    kind: Literal["orders"] = "orders"
    cyan: SideOrders | None = None
    magenta: SideOrders | None = None


class ReplayUpdate(Part):
    """How a replay stands, several times a second."""

    kind: Literal["replay"] = "replay"
    replay: ReplayReply


class RefBoxUpdate(Part):
    """Whether a league's referee box officiates: while it does, all of the referee's actions but stop are locked."""

    kind: Literal["refbox"] = "refbox"
    connected: bool
    team: Side | None = None
    """As whose base station we are connected; nothing where that is both, or not known."""


class Alive(Part):
    """ServerMessage every second: who hears nothing for several has lost the line, though nobody closed it."""

    kind: Literal["alive"] = "alive"


class Reply(Part):
    """The answer to the page's message of this number."""

    kind: Literal["reply"] = "reply"
    id: int | None
    """Nothing where the message was so broken that it had none."""
    accepted: bool
    reason: str = ""
    """Why it was refused."""
    answer: dict[str, Any] | None = None
    """What the host said beside: the `ParametersReply`, `SceneReply`, `ReplayReply`; of an order the order as given."""


class Refusal(Part):
    """Why the server closes this connection; the page may try again after a while."""

    kind: Literal["refusal"] = "refusal"
    reason: str


ServerMessage = (
    Welcome
    | HostUpdate
    | Frame
    | StateUpdate
    | EventUpdate
    | HealthUpdate
    | OrdersUpdate
    | ReplayUpdate
    | RefBoxUpdate
    | Alive
    | Reply
    | Refusal
)
"""What the server says."""

Token = Annotated[str, StringConstraints(max_length=200)]


class _PageRequest(Part):
    """What every message of the page has."""

    id: Annotated[int, Field(ge=0)]
    """Counted by the page; its reply has the same."""
    token: Token = ""
    """None for a spectator."""


class PageAction(_PageRequest):
    """Asks the referee for an action; `source` is filled in by the server."""

    deed: Literal["action"]
    action: RefereeAction


class PageOrder(_PageRequest):
    """Gives a side its new standing order; points in that team's frame."""

    deed: Literal["order"]
    side: Side
    order: OrderContent


class PageScene(_PageRequest):
    """Sets bodies down, adds or removes some, loads a scene, begins anew."""

    deed: Literal["scene"]
    request: SceneRequest


class PageParameters(_PageRequest):
    """Reads, sets or resets live parameters."""

    deed: Literal["parameters"]
    request: ParametersRequest


class PageDrive(_PageRequest):
    """Drives a robot in place of its brain, 20 times a second; answered only where it is refused."""

    deed: Literal["drive"]
    robot: Name
    manual: ManualDrive


class PageReplay(_PageRequest):
    """Asks a replay to play, pause, step, seek."""

    deed: Literal["replay"]
    request: ReplayRequest


class PageTokenCheck(_PageRequest):
    """Asks what the token is worth: a new welcome comes, with this role; a token that is nobody's is refused."""

    deed: Literal["token"]


PageRequest = Annotated[
    PageAction | PageOrder | PageScene | PageParameters | PageDrive | PageReplay | PageTokenCheck,
    Field(discriminator="deed"),
]
"""What the page says."""

PAGE_REQUEST: TypeAdapter[PageRequest] = TypeAdapter(PageRequest)
"""Reads a message of the page."""
SERVER_MESSAGE: TypeAdapter[ServerMessage] = TypeAdapter(Annotated[ServerMessage, Field(discriminator="kind")])
"""Reads a message of the server."""
