"""The topic table: every key with its message, publisher, readers, delivery, and whether it is recorded.

Access rules, the recorder, `docs/protocol.md` and the tests are derived from this table; a new topic is one row.
All keys are below `touchline/{match}/`.
"""

from functools import lru_cache

from schemas.messages.admission import AdmissionReply, AdmissionRequest
from schemas.messages.applied import Applied
from schemas.messages.claim import AgentClaim, AgentClaimReply
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.messages.command import Command
from schemas.messages.debug import RobotDebug
from schemas.messages.hardware import HardwareHealth
from schemas.messages.health import Health, Invalid
from schemas.messages.manual import ManualDrive
from schemas.messages.pace import PaceReply, PaceRequest
from schemas.messages.parameters import ParametersReply, ParametersRequest
from schemas.messages.radio import Belief
from schemas.messages.record_batch import RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.messages.recorder import RecorderProgress
from schemas.messages.replay import ReplayReply, ReplayRequest
from schemas.messages.scene import SceneReply, SceneRequest
from schemas.messages.setup import Setup, SetupRequest
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import ActionReply, GameEvent, GameState, RefereeAction
from schemas.messages.soccer.referee_seat import SeatReply, SeatRequest
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
    "true state of everything on the field at one tick, field frame",
)
WORLD_ROBOT = Topic(
    "world/{robot}",
    RobotFrame,
    Party.HOST,
    _WATCHERS,
    "each tick while there are subscribers",
    Delivery.NEWEST,
    False,
    "true state of one robot; `world` has the same",
)
WORLD_BALL = Topic(
    "world/ball",
    BallFrame,
    Party.HOST,
    _WATCHERS,
    "each tick while there are subscribers",
    Delivery.NEWEST,
    False,
    "true state of the ball; `world` has the same",
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
    "drive, dribbler, kick and radio message of this robot",
)
HARDWARE = Topic(
    "robot/{robot}/hardware",
    HardwareHealth,
    Party.ROBOT,
    (Party.RECORDER, Party.VIEWER),
    "4 Hz of wall time, of robots on hardware",
    Delivery.RECOVERED,
    False,
    "state of this robot's hardware: rates, times, refused readings, shortened demands",
    cache_size=8,  # 2 s
)
MANUAL = Topic(
    "robot/{robot}/manual",
    ManualDrive,
    Party.OPERATOR,
    (Party.HOST,),
    "20 Hz of wall time during manual control",
    Delivery.EVERY,
    False,
    "a person drives this robot in place of its brain",
    other_writers=(Party.COACH,),
)
BELIEF = Topic(
    "team/{side}/belief/{robot}",
    Belief,
    Party.HOST,
    (Party.COACH, Party.RECORDER),
    "each radio message",
    Delivery.EVERY,
    True,
    "the newest radio message of this robot",
)
DEBUG = Topic(
    "team/{side}/debug/{robot}",
    RobotDebug,
    Party.HOST,
    (Party.COACH, Party.RECORDER),
    "each tick in which the robot's command has one",
    Delivery.EVERY,
    True,
    "values and shapes that this robot's program shows its authors, field frame",
)
ORDER = Topic(
    "team/{side}/order",
    CoachOrder,
    Party.COACH,
    (Party.HOST, Party.RECORDER),
    _ON_CHANGE,
    Delivery.EVERY,
    True,
    "the coach's order",
)
ACTIVE_ORDER = Topic(
    "team/{side}/standing",
    ActiveOrder,
    Party.HOST,
    (Party.COACH, Party.RECORDER),
    "on change, and once a second, while an order is in force",
    Delivery.RECOVERED,
    True,
    "the order in force, and which robots have acknowledged it",
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
    "goals, stops, restarts, and their reasons",
)
ACTION = Topic(
    "game/action",
    RefereeAction,
    Party.REFEREE,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "a request to the referee: accepted, or refused with the reason",
    reply=ActionReply,
)
REFEREE_SEAT = Topic(
    "game/referee_seat",
    SeatRequest,
    Party.REFEREE,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "shows, takes or leaves the seat of the referee, which one referee holds at a time",
    reply=SeatReply,
)
SETUP = Topic(
    "host/setup",
    SetupRequest,
    Party.ROBOT,
    (Party.HOST,),
    "at start",
    Delivery.QUERY,
    False,
    "the setup of the match: pitch, bodies, limits, rules, names",
    reply=Setup,
    other_writers=(*_WATCHERS, Party.OPERATOR),
)
CLAIM = Topic(
    "host/claim",
    AgentClaim,
    Party.ROBOT,
    (Party.HOST,),
    "when an agent joins",
    Delivery.QUERY,
    False,
    "as `robot/{robot}/claim`, which takes its place; with credentials nobody may send it",
    reply=AgentClaimReply,
    names_sender=False,
)
ROBOT_CLAIM = Topic(
    "robot/{robot}/claim",
    AgentClaim,
    Party.ROBOT,
    (Party.HOST,),
    "when an agent joins",
    Delivery.QUERY,
    False,
    "claims this robot for an agent, or is refused with the reason",
    reply=AgentClaimReply,
)
PARAMETERS = Topic(
    "host/parameters",
    ParametersRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "lists, reads, sets and resets live parameters, or is refused with the reason",
    reply=ParametersReply,
)
SCENE = Topic(
    "host/scene",
    SceneRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "loads a scene, places, adds or removes bodies, or resets the world, or is refused with the reason",
    reply=SceneReply,
)
PACE = Topic(
    "host/pace",
    PaceRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "pauses the match, steps it tick by tick, or lets it run, or is refused with the reason",
    reply=PaceReply,
)
ADMISSION = Topic(
    "host/admission",
    AdmissionRequest,
    Party.REFEREE,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "admits a recorder that the host waits for",
    reply=AdmissionReply,
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
    "real-time factor, late ticks, answers and losses of each agent",
    cache_size=120,  # 30 s
)
INVALID = Topic(
    "host/invalid",
    Invalid,
    Party.HOST,
    (Party.COACH, Party.RECORDER, Party.VIEWER),
    "each invalid message, at most 50 Hz",
    Delivery.EVERY,
    True,
    "an invalid payload, and why it is invalid",
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
    (Party.HOST, Party.COACH, Party.REFEREE, Party.VIEWER),
    "5 to 20 Hz of wall time",
    Delivery.EVERY,
    False,
    "progress of a recorder",
)
REPLAY_CONTROL = Topic(
    "replay/control",
    ReplayRequest,
    Party.OPERATOR,
    (Party.HOST,),
    "on demand",
    Delivery.QUERY,
    False,
    "controls a replay, which takes the place of a host; refused with the reason",
    reply=ReplayReply,
)
ALIVE = Topic(
    "alive/{kind}/{name}",
    None,
    Party.HOST,
    (Party.HOST, *_ALL),
    "while the process lives",
    Delivery.PRESENCE,
    False,
    "token of a process: host, agent, session, coach, recorder, replay, referee; refbox while a referee box officiates",
    other_writers=_ALL,
)

