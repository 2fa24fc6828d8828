"""One example of each message, from one tick of a match."""

from msgspec import Raw

from schemas.config.match_config import MatchConfig
from schemas.config.roster import Placement
from schemas.config.sensors.compass import CompassReading
from schemas.config.sensors.contact import ContactReading
from schemas.config.sensors.range import RangeReading
from schemas.config.sensors.table import Reading
from schemas.messages.admission import AdmissionReply, AdmissionRequest
from schemas.messages.applied import Applied, AppliedInput
from schemas.messages.claim import AgentClaim, AgentClaimReply
from schemas.messages.coach import ActiveOrder, CoachMode, CoachOrder
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.debug import Debug, DebugCircle, DebugLine, RobotDebug
from schemas.messages.hardware import CallHealth, DeviceHealth, Fallback, HardwareHealth, HardwareState
from schemas.messages.health import AccountHealth, Health, Invalid, RobotHealth
from schemas.messages.manual import ManualDrive
from schemas.messages.pace import PaceOperation, PaceReply, PaceRequest
from schemas.messages.parameters import Parameter, ParameterOperation, ParametersReply, ParametersRequest
from schemas.messages.radio import BallBelief, Belief, Motion, Radio
from schemas.messages.record_batch import BatchEntry, RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.messages.recorder import RecorderProgress
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.messages.scene import SceneOperation, SceneReply, SceneRequest
from schemas.messages.setup import Setup, SetupRequest
from schemas.messages.sight import BallSight, Obstacle, Outcome, ReceivedRadio, Sight
from schemas.messages.soccer.game import ActionReply, GameEvent, GameState, GameView, RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation, SeatReply, SeatRequest
from schemas.messages.world import BallFrame, BallTruth, RobotFrame, RobotTruth, World
from schemas.side import Side
from schemas.soccer.game import ActionName, EventKind, Phase, Point, Score, TeamPhase
from schemas.wire.message import Message

_TICK, _TIME = 412, 8.24
_CYAN_2 = RobotTruth(x=3.1, y=-1.2, z=0.399, heading=0.31, vx=1.4, vy=0.45, omega=0.0, holding=True)
_MAGENTA_1 = RobotTruth(x=10.6, y=0.1, z=0.399, heading=-2.9, vx=0.0, vy=-0.2, omega=0.1, holding=False)
_BALL = BallTruth(x=3.433, y=-1.093, z=0.11, vx=1.4, vy=0.45, vz=0.0)
_ORDER = CoachOrder(sequence=7, mode=CoachMode.PLAY, tactic="press", max_speed=3.5)
_DRIVE = Drive(vx=1.5, vy=0.0, omega=0.3)
_KICK = Kick(mode=KickMode.LOB, speed=8.0)
_RADIO = Radio(
    self=Motion(x=3.12, y=-1.19, heading=0.3, vx=1.4, vy=0.45),
    ball=BallBelief(x=3.45, y=-1.1, vx=1.4, vy=0.45),
    role="striker",
    intention="pass to cyan4",
    pass_to="cyan4",
    extra={"pressed": True},
)
_DEBUG = Debug(
    values={"gap": 0.42, "plan": "pass"},
    lines=[DebugLine(x1=3.12, y1=-1.19, x2=7.5, y2=0.6, colour="orange")],
    circles=[DebugCircle(x=7.5, y=0.6, radius=0.5)],
)
_READINGS: dict[str, Reading] = {
    "front": RangeReading(age=0.0, angle_min=-0.75, angle_increment=0.5, distances=[2.4107, 2.2032, None, 0.951]),
    "north": CompassReading(age=0.0, heading=0.3187),
    "bumper": ContactReading(age=0.0, touched=[True, False, False, False]),
}


def examples() -> dict[type[Message], Message]:
    """Message → its example."""
    made = (*_truth(), *_robot(), *_game(), *_host())
    return {type(message): message for message in made}


