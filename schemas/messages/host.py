"""What the host says of itself: how the match is set up, what it applied, how it is doing."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Self

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
from schemas.message import Message, Name, Part
from schemas.messages.command import Drive, Kick, Radio
from schemas.messages.parameters import ParameterName, Setting
from schemas.side import Side

_EMPTY: Mapping[str, Any] = {}


class SetupRequest(Message):
    """Asks the host how the match is set up."""


class TeamSetup(Part):
    """One team: its robots in order."""

    name: str
    robots: list[Name]
    types: dict[Name, Name] = Field(default_factory=dict)
    """Robot → its type; a robot that is not named here is a standard one."""
    goalkeeper: bool = True
    """The first on the field is the goalkeeper; without one, all play in the field."""


class Setup(Message):
    """Everything a robot or a viewer must know of a match before its first tick.

    `robot`, `drive`, `dribble` and `kicker` are those of the standard robot.
    """

    match: Name
    pace: str
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    profile: str
    rules: str
    time: TimeSteps
    pitch: Pitch
    robot: RobotBody
    ball: Ball
    drive: DriveLimits
    dribble: Dribble
    kicker: Kicker
    periods: Periods
    restarts: Restarts
    handling: Handling | None = None
    """How robots may handle the ball; nothing in recordings that are older than these rules, as the next two."""
    scoring: Scoring | None = None
    fouls: Fouls | None = None
    """Which fouls are called."""
    officiating: OfficiatingMode | None = None
    """Who decides; nothing in recordings that are older than this word."""
    areas: Areas | None = None
    """Who may be how long in an area before a goal; nothing in older recordings."""
    teams: dict[Side, TeamSetup]
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


@dataclass(frozen=True, slots=True)
class AppliedInput:
    """What one robot's actuators were told, after validation and watchdog; made for every robot in every tick."""

    drive: Drive
    dribble: bool
    kick: Kick | None = None
    answers_tick: int | None = None
    """The sight that this input answers; nothing while the robot is silent."""


class Applied(Message):
    """All inputs that led to this tick, and the hash chain over the states of all ticks so far.

    With the manifest this is enough to simulate the match again and to compare each tick.
    """

    tick: int
    time: float
    inputs: dict[Name, AppliedInput]
    placements: list[Placement] = Field(default_factory=list)
    checkpoint: bool = False
    """The world was rebuilt from poses and velocities before this tick: re-simulation may begin here."""
    remade: bool = False
    """The world was built anew, with the parameters, robots and obstacles in force, before bodies were placed."""
    parameters: dict[ParameterName, Setting] = Field(default_factory=dict)
    """Live parameters that were changed before this tick, and their new values."""
    robots: list[RosterEntry] | None = None
    """Who takes part from this tick on, in the order of the roster, said at tick 0; nothing where that is as before."""
    obstacles: list[StaticObstacle] | None = None
    """What else stands on the pitch from this tick on; nothing where that is as before."""
    episode: int = 1
    """Which start this tick goes back to: the match's is 1, each scene that is loaded and each reset begin another."""
    chain: str
    """blake2b over the state of this tick and this message up to its chain, keyed with the chain before it; hex."""


_CHAIN = b',"chain":"'


def without_chain(applied: bytes) -> bytes:
    """An `Applied` as it is on the wire, up to its chain, which is made over this and the state of the world."""
    return applied.rpartition(_CHAIN)[0]


def with_chain(unchained: bytes, chain: str) -> bytes:
    """The whole `Applied` again."""
    return b'%s%s%s"}' % (unchained, _CHAIN, chain.encode())


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
    """Median wall time from sight to command over the last second, in ms."""


class Health(Message):
    """How the host is doing."""

    tick: int
    time: float
    pace: str
    real_time_factor: float
    """Simulated seconds per wall second, over the last second."""
    late_ticks: int = 0
    """Ticks that began late, or in lockstep did not get every answer in time."""
    worst_tick_ms: float = 0.0
    """Longest wall time that a tick of the last second took, in ms."""
    robots: dict[Name, RobotHealth] = Field(default_factory=dict)
    strangers: dict[str, int] = Field(default_factory=dict)
    """Messages on keys where nobody should speak, counted by key."""
    recorders: dict[Name, Annotated[int, Field(ge=0)]] = Field(default_factory=dict)
    """How many ticks each recorder is behind."""


class Invalid(Message):
    """A payload that was not a valid message, as the host met it; counted and ignored."""

    tick: int
    time: float
    key: str
    reason: str
    size: int
    """Bytes."""


class Belief(Message):
    """What a robot said on the radio, in its team frame, as the host took it in."""

    tick: int
    time: float
    robot: Name
    radio: Radio


class RecorderProgress(Message):
    """How far a recorder has come; a lockstep host does not run away from it."""

    tick: int
    """The newest of which all has come that the host says in every tick."""
    messages: int
    """Taken in so far."""
    lost: int
    """Known to be missing."""
    losses: dict[str, int] = Field(default_factory=dict)
    """The same by key; the keys without loss are left out."""
    paused: bool = False
    leaving: bool = False
    """Its last word: nobody need wait for it."""