TOPICS: dict[str, Topic] = {
    "world": WORLD,
    "world_robot": WORLD_ROBOT,
    "world_ball": WORLD_BALL,
    "sight": SIGHT,
    "command": COMMAND,
    "hardware": HARDWARE,
    "manual": MANUAL,
    "belief": BELIEF,
    "debug": DEBUG,
    "order": ORDER,
    "standing_order": ACTIVE_ORDER,
    "state": STATE,
    "event": EVENT,
    "action": ACTION,
    "setup": SETUP,
    "referee_seat": REFEREE_SEAT,
    "claim": CLAIM,
    "robot_claim": ROBOT_CLAIM,
    "parameters": PARAMETERS,
    "scene": SCENE,
    "pace": PACE,
    "admission": ADMISSION,
    "applied": APPLIED,
    "health": HEALTH,
    "invalid": INVALID,
    "record_batch": RECORD_BATCH,
    "record_batches": RECORD_BATCHES,
    "recorder_progress": RECORDER_PROGRESS,
    "replay_control": REPLAY_CONTROL,
    "alive": ALIVE,
}
"""Topic name → its row."""


@lru_cache(1024)
def recorded_topic(key: str) -> Topic | None:
    """The topic of a key in a recording; None if no recording has it."""
    recorded = (topic for topic in TOPICS.values() if topic.recorded or topic is SIGHT)
    return next((topic for topic in recorded if topic.match(key) is not None), None)


def key_prefix(match: str) -> str:
    """The prefix of every key of a match."""
    return f"touchline/{match}/"
