"""Scenes: who and what stands where, and how the game is; from TOML files, or sent to a running host.

Everything is in the field frame: m, rad, m/s, rad/s. A scene is a start: the first half, cyan attacking +x.
"""

import tomllib
from enum import StrEnum
from importlib import resources
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, StringConstraints, model_validator

from schemas.config.obstacle import StaticObstacle
from schemas.config.roster import MAX_ROBOTS, RESERVED, Placement, RosterEntry
from schemas.config.toml_file import validate_tables
from schemas.errors import TouchlineError, did_you_mean
from schemas.game import RESTARTS, SIDED, Phase, Score
from schemas.message import Message, Name, Part, Source
from schemas.side import Side

Speed = Annotated[float, Field(ge=-40, le=40)]
"""m/s or rad/s."""

PHASES = frozenset({Phase.PRE_GAME, Phase.STOPPED, Phase.PLAY}) | RESTARTS
"""What may be going on when a scene begins."""

REMEDIES = {
    "description": "one sentence that tells what the scene is for",
    "robots.side": "write cyan or magenta",
    "robots.name": "a robot's name is a key chunk: small letters, digits and _",
    "game.phase": f"one of {', '.join(phase for phase in Phase if phase in PHASES)}",
    "obstacles.shape": "one of cylinder, box",
    "obstacles.place": "x and y of the centre in m",
    "obstacles.size": "x, y and z of a box in m",
}
"""What to do about a wrong value, by key; a message of the validator's stands where there is none."""


class SceneRobot(RosterEntry):
    """A robot where it begins; with a velocity, it moves so when the scene begins."""

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
        """Who it is, without where it stands."""
        return RosterEntry(**{key: getattr(self, key) for key in RosterEntry.model_fields})

    @property
    def placement(self) -> Placement:
        """Where it stands."""
        at = {key: getattr(self, key) for key in ("x", "y", "heading", "vx", "vy", "omega")}
        return Placement(body=self.name, **at)


class SceneBall(Part):
    """The ball where it begins; on the ground unless `z` lifts its centre."""

    x: float = 0.0
    """x of the centre in the field frame, in m."""
    y: float = 0.0
    """y of the centre in the field frame, in m."""
    z: Annotated[float, Field(ge=0, le=10)] | None = None
    """Height of the centre above the ground, in m; None for a ball on the ground."""
    vx: Speed = 0.0
    """Velocity along x of the field frame, in m/s."""
    vy: Speed = 0.0
    """Velocity along y of the field frame, in m/s."""
    vz: Speed = 0.0
    """Velocity upward, in m/s."""

    @property
    def placement(self) -> Placement:
        """Where it lies."""
        return Placement(body="ball", x=self.x, y=self.y, z=self.z, vx=self.vx, vy=self.vy, vz=self.vz)


class SceneGame(Part):
    """How the game is when the scene begins; a restart is taken from where the ball lies."""

    phase: Phase = Phase.PLAY
    """What is being played when the scene begins."""
    side: Side | None = None
    """The side that takes the restart; None where no side does."""
    running: bool = False
    """START of the restart was given: it may be taken at once. Play runs in any case."""
    score: Score = Score()
    """Goals of both sides."""
    clock: Annotated[float, Field(ge=0)] = 0.0
    """Game clock in s."""

    @model_validator(mode="after")
    def _check_game(self) -> "SceneGame":
        if self.phase not in PHASES:
            known = ", ".join(phase for phase in Phase if phase in PHASES)
            raise ValueError(f"no scene begins in the phase {self.phase}; write one of {known}")
        if (self.side is not None) != (self.phase in SIDED):
            need = "belongs to a side; name cyan or magenta" if self.side is None else "belongs to nobody; name no side"
            raise ValueError(f"{self.phase} {need}")
        if self.running and self.phase not in RESTARTS:
            raise ValueError(f"running says that a restart may be taken, and the phase is {self.phase}; leave it out")
        return self


