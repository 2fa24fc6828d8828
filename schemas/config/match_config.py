"""The match file: one frozen `MatchConfig` from TOML, with errors that name file, key, value and remedy.

`load_match` reads the scene, the profile and the rule book that a match file names and embeds their content: a config
is self-contained.
"""

from collections.abc import Callable, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, field_validator, model_validator

from schemas.config.config_model import ConfigModel
from schemas.config.confinement import Isolation, Limits
from schemas.config.match_parts import (
    PROGRAM_KINDS,
    NoiseConfig,
    OfficiatingConfig,
    Patience,
    RadioOverride,
    RecordingConfig,
    TeamConfig,
    TeamConfigs,
    default_cyan,
    default_magenta,
)
from schemas.config.noise import PRESETS
from schemas.config.number_files import NumberFiles
from schemas.config.obstacle import MAX_OBSTACLES, ObstacleConfig
from schemas.config.profile import FILES as PROFILES
from schemas.config.profile import Profile, load_profile, profile_of
from schemas.config.roster import MAX_ROBOTS, RESERVED
from schemas.config.scene import REMEDIES as SCENE_REMEDIES
from schemas.config.scene import Scene, load_scene
from schemas.config.settings import DEFAULT_MATCH
from schemas.config.soccer.rule_book import FILES as RULE_BOOKS
from schemas.config.soccer.rule_book import RuleBook, load_rule_book, rule_book_of
from schemas.config.task import REMEDIES as TASK_REMEDIES
from schemas.config.task import GameName, TaskConfig, with_program
from schemas.config.toml_file import read_tables, validate_tables, with_files
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side
from schemas.soccer.game import OfficiatingMode
from schemas.wire.message import Name

REMOTE = "remote"
"""In place of a team: `magenta = "remote"` below [teams], short for `[teams.magenta]` with `remote = true`."""
_REMOTE_KEYS = {f"teams.{side.value}.remote": side for side in Side}
LOCKSTEP = "lockstep"
"""The pace at which the host waits for the answers of all robots."""

_OF_A_TEAM = {
    "": 'write [teams.{0}], and below it the keys of the team; or {0} = "remote" below [teams]',
    ".size": f"a side has 1 to {MAX_ROBOTS} robots",
    ".robots": f"1 to {MAX_ROBOTS} different names of lower-case letters, digits and _",
    ".stdio": 'write ["program", "argument"]',
    ".types": 'write robot = "type", for example {{ {0}1 = "keeper" }}',
}
"""Key below a team → remedy for an invalid value."""
REMEDIES = {
    "name": "a match name is a key chunk: lower-case letters, digits and _",
    "seed": "a whole number from 0 to 2^63 - 1",
    "pace": 'write "lockstep", "realtime", or "x4" for four times real time',
    "duration": "playing time of all halves in s, above 0 and at most 86400",
    "scene": "the name of a scene, or a path that ends in .toml",
    **{f"scene.{key}": remedy for key, remedy in SCENE_REMEDIES.items()},
    "teams": "write [teams.cyan] and [teams.magenta]",
    **{f"teams.{side}{key}": remedy.format(side) for key, remedy in _OF_A_TEAM.items() for side in Side},
    "obstacles": f"write [[obstacles]] above each of at most {MAX_OBSTACLES} obstacles",
    **{key: remedy for key, remedy in SCENE_REMEDIES.items() if key.startswith("obstacles.")},
    "referee.mode": f"one of {', '.join(OfficiatingMode)}",
    "isolate": f"one of {', '.join(Isolation)}",
    "limits.cpu_time": "CPU time of a process in s, from 1",
    "limits.memory": "memory of a process in GB, from 0.1",
    "limits.open_files": "open files of a process, from 32",
    "limits.processes": "processes and threads of a robot, from 16",
    "limits.file_size": "size of a file in MB, from 0.001",
    "noise.preset": f"one of {', '.join(PRESETS)}",
    **TASK_REMEDIES,
}
"""Key → remedy for an invalid value; keys without one get the validator's message."""


_NUMBER_FILES: tuple[tuple[str, str, NumberFiles, Callable[[str], object]], ...] = (
    ("profile", "profile_tables", PROFILES, load_profile),
    ("rules", "rule_book_tables", RULE_BOOKS, load_rule_book),
)
"""Key that names a file of numbers, key of its embedded tables, where it is read from, how it is checked."""