def _truth() -> tuple[Message, ...]:
    return (
        World(
            tick=_TICK,
            time=_TIME,
            robots={"cyan2": _CYAN_2, "magenta1": _MAGENTA_1},
            ball=_BALL,
            possession="cyan2",
            touches=["magenta1", "cyan2"],
            clock=5.2,
            sensors={"cyan2": _READINGS},
        ),
        RobotFrame(tick=_TICK, time=_TIME, robot=_CYAN_2, side=Side.CYAN),
        BallFrame(tick=_TICK, time=_TIME, ball=_BALL),
    )


def _robot() -> tuple[Message, ...]:
    return (
        Sight(
            tick=_TICK,
            time=_TIME,
            robot="cyan2",
            side=Side.CYAN,
            self=Motion(x=3.1187, y=-1.1893, heading=0.3041, vx=1.42, vy=0.44, omega=0.0127),
            ball=BallSight(x=3.4512, y=-1.1034, z=0.1188, vx=1.37, vy=0.49),
            holding=True,
            obstacles=[Obstacle(x=4.2, y=0.6, radius=0.245), Obstacle(x=10.55, y=0.12, radius=0.245)],
            radio={"cyan1": ReceivedRadio(age=0.06, self=Motion(x=-10.4, y=0.0, heading=0.02), role="keeper")},
            game=GameView(phase=TeamPhase.PLAY, running=True, clock=5.2, our_score=1, their_score=0),
            order=_ORDER,
            outcome=Outcome(answers_tick=411, refused=["kick: ball not held"]),
            sensors=_READINGS,
        ),
        Command(
            answers_tick=_TICK,
            drive=_DRIVE,
            dribble=True,
            kick=_KICK,
            radio=_RADIO,
            acknowledges_order=_ORDER.sequence,
            debug=_DEBUG,
        ),
        HardwareHealth(
            time=8.31,
            robot="cyan2",
            state=HardwareState.ACTIVE,
            armed=True,
            fallback=Fallback.BRAKE,
            clamped=3,
            devices={"motion": DeviceHealth(readings=414, refused=1, rate=50.0, age=0.0021)},
            calls={"sense": CallHealth(calls=415, mean_ms=0.112, worst_ms=3.4)},
        ),
        ManualDrive(drive=Drive(vx=1.0, omega=-1.0), dribble=True),
        Belief(tick=_TICK + 1, time=_TIME + 0.02, robot="cyan2", radio=_RADIO),
        RobotDebug(tick=_TICK, time=_TIME, robot="cyan2", debug=_DEBUG),
        _ORDER,
        ActiveOrder(tick=_TICK, time=_TIME, order=_ORDER, acknowledged={"cyan1": True, "cyan2": True, "cyan3": False}),
    )


def _game() -> tuple[Message, ...]:
    return (
        GameState(
            tick=_TICK,
            time=_TIME,
            phase=Phase.THROW_IN,
            side=Side.MAGENTA,
            clock=5.2,
            score=Score(cyan=1),
            spot=Point(x=-3.9, y=6.85),
        ),
        GameEvent(
            tick=_TICK,
            time=_TIME,
            clock=5.2,
            kind=EventKind.GOAL,
            rule="goal",
            side=Side.CYAN,
            robot="cyan2",
            place=Point(x=11.11, y=-0.8),
            score=Score(cyan=1),
            text="goal, counts for cyan: ball over the goal line at (11.1, -0.8), 0.11 m high, last touched by cyan2",
        ),
        RefereeAction(action=ActionName.FREE_KICK, side=Side.MAGENTA, place=Point(x=2.0, y=-3.5)),
        ActionReply(accepted=False, reason="free_kick: no half is being played, the phase is half_time"),
        SeatRequest(operation=SeatOperation.TAKE, referee="gateway_5f0c6e1d", source="referee's page"),
        SeatReply(accepted=True, holder="referee's page (gateway_5f0c6e1d)"),
        AdmissionRequest(recorder="tape"),
        AdmissionReply(accepted=True),
    )


