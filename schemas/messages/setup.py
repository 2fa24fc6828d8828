"""The setup of a match."""

from collections.abc import Mapping
from typing import Any, Self

from pydantic import Field

from schemas.config.foul_book import Areas, Fouls, Handling, Scoring
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import OfficiatingConfig
from schemas.config.profile import STANDARD, Profile
from schemas.config.robot_model import RobotModel, types_of
from schemas.config.rule_book import Periods, Restarts, RuleBook
from schemas.config.sections import Ball, CameraView, Dribble, DriveLimits, Kicker, Pitch, RobotBody, TimeSteps
from schemas.game import OfficiatingMode
from schemas.messages.parameters import ParameterName, Setting
from schemas.side import Side
from schemas.wire.message import Message, Name, Part

_EMPTY: Mapping[str, Any] = {}


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
    camera: CameraView = Field(default_factory=CameraView)
    """Camera of the standard robot; one that sees all round in recordings that are older than this field."""
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
    duration: float | None = None
    """Playing time of all halves in s, where the match file gives one; None for the rule book's."""
    referee: OfficiatingConfig | None = None
    """How the match is refereed; None in recordings that are older than this field."""
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
    claims: bool = False
    """Whether agents claim their robot on `host/claim`; False for hosts that are older than claims."""
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
            camera=profile.camera,
            periods=book.periods,
            restarts=book.restarts,
            handling=book.handling,
            scoring=book.scoring,
            fouls=book.fouls,
            officiating=config.referee.mode,
            duration=config.duration,
            referee=config.referee,
            areas=book.areas,
            teams={side: _team(config, side) for side in Side},
            models=types_of(profile.with_types(config.types, f'match "{config.name}"')),
            engine=dict(engine),
            parameters=dict(parameters),
        )

    def for_robot(self, robot: str) -> Self:
        """The same setup with this robot's own parts in place of the standard robot's.

        Recordings that are older than types of robots have no models: all robots are standard ones.
        """
        types = {name: chosen for team in self.teams.values() for name, chosen in team.types.items()}
        model = self.models.get(types.get(robot, STANDARD))
        if model is None:
            return self
        own = {
            "robot": model.body,
            "drive": model.drive,
            "dribble": model.dribble,
            "kicker": model.kicker,
            "camera": model.camera,
        }
        return self.model_copy(update=own)


def _team(config: MatchConfig, side: Side) -> TeamSetup:
    team = config.team(side)
    return TeamSetup(name=team.name or side.value, robots=config.robots(side), types=team.types)
