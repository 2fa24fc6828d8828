"""Messages about the host: setup of the match, applied inputs, health, invalid payloads; and those of recorders."""

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
from schemas.messages.command import Drive, Kick, Radio
from schemas.messages.parameters import ParameterName, Setting
from schemas.side import Side
from schemas.wire.message import BadMessageError, Message, Name, Part
from schemas.wire.struct import Struct, encode

_EMPTY: Mapping[str, Any] = {}
_decode_fields = msgspec.json.Decoder(dict[str, Any]).decode


class SetupRequest(Message):
    """A request for the setup of the match."""


class TeamSetup(Part):
    """One team and its robots."""

    name: str
    """Name of the team, for display."""
    robots: list[Name]
    """Names of the robots, the goalkeeper first."""
    types: dict[Name, Name] = Field(default_factory=dict)
    """Robot → its type; other robots are of the standard type."""
    goalkeeper: bool = True
    """The first robot that is on the field is the goalkeeper; False for a team without one."""


class Setup(Message):
    """Everything that a robot or a viewer needs to know about a match before its first tick."""

    match: Name
    """Name of the match: the chunk after `touchline/` in every key."""
    pace: str
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    profile: str
    """Name of the profile: the physical numbers of the match."""
    rules: str
    """Name of the rule book: the numbers that the referee applies."""
    time: TimeSteps
    """Lengths of the physics step and the control tick."""
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
    """How robots may handle the ball; None in recordings that are older than this field."""
    scoring: Scoring | None = None
    """Which goals count; None in recordings that are older than this field."""
    fouls: Fouls | None = None
    """Which fouls are called; None in recordings that are older than this field."""
    officiating: OfficiatingMode | None = None
    """Who decides: the referee, people, or both; None in recordings that are older than this field."""
    areas: Areas | None = None
    """Which robots may be in goal areas and penalty areas, and for how long; None in recordings that are older than
    this field."""
    teams: dict[Side, TeamSetup]
    """Side → its team."""
    models: dict[Name, RobotModel] = Field(default_factory=dict)
    """Type → model; `standard` is that of robots without a type."""
    engine: dict[str, str] = Field(default_factory=dict)
    """Fingerprint of what computes the world: version of the engine, results of the maths library."""
    parameters: dict[ParameterName, Setting] = Field(default_factory=dict)
    """Live parameters that were changed since the match began → value; the numbers above include them."""
    orders: dict[Side, int] = Field(default_factory=dict)
    """Side → sequence number of the coach's order in force; the next order needs a larger one."""

    @classmethod
    def of(
        cls,
        config: MatchConfig,
        profile: Profile,
        book: RuleBook,
        engine: Mapping[str, str] = _EMPTY,
        parameters: Mapping[str, Setting] = _EMPTY,
    ) -> Self:
        """The setup of a match with the numbers of `profile`."""
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

        Recordings that are older than types of robots have no models: all robots are standard ones.
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
    """The input of one robot's actuators in one tick, after validation and watchdog."""

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

    With the manifest, this suffices to simulate the match again and to compare each tick.
    """

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    inputs: dict[Name, AppliedInput]
    """Robot → the input of its actuators."""
    placements: list[Placement] = Field(default_factory=list)
    """Bodies that an operator or the referee placed before this tick."""
    checkpoint: bool = False
    """The world was rebuilt from poses and velocities before this tick: re-simulation may begin here."""
    remade: bool = False
    """The world was rebuilt with the parameters, robots and obstacles in force, before bodies were placed."""
    parameters: dict[ParameterName, Setting] = Field(default_factory=dict)
    """Live parameters that were changed before this tick → new value."""
    robots: list[RosterEntry] | None = None
    """The robots that take part from this tick on, in the order of the roster; given at tick 0 and on a change,
    otherwise None."""
    obstacles: list[StaticObstacle] | None = None
    """The obstacles on the pitch from this tick on; None where they have not changed."""
    episode: int = 1
    """The episode that this tick belongs to: the start of the match is 1, and each scene that is loaded and each reset
    begin another."""
    chain: str
    """blake2b over the state of this tick and all other fields of this message, keyed with the chain before it; hex."""


def chained_part(applied: Mapping[str, Any]) -> bytes:
    """The bytes of an `Applied` that the hash chain covers: all fields but the chain, in their order.

    They are JSON without spaces, with the shortest form of each float, without the closing brace. The same fields give
    the same bytes, however the host that published them formats its JSON.
    """
    return encode({name: value for name, value in applied.items() if name != "chain"})[:-1]


def chained_part_of(payload: bytes) -> bytes:
    """The bytes that the hash chain covers of an `Applied` as it was published.

    Raises:
        BadMessageError: the payload is not a JSON object.
    """
    try:
        return chained_part(_decode_fields(payload))
    except ValueError as error:
        raise BadMessageError(f"Applied: cannot be read: {error}") from None


class RobotHealth(Part):
    """State of one robot's agent; counts are since the match began."""

    alive: bool = False
    """Its liveliness token exists."""
    answering: bool = False
    """Its answer to the last tick arrived in time."""
    answers: int = 0
    """Ticks with an answer."""
    missed: int = 0
    """Ticks without an answer."""
    duplicates: int = 0
    """Commands for a tick that it had already answered."""
    invalid: int = 0
    """Payloads on its key that were not valid commands."""
    removed: bool = False
    """Its robot was removed from the pitch: it gets no sights, and the host does not wait for it, until the robot is
    added again."""
    still: bool = False
    """Its robot stands still in the current scene: its commands have no effect, and the host does not wait for them."""
    refused: int = 0
    """Parts of commands that were refused."""
    latency_ms: float | None = None
    """Median wall time from sight to command over the last second, in ms; None without an answer."""


class Health(Message):
    """State of the host, its agents and recorders."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    pace: str
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    real_time_factor: float
    """Simulated seconds per wall second, over the last second."""
    late_ticks: int = 0
    """Ticks that began late; in lockstep, ticks without all answers in time."""
    worst_tick_ms: float = 0.0
    """Longest wall time of a tick in the last second, in ms."""
    robots: dict[Name, RobotHealth] = Field(default_factory=dict)
    """Robot → the state of its agent."""
    strangers: dict[str, int] = Field(default_factory=dict)
    """Command key → messages on it, for names that no robot of this match has."""
    recorders: dict[Name, Annotated[int, Field(ge=0)]] = Field(default_factory=dict)
    """Recorder → ticks that it is behind."""


class Invalid(Message):
    """An invalid payload that the host received, counted and ignored."""

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
    """A robot's radio message, as the host received it."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    robot: Name
    """The robot that sent the radio message."""
    radio: Radio
    """The radio message, in the robot's team frame."""


class RecorderProgress(Message):
    """Progress of a recorder; a lockstep host limits its lead over it."""

    tick: int
    """The newest tick of which the recorder has everything; −1 before the first."""
    messages: int
    """Messages received so far."""
    lost: int
    """Messages known to be missing so far."""
    losses: dict[str, int] = Field(default_factory=dict)
    """Key → messages known to be missing; keys without losses are left out."""
    sights: bool = False
    """The recorder also records sights: the host adds them to its batches."""
    paused: bool = False
    """The recorder is paused and leaves out what arrives."""
    leaving: bool = False
    """This is the recorder's last message: the host no longer waits for it."""