def _host() -> tuple[Message, ...]:
    return (
        SetupRequest(),
        AgentClaim(
            robot="cyan2",
            session="s5f0c6e1d9b3a",
            match="friendly",
            side=Side.CYAN,
            program="touchline 0.1.0",
            source="process 4711 on lab3",
        ),
        AgentClaimReply(accepted=False, reason="cyan2 has an agent already: process 4703 on lab2"),
        _setup(),
        *_parameters(),
        SceneRequest(operation=SceneOperation.PLACE, place=[Placement(body="ball", x=2.0, y=-1.0, vx=3.0)]),
        SceneReply(accepted=True, episode=1),
        PaceRequest(operation=PaceOperation.STEP, ticks=10),
        PaceReply(accepted=True, tick=_TICK, paused=False, until=_TICK + 10),
        Applied(
            tick=_TICK + 1,
            time=_TIME + 0.02,
            inputs={
                "cyan2": AppliedInput(drive=_DRIVE, dribble=True, kick=_KICK, answers_tick=_TICK),
                "magenta1": AppliedInput(drive=Drive(), dribble=False),
            },
            chain="9c1185a5c5e9fc54612808977ee8f548b2258d31b4c1a6bb1d6ea0a6a5f0f2a1",
        ),
        Health(
            tick=_TICK,
            time=_TIME,
            pace="lockstep",
            real_time_factor=4.6,
            worst_tick_ms=11.8,
            robots={"cyan2": RobotHealth(alive=True, answering=True, answers=412, refused=1, latency_ms=1.9)},
            recorders={"recorder": 9},
            accounts={"cyan": AccountHealth(messages=2060, size=329600, dropped={"over the limit of messages": 12})},
        ),
        Invalid(
            tick=_TICK,
            time=_TIME,
            key="robot/magenta1/command",
            reason="Command: drive.vx is 'fast'; m/s from -20 to 20",
            size=41,
        ),
        *_batches(),
        RecorderProgress(tick=403, messages=6045, lost=0),
        ReplayRequest(operation=ReplayOperation.SEEK, to="goal:1-5"),
        ReplayReply(accepted=True, time=3.24, end=28.02, rate=1.0, messages=2290),
    )


def _batches() -> tuple[Message, ...]:
    entry = BatchEntry(
        key="robot/cyan2/command",
        message=Raw(Command(answers_tick=_TICK, drive=_DRIVE).encode()),
        sequence=412,
        sent_ns=1_767_225_608_240_311_872,
        sim_ns=8_240_000_000,
        arrived_ns=1_767_225_608_240_498_113,
        arrived_sim_ns=8_240_000_000,
    )
    batch = RecordBatch(
        stream=1_767_225_600_000_171_392,
        number=51,
        tick=_TICK + 1,
        sent_ns=1_767_225_608_261_204_736,
        entries=[entry],
    )
    request = RecordBatchesRequest(first=51, last=52)
    return batch, request, RecordBatchesReply(stream=batch.stream, oldest=0, batches=[Raw(batch.encode())])


def _parameters() -> tuple[Message, ...]:
    rolling = Parameter(
        name="ball.rolling_deceleration",
        description="loss of speed of a ball that rolls freely",
        unit="m/s²",
        low=0.0,
        high=10.0,
        origin="simatch ball_decay_coef",
        value=1.2,
        initial=0.5,
    )
    return (
        ParametersRequest(operation=ParameterOperation.SET, values={"ball.rolling_deceleration": 1.2}),
        ParametersReply(accepted=True, parameters=[rolling]),
    )


def _setup() -> Setup:
    """The setup of the default match, which is played without a match file."""
    config = MatchConfig()
    profile, book = config.load_profile(), config.load_rule_book()
    return Setup.of(config, profile, book, {"engine": "pybullet 3.2.7, api 202010061"})
