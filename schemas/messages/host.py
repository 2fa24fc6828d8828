"""What the host says of itself: how the match is set up, what it applied, how it is doing."""

from collections.abc import Mapping
from typing import Annotated, Any, Self

import msgspec
from pydantic import Field

from schemas.config.foul_book import Areas, Fouls, Handling, Scoring
from schemas.config.match_config import MatchConfig
from schemas.config.obstacle import StaticObstacle
from schemas.config.profile import STANDARD, Profile
from schemas.config.robot_model import RobotModel, types_of
from schemas.config.roster import Placement, RosterEntry
from schemas.config.rule_book import Periods, Restarts, RuleBook
from schemas.config.sections import Ball, Dribble, DriveLimits, Kicker, Pitch, RobotBody, TimeSteps
from schemas.game import OfficiatingMode
from schemas.message import BadMessageError, Message, Name, Part
from schemas.messages.command import Drive, Kick, Radio
from schemas.messages.parameters import ParameterName, Setting
from schemas.side import Side
from schemas.struct import Struct, encode

_EMPTY: Mapping[str, Any] = {}
_decode_fields = msgspec.json.Decoder(dict[str, Any]).decode


class SetupRequest(Message):
    """Asks the host how the match is set up."""


class TeamSetup(Part):
    """One team: its robots in order."""

    name: str
    """Name of the team, for display."""
    robots: list[Name]
    """Names of the robots, the goalkeeper first."""
    types: dict[Name, Name] = Field(default_factory=dict)
    """Robot → its type; a robot that is not named here is a standard one."""
    goalkeeper: bool = True
    """The first on the field is the goalkeeper; without one, all play in the field."""


class Setup(Message):
    """Everything a robot or a viewer must know of a match before its first tick.

    `robot`, `drive`, `dribble` and `kicker` are those of the standard robot.
    """

    match: Name
    """Name of the match: the chunk of the keys behind `touchline/`."""
    pace: str
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    profile: str
    """Name of the profile: the physical numbers of the match."""
    rules: str
    """Name of the rule book: the numbers that the match is refereed by."""
    time: TimeSteps
    """How time is cut into ticks and physics steps."""
    pitch: Pitch
    """Dimensions of the pitch, its goals and its boundary."""
    robot: RobotBody
    """Body of the standard robot."""
    ball: Ball
    """Body of the ball."""
    drive: DriveLimits
    """Limits of the standard robot's drive."""
    dribble: Dribble
    """Dribbler of the standard robot."""
    kicker: Kicker
    """Kicker of the standard robot."""
    periods: Periods
    """Halves, breaks, extra time and penalty shoot-out."""
    restarts: Restarts
    """Distances and times of restarts."""
    handling: Handling | None = None
    """How robots may handle the ball; None in recordings from before these rules."""
    scoring: Scoring | None = None
    """Which goals count; None in recordings from before these rules."""
    fouls: Fouls | None = None
    """Which fouls are called; None in recordings from before these rules."""
    officiating: OfficiatingMode | None = None
    """Who decides; None in recordings from before this field."""
    areas: Areas | None = None
    """Who may be in goal areas and penalty areas, and for how long; None in recordings from before these rules."""
    teams: dict[Side, TeamSetup]
    """Side → its team."""
    models: dict[Name, RobotModel] = Field(default_factory=dict)
    """Type → model; `standard` for every robot that no type is given for."""
    engine: dict[str, str] = Field(default_factory=dict)
    """Fingerprint of what computes the world: engine version, the maths library's answers."""
    parameters: dict[ParameterName, Setting] = Field(default_factory=dict)
    """Live parameters that are not what the match began with, and their values; the numbers above have them already."""
    orders: dict[Side, int] = Field(default_factory=dict)
    """Side → number of the coach's order that stands; the next one's is larger."""

    @classmethod
    def of(
        cls,
        config: MatchConfig,
        profile: Profile,
        book: RuleBook,
        engine: Mapping[str, str] = _EMPTY,
        parameters: Mapping[str, Setting] = _EMPTY,
    ) -> Self:
        """The setup of a match that runs with the numbers of `profile`."""
        return cls(
            match=config.name,
            pace=config.pace,
            profile=profile.name,
            rules=book.name,
            time=profile.time,
            pitch=profile.field,
            robot=profile.robot,
            ball=profile.ball,
            drive=profile.drive,
            dribble=profile.dribble,
            kicker=profile.kicker,
            periods=book.periods,
            restarts=book.restarts,
            handling=book.handling,
            scoring=book.scoring,
            fouls=book.fouls,
            officiating=config.referee.mode,
            areas=book.areas,
            teams={side: _team(config, side) for side in Side},
            models=types_of(profile.with_types(config.types, f'match "{config.name}"')),
            engine=dict(engine),
            parameters=dict(parameters),
        )

    def for_robot(self, robot: str) -> Self:
        """The same setup with this robot's own body, drive, dribbler and kicker in place of the standard robot's.

        In a recording that is older than types all robots are alike.
        """
        types = {name: chosen for team in self.teams.values() for name, chosen in team.types.items()}
        model = self.models.get(types.get(robot, STANDARD))
        if model is None:
            return self
        own = {"robot": model.body, "drive": model.drive, "dribble": model.dribble, "kicker": model.kicker}
        return self.model_copy(update=own)