class MatchConfig(ConfigModel):
    """The complete description of a match; with the same brains, it gives the same match again."""

    name: Name = DEFAULT_MATCH
    """Name of the match on the bus."""
    seed: Annotated[int, Field(ge=0, lt=2**63)] = 1
    """Seed of all random numbers."""
    pace: Annotated[str, Field(pattern=r"^(lockstep|realtime|x\d{1,6}(\.\d{1,6})?)$")] = LOCKSTEP
    """`lockstep`, `realtime`, or `x4` for four times real time."""
    duration: Annotated[float, Field(gt=0, le=86_400)] | None = None
    """Playing time of all halves in s; None for the rule book's."""
    scene: Scene | None = None
    """The scene that the match starts in, with its robots; None for a kick-off.

    In a match file, the name or the path of a scene, or the scene itself.
    """
    profile: str = "msl"
    """A shipped profile by name, or the path of the file that `profile_tables` was read from."""
    profile_tables: dict[str, Any] | None = Field(default=None, repr=False)
    """All tables of the profile and of the profiles that it extends; None for the shipped profile."""
    rules: str = "friendly"
    """A shipped rule book by name, or the path of the file that `rule_book_tables` was read from."""
    rule_book_tables: dict[str, Any] | None = Field(default=None, repr=False)
    """All tables of the rule book and of the rule books that it extends; None for the shipped rule book."""
    teams: TeamConfigs = Field(default_factory=TeamConfigs)
    """Both teams."""
    types: dict[Name, dict[str, Any]] = Field(default_factory=dict)
    """Type of robot → sections of numbers that differ from the profile's; adds types, or changes those of the
    profile."""
    obstacles: Annotated[list[ObstacleConfig], Field(max_length=MAX_OBSTACLES)] = Field(default_factory=list)
    """Obstacles on the pitch when the match begins."""
    noise: NoiseConfig = NoiseConfig()
    """Quality of the robots' perception."""
    radio: RadioOverride = RadioOverride()
    """Radio numbers that replace the profile's."""
    referee: OfficiatingConfig = OfficiatingConfig()
    """How the match is refereed."""
    record: RecordingConfig = RecordingConfig()
    """What is recorded, and into which files."""
    patience: Patience = Patience()
    """How long the host waits, in s of wall time."""
    isolate: Isolation = Isolation.NONE
    """What separates the robots that this machine launches: `none` or `bubblewrap`."""
    limits: Limits = Limits()
    """What each robot may use of the machine that launches it."""
    game: GameName = GameName.SOCCER
    """The game that is played."""
    task: TaskConfig | None = None
    """What is scored, and what ends the match before its time; None for a match that its game alone decides."""

    @field_validator("pace")
    @classmethod
    def _check_pace(cls, pace: str) -> str:
        if pace.startswith("x") and not float(pace[1:]):
            raise ValueError("time would stand still")
        return pace

    @model_validator(mode="after")
    def _check_names(self) -> "MatchConfig":
        names = [robot for side in Side for robot in self.robots(side)]
        for name in names:
            if name in RESERVED:
                raise ValueError(f'a robot is named "{name}", which has another meaning in keys; rename it')
            if names.count(name) > 1:
                raise ValueError(f'two robots are named "{name}"; every robot of a match has its own name')
        bodies = [*names, *RESERVED]
        for obstacle in self.obstacles:
            if obstacle.name in bodies:
                raise ValueError(f'two bodies are named "{obstacle.name}"; every obstacle has a name of its own')
            bodies.append(obstacle.name)
        return self

    @model_validator(mode="after")
    def _check_game(self) -> "MatchConfig":
        if self.game is GameName.FREE:
            needed: Sequence[str] = ("task", "scene", "duration")
            missing = [key for key in needed if getattr(self, key) is None]
            if missing:
                raise ValueError(f'{missing[0]} is missing; the game "free" needs one')
        if self.task is not None and not self.robots(self.task.side):
            raise ValueError(f"task.side is {self.task.side}, which has no robots; name the other side")
        return self

    @model_validator(mode="after")
    def _check_types(self) -> "MatchConfig":
        for side in Side:
            names = self.robots(side)
            for robot in self.team(side).types:
                if robot not in names:
                    at = f"teams.{side.value}.types.{robot}"
                    raise ValueError(f"{at}: no robot of the side has that name; {did_you_mean(robot, names)}")
        return self

    def team(self, side: Side) -> TeamConfig:
        """The team of a side."""
        return self.teams.cyan if side is Side.CYAN else self.teams.magenta

    def robots(self, side: Side) -> list[str]:
        """Names of the robots that have an agent, the goalkeeper first; those of the scene where the match has one."""
        if self.scene is not None:
            return [robot.name for robot in self.scene.of(side) if robot.agent]
        team = self.team(side)
        return team.robots or [f"{side.value}{number}" for number in range(1, team.size + 1)]

    def processes(self, side: Side) -> dict[str, list[str]]:
        """Name of each process that the launcher starts for the robots of a side → its robots."""
        robots = self.robots(side)
        if robots and self.team(side).process == "team":
            return {side.value: robots}
        return {robot: [robot] for robot in robots}

    def limits_of(self, side: Side) -> Limits:
        """The limits of a robot of a side."""
        return self.team(side).limits.over(self.limits)

    @property
    def free(self) -> TaskConfig | None:
        """The task of a game without goals, which only its score decides; None for soccer."""
        return self.task if self.game is GameName.FREE else None

    @property
    def remote_sides(self) -> tuple[Side, ...]:
        """The sides whose robots are started elsewhere."""
        return tuple(side for side in Side if self.team(side).remote)

    @property
    def local_sides(self) -> tuple[Side, ...]:
        """The sides whose robots the launcher of the match starts."""
        return tuple(side for side in Side if not self.team(side).remote)

    @property
    def longest_attendance(self) -> float:
        """Longest wait for all robots before the first tick, in s of wall time."""
        return self.patience.remote if self.remote_sides else self.patience.attendance

    def load_profile(self) -> Profile:
        """The profile that the match is played with.

        Raises:
            TouchlineError: there is no such shipped profile, or a number in it is invalid.
        """
        if self.profile_tables is None:
            return load_profile(self.profile)
        return profile_of(self.profile, self.profile_tables)

    def load_rule_book(self) -> RuleBook:
        """The rule book that the match is played by.

        Raises:
            TouchlineError: there is no such shipped rule book, or a number in it is invalid.
        """
        if self.rule_book_tables is None:
            return load_rule_book(self.rules)
        return rule_book_of(self.rules, self.rule_book_tables)

    @property
    def speed(self) -> float | None:
        """Simulated seconds per wall second at this pace; None in lockstep."""
        if self.pace == LOCKSTEP:
            return None
        return 1.0 if self.pace == "realtime" else float(self.pace[1:])


