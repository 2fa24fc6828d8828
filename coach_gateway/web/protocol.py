"""Messages between the page and its server: JSON over the WebSocket `/ws`, one message a frame.

The server begins with `Welcome`, then sends all that is known: whether the host is there, the newest state, health and
orders, every event so far in order, the newest frame, and the status of a replay. A page forgets everything whenever a
welcome comes. Another welcome comes when a token gives the page another role, and when a host comes back. Each message
of the page gets one `Reply` with its `id`; a `drive` only if it is refused.

Messages of the host are passed on whole, below a field that names them: an event has a `kind` of its own.
"""

from typing import Annotated, Any, Literal

from pydantic import Field, StringConstraints, TypeAdapter, ValidationError

from coach_gateway.access.roles import Role
from coach_gateway.match.orders import OrderContent
from schemas.messages.coach import CoachOrder
from schemas.messages.debug import RobotDebug
from schemas.messages.game import GameEvent, GameState, RefereeAction
from schemas.messages.health import Health
from schemas.messages.manual import ManualDrive
from schemas.messages.parameters import ParametersRequest
from schemas.messages.radio import Belief
from schemas.messages.referee_seat import SeatOperation
from schemas.messages.replay import ReplayReply, ReplayRequest
from schemas.messages.scene import SceneRequest
from schemas.messages.setup import Setup
from schemas.messages.world import World
from schemas.side import Side
from schemas.wire.faults import fault_of
from schemas.wire.message import Name, Part


class Welcome(Part):
    """The page's role, and what is played; everything sent before is void."""

    kind: Literal["welcome"] = "welcome"
    role: Role
    match: Name | None
    setup: Setup | None
    """None until the host has replied; then another welcome has it."""
    live: bool
    """True for a match, False for the replay of a recording."""
    deeds: list[str]
    """Deeds of this role: names of the referee's actions, and `order`, `scene`, `parameters`, `read_parameters`,
    `drive`, `replay`. A coach may do them for its own side alone."""
    beliefs: list[Side]
    """Sides whose robots' beliefs this role is shown."""
    debug: list[Side] = []
    """Sides whose robots' drawings this role is shown."""
    orders: list[Side]
    """Sides whose orders this role is shown."""
    scenes: dict[str, str] = {}
    """Scenes that can be loaded by name, with their descriptions."""


class HostUpdate(Part):
    """Whether the host of the match is there."""

    kind: Literal["host"] = "host"
    there: bool


class Frame(Part):
    """The newest tick, at most 25 times per second of wall time; ticks in between are left out.

    Numbers are rounded to three decimals: mm, mm/s, mrad, ms.
    """

    kind: Literal["frame"] = "frame"
    tick: int
    time: float
    world: World
    beliefs: dict[Name, Belief]
    """Newest beliefs of robots of the sides in `Welcome.beliefs`, in their team's frame."""
    debug: dict[Name, RobotDebug] = {}
    """Drawings of robots of the sides in `Welcome.debug` that belong to this tick, or to one of the last 0.5 s."""


class StateUpdate(Part):
    """The state of the game."""

    kind: Literal["state"] = "state"
    state: GameState


class EventUpdate(Part):
    """Something that happened. In a replay all events of the recording come after the welcome, and none again."""

    kind: Literal["event"] = "event"
    event: GameEvent


class HealthUpdate(Part):
    """The health of the host and of each robot's agent."""

    kind: Literal["health"] = "health"
    health: Health


class SideOrders(Part):
    """The active order of a side, and its acknowledgements."""

    order: CoachOrder | None = None
    acknowledged: dict[Name, bool] = {}
    """Robot of the side → whether it has acknowledged this order."""
    refused: dict[Name, str] = {}
    """Robot that does not carry it out → the reason."""


class OrdersUpdate(Part):
    """The orders of the sides in `Welcome.orders`; None for the others."""

    kind: Literal["orders"] = "orders"
    cyan: SideOrders | None = None
    magenta: SideOrders | None = None


class ReplayUpdate(Part):
    """The status of a replay, several times a second."""

    kind: Literal["replay"] = "replay"
    replay: ReplayReply