def _team(config: MatchConfig, side: Side) -> TeamSetup:
    team = config.team(side)
    return TeamSetup(name=team.name or side.value, robots=config.robots(side), types=team.types)


class AppliedInput(Struct, frozen=True):
    """What one robot's actuators were told, after validation and watchdog; made for every robot in every tick."""

    drive: Drive
    """Velocity demand in the body frame."""
    dribble: bool
    """The dribbler is on."""
    kick: Kick | None = None
    """The kick of this tick; None without one."""
    answers_tick: int | None = None
    """Tick of the sight that this input answers; None while the robot is silent."""


class Applied(Message):
    """All inputs that led to this tick, and the hash chain over the states of all ticks so far.

    With the manifest this is enough to simulate the match again and to compare each tick.
    """

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    inputs: dict[Name, AppliedInput]
    """Robot → the input that its actuators were given."""
    placements: list[Placement] = Field(default_factory=list)
    """Bodies that were set down by hand before this tick."""
    checkpoint: bool = False
    """The world was rebuilt from poses and velocities before this tick: re-simulation may begin here."""
    remade: bool = False
    """The world was built anew, with the parameters, robots and obstacles in force, before bodies were placed."""
    parameters: dict[ParameterName, Setting] = Field(default_factory=dict)
    """Live parameters that were changed before this tick, and their new values."""
    robots: list[RosterEntry] | None = None
    """Who takes part from this tick on, in the order of the roster; always given at tick 0, None where it has not
    changed."""
    obstacles: list[StaticObstacle] | None = None
    """What else stands on the pitch from this tick on; None where it has not changed."""
    episode: int = 1
    """Which start this tick goes back to: the match's is 1, each scene that is loaded and each reset begin another."""
    chain: str
    """blake2b over the state of this tick and all other fields of this message, keyed with the chain before it; hex."""


def chained_part(applied: Mapping[str, Any]) -> bytes:
    """What the hash chain takes in of the fields of an `Applied`: all but `chain`, in their order, as compact JSON.

    Floats are as short as they can be, and the brace that ends it is left out. Equal fields give equal bytes, with
    whatever spaces a host publishes them.
    """
    return encode({name: value for name, value in applied.items() if name != "chain"})[:-1]


def chained_part_of(payload: bytes) -> bytes:
    """What the hash chain takes in of an `Applied` as it was published.

    Raises:
        BadMessageError: it is no JSON object.
    """
    try:
        return chained_part(_decode_fields(payload))
    except ValueError as error:
        raise BadMessageError(f"Applied: not to be read: {error}") from None


class RobotHealth(Part):
    """How one robot's agent is doing; counts since the match began."""

    alive: bool = False
    """Its liveliness token is there."""
    answering: bool = False
    """Its answer to the last tick was there in time."""
    answers: int = 0
    """Ticks that it answered."""
    missed: int = 0
    """Ticks that went by without its answer."""
    duplicates: int = 0
    """Commands that answered a tick it had answered already."""
    invalid: int = 0
    """Payloads on its key that were no valid command."""
    removed: bool = False
    """Its robot was taken off the pitch: it gets no sights and is not waited for until the robot is put back."""
    still: bool = False
    """Its robot stands still in the scene that is played: commands move nothing, and nobody waits for them."""
    refused: int = 0
    """Parts of commands that could not be done."""
    latency_ms: float | None = None
    """Median wall time from sight to command over the last second, in ms; None without an answer."""


class Health(Message):
    """How the host is doing."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    pace: str
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    real_time_factor: float
    """Simulated seconds per wall second, over the last second."""
    late_ticks: int = 0
    """Ticks that began late, or in lockstep did not get every answer in time."""
    worst_tick_ms: float = 0.0
    """Longest wall time that a tick of the last second took, in ms."""
    robots: dict[Name, RobotHealth] = Field(default_factory=dict)
    """Robot → how its agent is doing."""
    strangers: dict[str, int] = Field(default_factory=dict)
    """Key → messages on it from senders that have no business there."""
    recorders: dict[Name, Annotated[int, Field(ge=0)]] = Field(default_factory=dict)
    """How many ticks each recorder is behind."""


class Invalid(Message):
    """A payload that was not a valid message, as the host met it; counted and ignored."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    key: str
    """Key below the match that the payload was published on."""
    reason: str
    """What is wrong with the payload, in one sentence."""
    size: int
    """Length of the payload in bytes."""


class Belief(Message):
    """What a robot said on the radio, in its team frame, as the host took it in."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    robot: Name
    """The robot that sent the radio message."""
    radio: Radio
    """The radio message, in the robot's team frame."""


class RecorderProgress(Message):
    """How far a recorder has come; a lockstep host does not run away from it."""

    tick: int
    """The newest of which the recorder has everything; −1 before the first."""
    messages: int
    """Messages taken in so far."""
    lost: int
    """Messages known to be missing so far."""
    losses: dict[str, int] = Field(default_factory=dict)
    """The same by key; the keys without loss are left out."""
    sights: bool = False
    """It records what robots perceive, too: the host puts their sights into its batches."""
    paused: bool = False
    """The recorder leaves out what comes."""
    leaving: bool = False
    """The recorder's last message: the host need not wait for it."""
