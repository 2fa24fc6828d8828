"""Scenes: the robots, the ball, the obstacles and the game at a start, from TOML files or sent to a running host.

Everything is in the field frame: m, rad, m/s, rad/s. A scene begins in the first half, with cyan attacking +x.
"""

from importlib import resources
from pathlib import Path
from typing import Annotated

from pydantic import Field, StringConstraints, model_validator

from schemas.config.config_model import ConfigModel
from schemas.config.number_files import NumberFiles
from schemas.config.obstacle import MAX_OBSTACLES, ObstacleConfig
from schemas.config.roster import MAX_ROBOTS, RESERVED, Placement, RosterEntry
from schemas.config.soccer.drill import Drill, Variation
from schemas.config.toml_file import validate_tables, with_files
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side
from schemas.soccer.game import RESTARTS, SIDED, Phase
from schemas.wire.message import Name

MAX_SPEED, MAX_HEIGHT = 40.0, 10.0
"""m/s or rad/s of a body that is placed, and m above the ground of a ball."""
Speed = Annotated[float, Field(ge=-MAX_SPEED, le=MAX_SPEED)]
PHASES = frozenset({Phase.PRE_GAME, Phase.STOPPED, Phase.PLAY}) | RESTARTS
"""The phases in which a scene may begin."""
REMEDIES = {
    "description": "one sentence with the purpose of the scene",
    "robots.side": "write cyan or magenta",
    "robots.name": "a robot's name is a key chunk: lower-case letters, digits and _",
    "game.phase": f"one of {', '.join(phase for phase in Phase if phase in PHASES)}",
    "drill.seconds": "simulated time in s, above 0 and at most 600",
    "obstacles.shape": "one of cylinder, box",
    "obstacles.place": "x and y of the centre in m",
    "obstacles.size": "x, y and z of a box in m",
}
"""Key → remedy for an invalid value; keys without one get the validator's message."""


class SceneRobot(RosterEntry):
    """A robot and its pose and velocity when the scene begins."""

    x: float
    """x of the centre in the field frame, in m."""
    y: float
    """y of the centre in the field frame, in m."""
    heading: float = 0.0
    """Heading in the field frame, in rad."""
    vx: Speed = 0.0
    """Velocity along x of the field frame, in m/s."""
    vy: Speed = 0.0
    """Velocity along y of the field frame, in m/s."""
    omega: Speed = 0.0
    """Turn rate, counter-clockwise, in rad/s."""

    @property
    def entry(self) -> RosterEntry:
        """Its entry in the roster."""
        return RosterEntry(**{key: getattr(self, key) for key in RosterEntry.model_fields})

    @property
    def placement(self) -> Placement:
        """Its placement."""
        at = {key: getattr(self, key) for key in ("x", "y", "heading", "vx", "vy", "omega")}
        return Placement(body=self.name, **at)


class SceneBall(ConfigModel):
    """The ball and its place and velocity when the scene begins; on the ground unless `z` is given."""

    x: float = 0.0
    """x of the centre in the field frame, in m."""
    y: float = 0.0
    """y of the centre in the field frame, in m."""
    z: Annotated[float, Field(ge=0, le=MAX_HEIGHT)] | None = None
    """Height of the centre above the ground, in m; None for a ball on the ground."""
    vx: Speed = 0.0
    """Velocity along x of the field frame, in m/s."""
    vy: Speed = 0.0
    """Velocity along y of the field frame, in m/s."""
    vz: Speed = 0.0
    """Velocity upward, in m/s."""

    @property
    def placement(self) -> Placement:
        """Its placement."""
        return Placement(body="ball", x=self.x, y=self.y, z=self.z, vx=self.vx, vy=self.vy, vz=self.vz)


class SceneScore(ConfigModel):
    """Goals of both sides when the scene begins."""

    cyan: Annotated[int, Field(ge=0)] = 0
    """Goals of cyan."""
    magenta: Annotated[int, Field(ge=0)] = 0
    """Goals of magenta."""


class SceneGame(ConfigModel):
    """The state of the game when the scene begins; a restart is taken from where the ball lies."""

    phase: Phase = Phase.PLAY
    """What is being played when the scene begins."""
    side: Side | None = None
    """The side that takes the restart; None where no side does."""
    running: bool = False
    """START of the restart was given: it may be taken at once. The phase `play` is running in any case."""
    score: SceneScore = SceneScore()
    """Goals of both sides."""
    clock: Annotated[float, Field(ge=0)] = 0.0
    """Game clock in s."""

    @model_validator(mode="after")
    def _check_game(self) -> "SceneGame":
        if self.phase not in PHASES:
            known = ", ".join(phase for phase in Phase if phase in PHASES)
            raise ValueError(f"no scene begins in the phase {self.phase}; write one of {known}")
        if (self.side is not None) != (self.phase in SIDED):
            need = "belongs to a side; name cyan or magenta" if self.side is None else "belongs to no side; name none"
            raise ValueError(f"{self.phase} {need}")
        if self.running and self.phase not in RESTARTS:
            raise ValueError(f"running means that a restart may be taken, and the phase is {self.phase}; leave it out")
        return self


