"""The topic table: every key, what it carries, who writes, who may read, how it travels, whether it is recorded.

Access rules, the recorder, `docs/protocol.md` and the tests are derived from this table; a new topic is one row.
All keys stand below `touchline/{match}/`.
"""

from schemas.config.scene import SceneReply, SceneRequest
from schemas.game import ActionReply, GameEvent, GameState, RefereeAction
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.messages.command import Command
from schemas.messages.host import Applied, Belief, Health, Invalid, RecorderProgress, Setup, SetupRequest
from schemas.messages.manual import ManualDrive
from schemas.messages.parameters import ParametersReply, ParametersRequest
from schemas.messages.record_batch import RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.messages.recorder import RecorderReply, RecorderRequest
from schemas.messages.replay import ReplayReply, ReplayRequest
from schemas.messages.sight import Sight
from schemas.messages.world import BallFrame, RobotFrame, World
from schemas.recovery_window import BATCH_S, BATCH_TICKS, KEPT_BATCHES
from schemas.topic import Delivery, Party, Topic

_WATCHERS = (Party.COACH, Party.REFEREE, Party.RECORDER, Party.VIEWER)
_ALL = (Party.ROBOT, *_WATCHERS)
_ON_CHANGE = "on change"
_TICK = "each tick"

WORLD = Topic(
    "world",
    World,
    Party.HOST,
    _WATCHERS,
    _TICK,
    Delivery.EVERY,
    True,
    "whole truth of one tick, field frame",
)
WORLD_ROBOT = Topic(
    "world/{robot}",
    RobotFrame,
    Party.HOST,
    _WATCHERS,
    "each tick while somebody listens",
    Delivery.NEWEST,
    False,
    "truth of one robot; `world` holds the same",
)
WORLD_BALL = Topic(
    "world/ball",
    BallFrame,
    Party.HOST,
    _WATCHERS,
    "each tick while somebody listens",
    Delivery.NEWEST,
    False,
    "truth of the ball; `world` holds the same",
)
SIGHT = Topic(
    "robot/{robot}/sight",
    Sight,
    Party.HOST,
    (Party.ROBOT, Party.RECORDER),
    _TICK,
    Delivery.NEWEST,
    False,
    "what this robot perceives, team frame",
)
COMMAND = Topic(
    "robot/{robot}/command",
    Command,
    Party.ROBOT,
    (Party.HOST, Party.RECORDER),
    "each sight",
    Delivery.EVERY,
    True,
    "what this robot does",
)
MANUAL = Topic(
    "robot/{robot}/manual",
    ManualDrive,
    Party.OPERATOR,
    (Party.HOST,),
    "20 Hz of wall time while somebody drives",
    Delivery.EVERY,
    False,
    "a person drives this robot in place of its brain",
)
BELIEF = Topic(
    "team/{side}/belief/{robot}",
    Belief,
    Party.HOST,
    (Party.COACH, Party.RECORDER),
    "each word",
    Delivery.EVERY,
    True,
    "what this robot last said on the radio",
)
ORDER = Topic(
    "team/{side}/order",
    CoachOrder,
    Party.COACH,
    (Party.HOST, Party.RECORDER),
    _ON_CHANGE,
    Delivery.EVERY,
    True,
    "the coach's standing order",
)
ACTIVE_ORDER = Topic(
    "team/{side}/standing",
    ActiveOrder,
    Party.HOST,
    (Party.COACH, Party.RECORDER),
    "on change, and once a second, while an order stands",
    Delivery.RECOVERED,
    True,
    "the order that stands, and which robots have acknowledged it",
)
STATE = Topic(
    "game/state",
    GameState,
    Party.HOST,
    _ALL,
    "on change, and once a second",
    Delivery.RECOVERED,
    True,
    "phase, side, clock, score",
)
EVENT = Topic(
    "game/event",
    GameEvent,
    Party.HOST,
    _ALL,
    _ON_CHANGE,
    Delivery.RECOVERED,
    True,
    "goals, stops, restarts, and why",
)
ACTION = Topic(
    "game/action",
    RefereeAction,
    Party.COACH,
    (Party.HOST,),
    "at will",
    Delivery.QUERY,
    False,
    "a request to the referee: accepted, or refused with the reason",
    reply=ActionReply,
)
SETUP = Topic(
    "host/setup",
    SetupRequest,
    Party.ROBOT,
    (Party.HOST,),
    "at start",
    Delivery.QUERY,
    False,
    "how the match is set up: pitch, bodies, limits, rules, names",
    reply=Setup,
)
PARAMETERS = Topic(
    "host/parameters",
    ParametersRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "at will",
    Delivery.QUERY,
    False,
    "live parameters: listed, read, set, reset; refused with the reason",
    reply=ParametersReply,
)
SCENE = Topic(
    "host/scene",
    SceneRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "at will",
    Delivery.QUERY,
    False,
    "load a scene, place, add or remove bodies, begin anew; refused with the reason",
    reply=SceneReply,
)
APPLIED = Topic(
    "host/applied",
    Applied,
    Party.HOST,
    (Party.RECORDER, Party.VIEWER),
    _TICK,
    Delivery.EVERY,
    True,
    "inputs as applied at this tick, and the hash chain",
)
HEALTH = Topic(
    "host/health",
    Health,
    Party.HOST,
    _ALL,
    "4 Hz of wall time",
    Delivery.RECOVERED,
    True,
    "real-time factor, late ticks, each agent's answers and losses",
)
INVALID = Topic(
    "host/invalid",
    Invalid,
    Party.HOST,
    (Party.COACH, Party.RECORDER, Party.VIEWER),
    "each invalid message, at most 50 Hz",
    Delivery.EVERY,
    True,
    "a payload that was no valid message, and why",
)
RECORD_BATCH = Topic(
    "host/record_batch",
    RecordBatch,
    Party.HOST,
    (Party.RECORDER,),
    f"every {BATCH_TICKS} ticks, or {BATCH_S:g} s of wall time",
    Delivery.EVERY,
    False,
    "all messages to be recorded, as the host published or received them; recorders record them on their own keys",
)
RECORD_BATCHES = Topic(
    "host/record_batches",
    RecordBatchesRequest,
    Party.RECORDER,
    (Party.HOST,),
    "when batches are missing",
    Delivery.QUERY,
    False,
    f"batches that the host has published already; it keeps the last {KEPT_BATCHES}",
    reply=RecordBatchesReply,
)
RECORDER_PROGRESS = Topic(
    "record/{name}/progress",
    RecorderProgress,
    Party.RECORDER,
    (Party.HOST, Party.VIEWER),
    "5 to 20 Hz of wall time",
    Delivery.EVERY,
    False,
    "how far a recorder has come",
)
RECORDER_CONTROL = Topic(
    "record/{name}/control",
    RecorderRequest,
    Party.OPERATOR,
    (Party.RECORDER,),
    "at will",
    Delivery.QUERY,
    False,
    "pause, resume, split, snapshot, status of a recorder; refused with the reason",
    reply=RecorderReply,
)
REPLAY_CONTROL = Topic(
    "replay/control",
    ReplayRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "at will",
    Delivery.QUERY,
    False,
    "pause, step, seek, rate of a replay, which stands in for a host; refused with the reason",
    reply=ReplayReply,
)
ALIVE = Topic(
    "alive/{kind}/{name}",
    None,
    Party.ROBOT,
    (Party.HOST, *_WATCHERS),
    "while it lives",
    Delivery.PRESENCE,
    False,
    "liveliness token of a process: host, agent, coach, recorder; refbox: a league's referee box officiates; replay",
)

TOPICS: dict[str, Topic] = {
    "world": WORLD,
    "world_robot": WORLD_ROBOT,
    "world_ball": WORLD_BALL,
    "sight": SIGHT,
    "command": COMMAND,
    "manual": MANUAL,
    "belief": BELIEF,
    "order": ORDER,
    "standing_order": ACTIVE_ORDER,
    "state": STATE,
    "event": EVENT,
    "action": ACTION,
    "setup": SETUP,
    "parameters": PARAMETERS,
    "scene": SCENE,
    "applied": APPLIED,
    "health": HEALTH,
    "invalid": INVALID,
    "record_batch": RECORD_BATCH,
    "record_batches": RECORD_BATCHES,
    "recorder_progress": RECORDER_PROGRESS,
    "recorder_control": RECORDER_CONTROL,
    "replay_control": REPLAY_CONTROL,
    "alive": ALIVE,
}
"""Topic name → its row."""


def key_prefix(match: str) -> str:
    """What stands before every key of a match."""
    return f"touchline/{match}/"
