"""Messages between the page and its server: JSON over the WebSocket `/ws`, one message a frame.

The server begins with `Welcome`, then sends all that is known: whether the host is there, the newest state, health and
orders, every event so far in order, the newest frame, and the status of a replay. A page forgets everything whenever a
welcome comes. Another welcome comes when a token gives the page another role, and when a host comes back. Each message
of the page gets one `Reply` with its `id`; a `drive` only if it is refused.

Messages of the host are passed on whole, below a field that names them: an event has a `kind` of its own.
"""

from typing import Annotated, Any

from msgspec import Meta

from coach_gateway.access.roles import TokenRole
from coach_gateway.match.orders import OrderContent
from schemas.messages.coach import CoachOrder
from schemas.messages.debug import RobotDebug
from schemas.messages.health import Health
from schemas.messages.manual import ManualDrive
from schemas.messages.parameters import ParametersRequest
from schemas.messages.radio import Belief
from schemas.messages.replay import ReplayReply, ReplayRequest, ReplayTopic
from schemas.messages.scene import SceneRequest
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState, RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation
from schemas.messages.world import World
from schemas.side import Side
from schemas.wire.faults import FaultError, FaultKind
from schemas.wire.message import Name
from schemas.wire.part import Part
from schemas.wire.part_faults import decoded
from schemas.wire.units import MAX_WHOLE


class Welcome(Part, tag_field="kind", tag="welcome"):
    """The page's role, and what is played; everything sent before is void."""

    role: TokenRole
    match: Name | None
    setup: Setup | None
    """None until the host has replied; then another welcome has it. None, too, with `topics`."""
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
    topics: list[ReplayTopic] = []
    """What is replayed if it is a file without a match; empty for a match, and for the recording of one."""


class HostUpdate(Part, tag_field="kind", tag="host"):
    """Whether the host of the match is there."""

    there: bool


class Frame(Part, tag_field="kind", tag="frame"):
    """The newest tick, at most 25 times per second of wall time; ticks in between are left out.

    Numbers are rounded to three decimals: mm, mm/s, mrad, ms.
    """

    tick: int
    time: float
    world: World
    beliefs: dict[Name, Belief]
    """Newest beliefs of robots of the sides in `Welcome.beliefs`, in their team's frame."""
    debug: dict[Name, RobotDebug] = {}
    """Drawings of robots of the sides in `Welcome.debug` that belong to this tick, or to one of the last 0.5 s."""


class StateUpdate(Part, tag_field="kind", tag="state"):
    """The state of the game."""

    state: GameState


class EventUpdate(Part, tag_field="kind", tag="event"):
    """Something that happened. In a replay all events of the recording come after the welcome, and none again."""

    event: GameEvent


class HealthUpdate(Part, tag_field="kind", tag="health"):
    """The health of the host and of each robot's agent."""

    health: Health


class SideOrders(Part):
    """The active order of a side, and its acknowledgements."""

    order: CoachOrder | None = None
    acknowledged: dict[Name, bool] = {}
    """Robot of the side → whether it has acknowledged this order."""
    refused: dict[Name, str] = {}
    """Robot that does not carry it out → the reason."""


class OrdersUpdate(Part, tag_field="kind", tag="orders"):
    """The orders of the sides in `Welcome.orders`; None for the others."""

    cyan: SideOrders | None = None
    magenta: SideOrders | None = None


class ReplayUpdate(Part, tag_field="kind", tag="replay"):
    """The status of a replay, several times a second."""

    replay: ReplayReply


class RefBoxUpdate(Part, tag_field="kind", tag="refbox"):
    """Whether a league's referee box is connected: while it is, all actions of the referee except stop are locked."""

    connected: bool
    team: Side | None = None
    """Side whose base station is connected; None where both are, or where it is not known."""


class ResultUpdate(Part, tag_field="kind", tag="result"):
    """What is left of a match that is over; sent again when more of it is known."""

    figures: list[tuple[str, str, str]] = []
    """Name of a figure, its value for cyan and for magenta; empty until they are known, and without a recording."""
    statistics: str | None = None
    """Address of replay and statistics, relative to the page; None until they are known, and without a recording."""
    replay: str | None = None
    """The command that plays the recording again; None without one."""


class Alive(Part, tag_field="kind", tag="alive"):
    """Sent twice a second. A page that receives nothing for several seconds has lost the connection."""


class Reply(Part, tag_field="kind", tag="reply"):
    """The reply to the page's message of this number."""

    id: int | None
    """None where the number of the message could not be read."""
    accepted: bool
    reason: str = ""
    """Why it was refused."""
    answer: dict[str, Any] | None = None
    """Content of the host's `ParametersReply`, `SceneReply` or `ReplayReply`; of an order, the order as sent."""


class PageRefusal(Part, tag_field="kind", tag="refusal"):
    """Why the server closes this connection; the page may try again after a while."""

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
    | PageRefusal
)
"""Any message of the server."""

Token = Annotated[str, Meta(max_length=200)]


class _PageRequest(Part, tag_field="deed"):
    """Fields of every message of the page."""

    id: Annotated[int, Meta(ge=0, le=MAX_WHOLE)]
    """Counted by the page; the reply has the same."""
    token: Token = ""
    """Empty for a spectator."""

    @property
    def deed(self) -> str:
        """Its kind, as in the message."""
        return str(self.__struct_config__.tag)


class PageAction(_PageRequest, tag="action"):
    """Asks the referee for an action; `source` and `referee` are filled in by the server."""

    action: RefereeAction


class PageOrder(_PageRequest, tag="order"):
    """Sends a side its new order; points in that team's frame."""

    side: Side
    order: OrderContent


class PageScene(_PageRequest, tag="scene"):
    """Places, adds or removes bodies, loads a scene, or starts over."""

    request: SceneRequest


class PageParameters(_PageRequest, tag="parameters"):
    """Reads, sets or resets live parameters."""

    request: ParametersRequest


class PageDrive(_PageRequest, tag="drive"):
    """Drives a robot in place of its brain, 20 times a second; gets a reply only if it is refused."""

    robot: Name
    manual: ManualDrive


class PageReplay(_PageRequest, tag="replay"):
    """Controls a replay: play, pause, step, seek."""

    request: ReplayRequest


class PageSeat(_PageRequest, tag="referee_seat"):
    """Shows, takes or leaves the seat of the referee."""

    operation: SeatOperation


class PageTokenCheck(_PageRequest, tag="token"):
    """Checks the token: a new welcome comes with another role; an unknown token is refused."""


PageRequest = PageAction | PageOrder | PageScene | PageParameters | PageDrive | PageReplay | PageSeat | PageTokenCheck
"""Any message of the page."""
_ENTERED = frozenset({"action", "order", "request", "manual"})
"""Fields that hold what people have entered."""


def read_request(text: str) -> PageRequest:
    """A message of the page.

    Raises:
        FaultError: it is invalid; the path begins at the value that was entered.
    """
    try:
        request: PageRequest = decoded(PageRequest, text)
    except FaultError as error:
        fault = error.fault
        is_entered = bool(_ENTERED & {*fault.path[:1]}) and (len(fault.path) > 1 or fault.kind is FaultKind.RULE)
        raise FaultError(fault._replace(path=fault.path[1:]) if is_entered else fault) from None
    return request
