"""The tables of a match file: teams, noise, radio, referee, recording and patience."""

import math
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from schemas.config.config_model import ConfigModel
from schemas.config.confinement import TeamLimits
from schemas.config.noise import PRESETS
from schemas.config.roster import MAX_ROBOTS
from schemas.config.settings import RecordOptions
from schemas.config.shipped_teams import brain_of, wrong_team
from schemas.errors import did_you_mean
from schemas.side import Side
from schemas.soccer.game import OfficiatingMode
from schemas.wire.message import Name

Parameter = bool | int | float | Annotated[str, Field(max_length=1000)]
"""A value that a match file hands to the brains of a team."""
MAX_PARAMETERS = 100
"""Most parameters of a team. Chosen here."""

DEFAULT_SIZE = 5
"""Robots of a team that gives neither a size nor names."""


PROGRAM_KINDS = ("brain", "command", "stdio")
"""The keys of a team that give what moves its robots; a team has one of them."""


class TeamConfig(ConfigModel):
    """One team of the match file: its robots and their program."""

    name: str = ""
    """Name of the team, for display; where it is empty, the side's."""
    brain: str | None = None
    """`module:Class` of a brain in Python; each robot's process constructs one instance. In a match file also the name
    of a shipped team, or `policy:FILE` for a trained policy."""
    command: list[str] | None = None
    """Command line of a program in any language, in place of a brain; environment variables name its robot."""
    stdio: list[str] | None = None
    """Command line of a program that reads sights and writes commands as lines of JSON, in place of a brain."""
    process: Literal["robot", "team"] = "robot"
    """With processes: a process for each robot, or one for all robots of the team, whose brains think in turns."""
    remote: bool = False
    """The robots' programs are started on other machines, with `touchline team` or `touchline agent`."""
    size: Annotated[int, Field(ge=1, le=MAX_ROBOTS)] = DEFAULT_SIZE
    """Number of robots, where `robots` does not name them."""
    robots: Annotated[list[Name], Field(max_length=MAX_ROBOTS)] = Field(default_factory=list)
    """Names of the robots, the goalkeeper first; where the list is empty, side and number, as `cyan1`."""
    types: dict[Name, Name] = Field(default_factory=dict)
    """Robot → its type, of the profile or of `[types.NAME]`; other robots are of the standard type."""
    parameters: Annotated[dict[Name, Parameter], Field(max_length=MAX_PARAMETERS)] = Field(default_factory=dict)
    """Numbers, texts and switches for the team's own program, which reads them in `Briefing.parameters`."""
    limits: TeamLimits = TeamLimits()
    """Limits of its robots that replace the match's."""
    pass_environment: list[Annotated[str, Field(pattern=r"^[A-Za-z_]\w*$")]] = Field(default_factory=list)
    """Names of environment variables that its programs get besides the usual ones, such as CUDA_VISIBLE_DEVICES."""

    @field_validator("brain")
    @classmethod
    def _check_brain(cls, brain: str | None) -> str | None:
        if brain is not None and (remedy := wrong_team(brain)):
            raise ValueError(remedy)
        return brain_of(brain) if brain is not None else None

    @field_validator("parameters", mode="before")
    @classmethod
    def _check_parameters(cls, parameters: Any) -> Any:
        for name, value in parameters.items() if isinstance(parameters, dict) else ():
            is_finite = math.isfinite(value) if isinstance(value, float) else isinstance(value, int | str)
            if not is_finite:
                raise ValueError(f"{name} is {value!r}; give a finite number, a text, true or false")
        return parameters

    @property
    def program(self) -> list[str] | None:
        """The command line of the team's own program, of either kind; None for a brain."""
        return self.command if self.command is not None else self.stdio

    @model_validator(mode="after")
    def _check_one_program(self) -> "TeamConfig":
        given = [kind for kind in PROGRAM_KINDS if getattr(self, kind) is not None]
        if len(given) > 1:
            raise ValueError(f"{' and '.join(given)} are both given; a team has one or the other")
        if self.remote and given:
            raise ValueError(f"the team is remote, and is started elsewhere; leave {given[0]} out")
        if self.process == "team" and (self.remote or self.program is not None):
            raise ValueError('process = "team" is for brains in Python that the match starts; leave it out')
        return self


