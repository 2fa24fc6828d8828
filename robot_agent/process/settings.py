"""What a robot's process is started with."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from runtime.bus.settings import ClientSettings
from runtime.bus.without_host import WithoutHost
from runtime.process.log_format import LogSettings
from schemas.config.settings import CommandLine
from schemas.side import Side
from schemas.wire.message import Name

FIRST_SIGHT_FAILED = 113
"""Exit status of an agent whose brain failed at its first sight: it would fail again. No brain ends itself with it."""


class BodyOptions(WithoutHost):
    """The robot's own hardware, in place of a body in the simulation; without a host, its network and its match."""

    hardware: str = ""
    """The robot's own hardware: module:Class, a hardware file *.toml, or dummy, simulated, replayed."""
    arm: bool = False
    """Let the hardware move the robot; without it sensors are read and the brain runs, and the motors get nothing."""


class AgentOptions(ClientSettings, LogSettings):
    """One robot's process: its match, its name and its brain. Each field is an option of `touchline agent`."""

    robot: Annotated[Name, CommandLine(environment="TOUCHLINE_ROBOT")]
    """Name of the robot: cyan1, magenta3, …"""
    brain: Annotated[str, CommandLine(environment="TOUCHLINE_BRAIN")] = ""
    """module:Class, module:function of a plain act(sight), policy:FILE, or a shipped team by name."""
    brain_folder: Path | None = None
    """Folder in which the module is looked for before the current directory; a match uses the folder of its file."""
    launch_folder: Path | None = None
    """Folder in which the module is looked for after that; by default the current directory."""
    reload: bool = False
    """Build the brain anew between two episodes if its code has changed."""
    recording: Path | None = None
    """The recording of the match, which messages on breakpoints name."""
    side: Annotated[Side | None, CommandLine(environment="TOUCHLINE_SIDE")] = None
    """The robot's side; the host refuses a robot of the other one. By default it is not checked."""
    launch_token: Annotated[str | None, CommandLine(environment="TOUCHLINE_LAUNCH_TOKEN")] = None
    """Secret of the host that the agent joins; by default none."""
    patience: Annotated[float, Field(ge=0)] = 10.0
    """s of wall time to wait for a host that is not there."""
    body: BodyOptions = BodyOptions()
    """The robot's own hardware; by default its body is simulated by the host."""


class AgentSettings(AgentOptions):
    """One robot's process, with a brain or a program; or that of several robots with the same brain."""

    mates: list[Name] = Field(default_factory=list)
    """Further robots of the process, each with a brain of its own."""
    stdio: list[str] = Field(default_factory=list)
    """Command line of a program that reads sights and writes commands as lines of JSON, in place of a brain."""