class RefBoxUpdate(Part):
    """Whether a league's referee box is connected: while it is, all actions of the referee except stop are locked."""

    kind: Literal["refbox"] = "refbox"
    connected: bool
    team: Side | None = None
    """Side whose base station is connected; None where both are, or where it is not known."""


class ResultUpdate(Part):
    """What is left of a match that is over; sent again when more of it is known."""

    kind: Literal["result"] = "result"
    figures: list[tuple[str, str, str]] = []
    """Name of a figure, its value for cyan and for magenta; empty until they are known, and without a recording."""
    statistics: str | None = None
    """Address of replay and statistics, relative to the page; None until they are known, and without a recording."""
    replay: str | None = None
    """The command that plays the recording again; None without one."""


class Alive(Part):
    """Sent twice a second. A page that receives nothing for several seconds has lost the connection."""

    kind: Literal["alive"] = "alive"


class Reply(Part):
    """The reply to the page's message of this number."""

    kind: Literal["reply"] = "reply"
    id: int | None
    """None where the number of the message could not be read."""
    accepted: bool
    reason: str = ""
    """Why it was refused."""
    answer: dict[str, Any] | None = None
    """Content of the host's `ParametersReply`, `SceneReply` or `ReplayReply`; of an order, the order as sent."""


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
    | ResultUpdate
    | Alive
    | Reply
    | Refusal
)
"""Any message of the server."""

Token = Annotated[str, StringConstraints(max_length=200)]


class _PageRequest(Part):
    """Fields of every message of the page."""

    id: Annotated[int, Field(ge=0, lt=2**53)]
    """Counted by the page; the reply has the same."""
    token: Token = ""
    """Empty for a spectator."""


class PageAction(_PageRequest):
    """Asks the referee for an action; `source` is filled in by the server."""

    deed: Literal["action"]
    action: RefereeAction


class PageOrder(_PageRequest):
    """Sends a side its new order; points in that team's frame."""

    deed: Literal["order"]
    side: Side
    order: OrderContent


class PageScene(_PageRequest):
    """Places, adds or removes bodies, loads a scene, or starts over."""

    deed: Literal["scene"]
    request: SceneRequest


class PageParameters(_PageRequest):
    """Reads, sets or resets live parameters."""

    deed: Literal["parameters"]
    request: ParametersRequest


class PageDrive(_PageRequest):
    """Drives a robot in place of its brain, 20 times a second; gets a reply only if it is refused."""

    deed: Literal["drive"]
    robot: Name
    manual: ManualDrive


class PageReplay(_PageRequest):
    """Controls a replay: play, pause, step, seek."""

    deed: Literal["replay"]
    request: ReplayRequest


class PageSeat(_PageRequest):
    """Shows, takes or leaves the seat of the referee."""

    deed: Literal["referee_seat"]
    operation: SeatOperation


class PageTokenCheck(_PageRequest):
    """Checks the token: a new welcome comes with another role; an unknown token is refused."""

    deed: Literal["token"]


PageRequest = Annotated[
    PageAction | PageOrder | PageScene | PageParameters | PageDrive | PageReplay | PageSeat | PageTokenCheck,
    Field(discriminator="deed"),
]
"""Any message of the page."""

PAGE_REQUEST: TypeAdapter[PageRequest] = TypeAdapter(PageRequest)
"""Reads a message of the page."""
_ENVELOPE = {"action": "action", "order": "order", "scene": "request", "parameters": "request", "replay": "request"}
_ENVELOPE |= {"drive": "manual", "token": ""}
"""Deed → the field of its message that holds what people have entered."""


def fault_sentence(error: ValidationError) -> str:
    """What is wrong with a message of the page, without the names of what is around the value that was entered."""
    fault = fault_of(error)
    steps = fault.path[1:] if fault.path and fault.path[0] in _ENVELOPE else fault.path
    if len(fault.path) > 1 and steps[:1] == (_ENVELOPE.get(str(fault.path[0])),):
        steps = steps[1:]
    return fault._replace(path=steps).sentence()


SERVER_MESSAGE: TypeAdapter[ServerMessage] = TypeAdapter(Annotated[ServerMessage, Field(discriminator="kind")])
"""Reads a message of the server."""