def default_cyan() -> TeamConfig:
    """The team in cyan of a match file that names none."""
    return TeamConfig(name="Simple", brain="simple")


def default_magenta() -> TeamConfig:
    """The team in magenta of a match file that names none."""
    return TeamConfig(name="NuBot", brain="nubot")


class TeamConfigs(ConfigModel):
    """Both teams."""

    cyan: TeamConfig = Field(default_factory=default_cyan)
    """The team in cyan."""
    magenta: TeamConfig = Field(default_factory=default_magenta)
    """The team in magenta."""


class NoiseConfig(ConfigModel):
    """Quality of the robots' perception."""

    preset: str = "profile"
    """Name of a preset of perception noise; `profile` for the numbers of the profile."""

    @field_validator("preset")
    @classmethod
    def _check_preset(cls, preset: str) -> str:
        if preset not in PRESETS:
            raise ValueError(did_you_mean(preset, PRESETS))
        return preset


class RadioOverride(ConfigModel):
    """Radio numbers that replace the profile's."""

    delay: Annotated[float, Field(ge=0, le=5)] | None = None
    """Least simulated time from sending to delivery, in s; None for the profile's."""
    jitter: Annotated[float, Field(ge=0, le=5)] | None = None
    """Longest further time until delivery beyond `delay`, in s; None for the profile's."""
    loss: Annotated[float, Field(ge=0, le=1)] | None = None
    """Share of deliveries that are lost, from 0 to 1; None for the profile's."""
    budget: Annotated[float, Field(ge=0)] | None = None
    """Most bits that a team may send, in bit/s averaged over one second; None for the profile's."""
    model: Literal["separate", "shared", "ticks"] | None = None
    """Whether each side has its own channel, both share one, or times are whole ticks; None for the profile's."""
    bit_rate: Annotated[float, Field(ge=1e4, le=1e9)] | None = None
    """Shared channel: bits of a message per second on the air; None for the profile's."""
    frame_time: Annotated[float, Field(ge=0, le=0.1)] | None = None
    """Shared channel: further time on the air that each message takes, in s; None for the profile's."""
    queue: Annotated[float, Field(ge=0, le=5)] | None = None
    """Shared channel: longest wait of a message in s, beyond which it is refused; None for the profile's."""


class OfficiatingConfig(ConfigModel):
    """How the match is refereed."""

    kick_off: Side = Side.CYAN
    """The side that kicks off the first half."""
    automatic: bool = True
    """The match starts by itself when all robots are present; otherwise it waits for `touchline referee start`."""
    mode: OfficiatingMode = OfficiatingMode.AUTOMATIC
    """Who decides: the referee, people, or the referee with people who may overrule its proposals."""
    proposal: Annotated[float, Field(ge=0, le=60)] = 3.0
    """Mixed officiating: simulated time after which a proposal becomes a decision, in s."""
    winner: bool | None = None
    """A level match continues with extra time and penalties; None for the rule book's setting."""
    advantage: Annotated[float, Field(ge=0, le=30)] | None = None
    """Simulated time for which play goes on after a foul if the side that suffered it keeps the ball, in s; 0 for no
    advantage; None for the rule book's."""


class RecordingConfig(RecordOptions):
    """What is recorded, and whether the match waits for a recorder."""

    admit: list[Name] = Field(default_factory=list)
    """Further recorders than the launch's that a lockstep host waits for when they fall behind."""
    wait: bool = False
    """The first tick waits for a recorder, so that the recording is complete."""


class Patience(ConfigModel):
    """How long the host waits, in s of wall time."""

    attendance: Annotated[float, Field(ge=0, le=86_400)] = 60.0
    """Longest wait for all robots before the first tick, and in one process for a robot to be built, in s."""
    remote: Annotated[float, Field(ge=0, le=86_400)] = 86_400.0
    """Longest wait for the robots of a remote team before the first tick, in s."""
    answer: Annotated[float, Field(gt=0, le=60)] = 10.0
    """Lockstep: longest wait for a robot's answer to one tick, in s. A robot that misses it makes the match depend on
    more than its seed."""
    recorder: Annotated[float, Field(gt=0, le=600)] = 30.0
    """Lockstep: longest wait for a recorder that makes no progress or has lost its connection, in s."""