def load_match(path: Path | str | None, overrides: dict[str, Any] | None = None) -> MatchConfig:
    """The match of a file, or the default match; `overrides`, key with dots → value, replace its values.

    Raises:
        TouchlineError: one line that names file, key, value and remedy.
    """
    where = str(path) if path is not None else "match"
    folders = [Path(path).parent if path is not None else Path(), Path()]
    content = with_files(read_tables(Path(path), "a match file"), folders[0]) if path is not None else {}
    for key, value in (overrides or {}).items():
        _set_at_path(content, key.split("."), deepcopy(value))
        if value is True and key in _REMOTE_KEYS:
            _drop_program(content["teams"], _REMOTE_KEYS[key])
    if content.get("scene") is not None and content.get("obstacles"):
        raise TouchlineError(f"{where}: a match that starts in a scene has the scene's obstacles; write these there")
    content = with_program(_with_number_files(_with_scene(content), where), where, folders)
    return _validate(content, where, overrides or {})


def _with_scene(content: dict[str, Any]) -> dict[str, Any]:
    """The content of a match file with its scene embedded, and the scene's profile and rules as defaults."""
    if isinstance(content.get("scene"), str):
        content = content | {"scene": load_scene(content["scene"]).model_dump(mode="json")}
    scene = content.get("scene")
    if not isinstance(scene, dict):
        return content  # the validator names a wrong type
    return {key: scene[key] for key in ("profile", "rules") if scene.get(key) is not None} | content


def _with_number_files(content: dict[str, Any], where: str) -> dict[str, Any]:
    """The content of a match file with the tables of a profile and a rule book that are not shipped."""
    for key, tables_key, files, load in _NUMBER_FILES:
        if tables_key in content:
            raise TouchlineError(f'{where}: {tables_key} is not for match files; write {key} = "FILE.toml"')
        name = content.get(key)
        if isinstance(name, str) and name not in files.shipped:
            load(name)  # each number of a file is required
            content = content | {tables_key: files.tables(name)}
    return content


def _set_at_path(content: dict[str, Any], path: list[str], value: Any) -> None:
    for step in path[:-1]:
        below = content.setdefault(step, {})
        if not isinstance(below, dict):
            return  # the validator names the wrong type
        content = below
    content[path[-1]] = value


def _drop_program(teams: Any, side: Side) -> None:
    """Leave the team's program out: a team that an option makes remote keeps the name and the robots of the file."""
    team = teams.get(side.value) if isinstance(teams, dict) else None
    if isinstance(team, dict):
        for kind in PROGRAM_KINDS:
            team.pop(kind, None)


def _validate(content: dict[str, Any], where: str, overrides: dict[str, Any]) -> MatchConfig:
    for side, default in (("cyan", default_cyan()), ("magenta", default_magenta())):
        teams = content.get("teams")
        team = teams.get(side) if isinstance(teams, dict) else None
        if isinstance(teams, dict) and team == REMOTE:
            team = teams[side] = {"remote": True}
        if isinstance(team, dict) and not set(PROGRAM_KINDS) & set(team) and team.get("remote") is not True:
            team["brain"] = default.brain
            team.setdefault("name", default.name)
        given = team if isinstance(team, dict) else {}
        for at, key in ((f"teams.{side}.{key}", key) for key in ("size", "robots", "types") if key in given):
            if content.get("scene") is not None and (at in overrides or "scene" not in overrides):
                raise TouchlineError(f"{where}: a match that starts in a scene has the scene's robots; leave {at} out")
            if key == "size" and isinstance(named := given.get("robots"), list) and len(named) not in (0, given[key]):
                raise TouchlineError(f"{where}: {at} is {given[key]}, and robots names {named}; leave one out")
    return validate_tables(MatchConfig, content, where, REMEDIES)
