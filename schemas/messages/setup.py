"""The setup of a match."""

from collections.abc import Mapping
from typing import Any, ClassVar, Self

from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import OfficiatingConfig, Parameter
from schemas.config.number_files import UNVERSIONED
from schemas.config.profile import STANDARD, Profile
from schemas.config.robot_model import RobotModel, types_of
from schemas.config.sections import Ball, CameraView, Dribble, DriveLimits, Kicker, Pitch, RobotBody, TimeSteps
from schemas.config.sensors.table import Sensor
from schemas.config.soccer.foul_book import Areas, Contact, Fouls, Handling, Scoring, Scrum
from schemas.config.soccer.rule_book import SECTIONS as RULE_SECTIONS
from schemas.config.soccer.rule_book import Discipline, People, Periods, Restarts, RuleBook, Stall
from schemas.config.task import GameName, TaskConfig, Zone
from schemas.messages.parameters import ParameterName, Setting
from schemas.side import Side
from schemas.soccer.game import OfficiatingMode
from schemas.wire.message import WITHOUT_SENSORS, Message, Name
from schemas.wire.part import Part

_EMPTY: Mapping[str, Any] = {}


class SetupRequest(Message):
    """A request for the setup of the match."""


class TeamSetup(Part):
    """One team and its robots."""

    name: str
    """Name of the team, for display."""
    robots: list[Name]
    """Names of the robots, the goalkeeper first."""
    types: dict[Name, Name] = {}
    """Robot → its type; other robots are of the standard type."""
    goalkeeper: bool = True
    """The first robot that is on the field is the goalkeeper; False for a team without one."""
    parameters: dict[Name, Parameter] = {}
    """Values of the match file for the team's own program; the other team can read them, too."""


class TaskSetup(Part):
    """The task of a match: what its score is called, who does it, and the zones on the floor."""

    score: str
    """`module:function` of the score."""
    unit: str = ""
    """Unit of the score; empty without one."""
    side: Side = Side.CYAN
    """The side that does the task."""
    zones: list[Zone] = []
    """Parts of the floor that the score names."""


class Setup(Message):
    """Everything that a robot or a viewer needs to know about a match before its first tick."""

    omitted: ClassVar[bytes] = WITHOUT_SENSORS

    match: Name
    """Name of the match: the chunk after `touchline/` in every key."""
    pace: str
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    profile: str
    """Name of the profile: the physical numbers of the match."""
    profile_version: int = UNVERSIONED
    """Version of these numbers; 0 for a file without one."""
    rules: str
    """Name of the rule book: the numbers that the referee applies."""
    rules_version: int = UNVERSIONED
    """Version of these numbers; 0 for a file without one."""
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
    camera: CameraView
    """Camera of the standard robot."""
    periods: Periods
    """Halves, breaks, extra time and penalty shoot-out."""
    restarts: Restarts
    """Distances and times of restarts."""
    handling: Handling
    """How robots may handle the ball."""
    scoring: Scoring
    """Which goals count."""
    fouls: Fouls
    """Which fouls are called."""
    officiating: OfficiatingMode
    """Who decides: the referee, people, or both."""
    duration: float | None = None
    """Playing time of all halves in s, where the match file gives one; None for the rule book's."""
    referee: OfficiatingConfig
    """How the match is refereed."""
    areas: Areas
    """Which robots may be in goal areas and penalty areas, and for how long."""
    discipline: Discipline
    """Cards and their consequences."""
    people: People
    """Repairs, substitutions and forfeits."""
    stall: Stall
    """When a ball that no robot moves is dropped."""
    scrum: Scrum
    """When a ball that both sides contest is dropped."""
    contact: Contact
    """How robots may touch each other."""
    teams: dict[Side, TeamSetup]
    """Side → its team."""
    models: dict[Name, RobotModel]
    """Type → model; `standard` is for robots without a type."""
    engine: dict[str, str] = {}
    """Fingerprint of what computes the world: version of the engine, results of the maths library."""
    parameters: dict[ParameterName, Setting] = {}
    """Live parameters that were changed since the match began → value; the numbers above include them."""
    claims: bool = False
    """Whether agents claim their robot on `host/claim`; False in a replay, which admits all."""
    orders: dict[Side, int] = {}
    """Side → sequence number of the coach's order in force; the next order needs a larger one."""
    game: GameName = GameName.SOCCER
    """The game that is played; in a game `free`, the numbers of the rule book have no effect."""
    task: TaskSetup | None = None
    """What is known of the task; None for a match without one."""
    sensors: dict[Name, dict[Name, Sensor]] = {}
    """Type → its sensors by name, with their numbers; omitted while no type has any."""

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
        profile = profile.with_types(config.types, f'match "{config.name}"')
        return cls(
            match=config.name,
            pace=config.pace,
            profile=profile.name,
            profile_version=profile.version,
            rules=book.name,
            rules_version=book.version,
            time=profile.time,
            pitch=profile.field,
            robot=profile.robot,
            ball=profile.ball,
            drive=profile.drive,
            dribble=profile.dribble,
            kicker=profile.kicker,
            camera=profile.camera,
            officiating=config.referee.mode,
            duration=config.duration,
            referee=config.referee,
            teams={side: _team(config, side) for side in Side},
            models=types_of(profile),
            engine=dict(engine),
            parameters=dict(parameters),
            game=config.game,
            task=_task(config.task) if config.task is not None else None,
            sensors={name: dict(carried) for name in types_of(profile) if (carried := profile.sensors_of(name))},
            **{name: getattr(book, name) for name in RULE_SECTIONS},
        )

    @property
    def free(self) -> TaskSetup | None:
        """The task of a game without goals, which only its score decides; None for soccer."""
        return self.task if self.game is GameName.FREE else None

    @property
    def sides(self) -> dict[str, Side]:
        """Robot → its side."""
        return {name: side for side, team in self.teams.items() for name in team.robots}

    def rule_book(self) -> RuleBook:
        """The rule book of the match."""
        sections: dict[str, Any] = {name: getattr(self, name) for name in RULE_SECTIONS}
        return RuleBook(name=self.rules, origins={}, version=self.rules_version, **sections)

    def sensors_of(self, robot: str) -> dict[Name, Sensor]:
        """The sensors of a robot by name; empty without any."""
        return self.sensors.get(self._type_of(robot), {})

    def _type_of(self, robot: str) -> str:
        types = {name: chosen for team in self.teams.values() for name, chosen in team.types.items()}
        return types.get(robot, STANDARD)

    def model_of(self, robot: str) -> RobotModel:
        """The model of a robot's type."""
        return self.models[self._type_of(robot)]

    def for_robot(self, robot: str) -> Self:
        """The same setup with this robot's own parts in place of the standard robot's."""
        model = self.model_of(robot)
        own = {
            "robot": model.body,
            "drive": model.drive,
            "dribble": model.dribble,
            "kicker": model.kicker,
            "camera": model.camera,
        }
        return self.replace(**own)


def _task(task: TaskConfig) -> TaskSetup:
    return TaskSetup(score=task.score, unit=task.unit, side=task.side, zones=task.zones)


def _team(config: MatchConfig, side: Side) -> TeamSetup:
    team = config.team(side)
    return TeamSetup(
        name=team.name or side.value, robots=config.robots(side), types=team.types, parameters=team.parameters
    )