class Scene(ConfigModel):
    """A start position with the state of the game."""

    name: Name = "scene"
    """Name of the scene; by default the name of its file."""
    description: Annotated[str, StringConstraints(min_length=1, max_length=200)]
    """Purpose of the scene, in one sentence."""
    profile: str | None = None
    """Profile that `touchline match --scene` uses, unless the match names another; None for the default."""
    rules: str | None = None
    """Rule book that `touchline match --scene` uses, unless the match names another; None for the default."""
    game: SceneGame = SceneGame()
    """State of the game when the scene begins."""
    ball: SceneBall = SceneBall()
    """Place and velocity of the ball."""
    robots: Annotated[list[SceneRobot], Field(min_length=1, max_length=2 * MAX_ROBOTS)]
    """The robots of both sides."""
    obstacles: Annotated[list[ObstacleConfig], Field(max_length=MAX_OBSTACLES)] = Field(default_factory=list)
    """The obstacles on the pitch."""
    drill: Drill | None = None
    """What makes it a drill: its end and verdict; a match that starts in the scene plays on."""
    vary: Annotated[list[Variation], Field(max_length=2 * MAX_ROBOTS + MAX_OBSTACLES + 1)] = Field(default_factory=list)
    """How the start of a drill or a task differs from seed to seed; another match starts in the scene as it is."""

    @model_validator(mode="after")
    def _check_robots(self) -> "Scene":
        check_names([*(robot.name for robot in self.robots), *(obstacle.name for obstacle in self.obstacles)])
        check_sides(self.robots)
        return self

    @model_validator(mode="after")
    def _check_drill(self) -> "Scene":
        names, obstacles = [robot.name for robot in self.robots], [obstacle.name for obstacle in self.obstacles]
        for one in self.vary:
            bodies = ["ball", *names, *obstacles]
            if one.body not in bodies:
                raise ValueError(f'vary names the body "{one.body}"; {did_you_mean(one.body, bodies)}')
            if (one.body == "ball" and one.heading) or (one.body != "ball" and one.vz):
                raise ValueError(f"vary of {one.body}: only the ball has vz, and only the ball has no heading")
            if one.body in obstacles and (one.vx or one.vy):
                raise ValueError(f"vary of {one.body}: an obstacle starts at rest; leave vx and vy out")
        for occurred in [*self.drill.success, *self.drill.failure] if self.drill is not None else []:
            _, colon, who = occurred.partition(":")
            if colon and who not in (*Side, *names):
                raise ValueError(f'drill names "{occurred}"; known: {", ".join((*Side, *names))}')
        return self

    def of(self, side: Side) -> list[SceneRobot]:
        """The robots of a side, the goalkeeper first."""
        return sorted((robot for robot in self.robots if robot.side is side), key=lambda robot: not robot.keeper)


def check_names(names: list[str]) -> None:
    """Check that every body has a unique name.

    Raises:
        ValueError: a name is taken or reserved.
    """
    for place, name in enumerate(names):
        if name in RESERVED:
            raise ValueError(f'a body is named "{name}", which has another meaning in keys; rename it')
        if name in names[:place]:
            raise ValueError(f'two bodies are named "{name}"; every body has its own name')


def check_sides(entries: "list[SceneRobot] | list[RosterEntry]") -> None:
    """Check that no side has too many robots or goalkeepers.

    Raises:
        ValueError: a side has.
    """
    for side in Side:
        mine = [entry for entry in entries if entry.side is side]
        if len(mine) > MAX_ROBOTS:
            raise ValueError(f"{side} has {len(mine)} robots; a side has at most {MAX_ROBOTS}")
        keepers = [entry.name for entry in mine if entry.keeper]
        if len(keepers) > 1:
            raise ValueError(f"{' and '.join(keepers)} are goalkeepers of {side}; a side has at most one")


def shipped_scenes() -> list[str]:
    """The names of the shipped scenes."""
    files = resources.files("schemas") / "scenes"
    return sorted(entry.name.removesuffix(".toml") for entry in files.iterdir() if entry.name.endswith(".toml"))


def load_scene(name: str) -> Scene:
    """A shipped scene by name, or one from a path that ends in `.toml`.

    Raises:
        TouchlineError: there is no such scene, or it is invalid; names file, key, value and remedy.
    """
    content = with_files(NumberFiles("scene", "scenes", tuple(shipped_scenes())).read(name), Path(name).parent)
    if "teams" in content:
        raise TouchlineError(f"{name}: a match file; give a scene, which has [[robots]] and no teams")
    content.setdefault("name", Path(name).stem)
    return validate_tables(Scene, content, name, REMEDIES)