class Scene(Part):
    """One scene."""

    name: Name = "scene"
    """Name of the scene; by default that of its file."""
    description: Annotated[str, StringConstraints(min_length=1, max_length=200)]
    """One sentence: what it is for."""
    profile: str | None = None
    """Profile that `touchline match --scene` plays it with, unless another is named; None for the default."""
    rules: str | None = None
    """Rule book that `touchline match --scene` plays it with, unless another is named; None for the default."""
    game: SceneGame = SceneGame()
    """State of the game when the scene begins."""
    ball: SceneBall = SceneBall()
    """Where the ball is."""
    robots: Annotated[list[SceneRobot], Field(min_length=1, max_length=2 * MAX_ROBOTS)]
    """The robots of both sides."""
    obstacles: Annotated[list[StaticObstacle], Field(max_length=100)] = Field(default_factory=list)
    """What else stands on the pitch."""

    @model_validator(mode="after")
    def _check_robots(self) -> "Scene":
        check_names([*(robot.name for robot in self.robots), *(obstacle.name for obstacle in self.obstacles)])
        check_sides(self.robots)
        return self

    def of(self, side: Side) -> list[SceneRobot]:
        """The robots of a side, the goalkeeper first."""
        return sorted((robot for robot in self.robots if robot.side is side), key=lambda robot: not robot.keeper)


def check_names(names: list[str]) -> None:
    """Make sure that every body has a name of its own.

    Raises:
        ValueError: one has not.
    """
    for place, name in enumerate(names):
        if name in RESERVED:
            raise ValueError(f'a body is named "{name}", which means something else in a key; rename it')
        if name in names[:place]:
            raise ValueError(f'two bodies are named "{name}"; every body has its own name')


def check_sides(entries: "list[SceneRobot] | list[RosterEntry]") -> None:
    """Make sure that no side has too many robots or goalkeepers.

    Raises:
        ValueError: one has.
    """
    for side in Side:
        mine = [entry for entry in entries if entry.side is side]
        if len(mine) > MAX_ROBOTS:
            raise ValueError(f"{side} has {len(mine)} robots; a side has at most {MAX_ROBOTS}")
        keepers = [entry.name for entry in mine if entry.keeper]
        if len(keepers) > 1:
            raise ValueError(f"{' and '.join(keepers)} both keep {side}'s goal; a side has one goalkeeper at most")


class SceneOperation(StrEnum):
    """What is asked for."""

    LOAD = "load"
    PLACE = "place"
    ADD = "add"
    REMOVE = "remove"
    RESET = "reset"


class SceneRequest(Message):
    """Asks the host to set bodies down, add or remove some, or begin anew; all of it is done, or nothing."""

    operation: SceneOperation
    """What is asked for."""
    load: str | None = None
    """For `load`: the name of a scene that ships."""
    scene: Scene | None = None
    """For `load`: the scene itself, in place of a name."""
    place: Annotated[list[Placement], Field(max_length=100)] = Field(default_factory=list)
    """For `place`: where robots or the ball are set down."""
    robots: Annotated[list[SceneRobot], Field(max_length=2 * MAX_ROBOTS)] = Field(default_factory=list)
    """For `add`: robots that join."""
    obstacles: Annotated[list[StaticObstacle], Field(max_length=100)] = Field(default_factory=list)
    """For `add`: obstacles that are put on the pitch."""
    remove: Annotated[list[Name], Field(max_length=100)] = Field(default_factory=list)
    """For `remove`: robots and obstacles."""
    to_match: bool = False
    """For `reset`: to the match's own start, and not to that of the scene loaded last."""
    source: Source = "operator"
    """Who asks."""


class SceneReply(Message):
    """The host's answer."""

    accepted: bool
    """All that was asked for was done."""
    reason: str = ""
    """Why it was refused; then nothing was done."""
    episode: int
    """What is being played from the next tick on; loading a scene and resetting begin a new one."""


def shipped_scenes() -> list[str]:
    """The names of the scenes that come with the package."""
    files = resources.files("schemas") / "scenes"
    return sorted(entry.name.removesuffix(".toml") for entry in files.iterdir() if entry.name.endswith(".toml"))


def load_scene(name: str) -> Scene:
    """A shipped scene by name, or one from a path that ends in `.toml`.

    Raises:
        TouchlineError: no such scene, or one line that names file, key, value and remedy.
    """
    try:
        content: dict[str, Any] = tomllib.loads(_text(name))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise TouchlineError(f"{name}: not TOML: {error}") from None
    content.setdefault("name", Path(name).stem)
    return validate_tables(Scene, content, name, REMEDIES)


def _text(name: str) -> str:
    shipped = shipped_scenes()
    if name in shipped:
        return (resources.files("schemas") / "scenes" / f"{name}.toml").read_text("utf-8")
    if not name.endswith(".toml"):
        raise TouchlineError(f'scene is "{name}"; {did_you_mean(name, shipped)} Or give a path that ends in .toml')
    try:
        return Path(name).read_text("utf-8")
    except OSError as error:
        raise TouchlineError(f'scene is "{name}": {error.strerror}; give one of {", ".join(shipped)}') from None
