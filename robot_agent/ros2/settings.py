"""What the process of a ROS 2 graph is started with."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from runtime.bus.settings import ClientSettings, Endpoint
from runtime.process.log_format import LogSettings
from schemas.config.settings import CommandLine
from schemas.side import Side
from schemas.wire.message import Name


class Ros2Settings(ClientSettings, LogSettings):
    """A match as a ROS 2 graph. Each field is an option of `touchline ros2`."""

    side: Side | None = None
    """Let ROS 2 nodes drive all robots of this side. Without it and without --robot the match is shown only."""
    robot: list[Name] = Field(default_factory=list)
    """Let ROS 2 nodes drive this robot only; repeatable."""
    domain: Annotated[int, Field(ge=0, le=232), CommandLine(environment="ROS_DOMAIN_ID")] = 0
    """Domain of the nodes."""
    listen: Endpoint = "tcp/127.0.0.1:7448"
    """Endpoint to which the nodes connect; port 0 takes a free one."""
    router: Endpoint | None = None
    """Join the graph of this router of rmw_zenoh, tcp/127.0.0.1:7447, in place of --listen."""
    accounts: Path | None = None
    """With --listen: host.json of `touchline credentials new`; only nodes with its accounts join, for own robots."""
    control: bool = False
    """Let nodes pause, step, reset and change the match, by the services of simulation_interfaces below /touchline."""
    every: Annotated[int, Field(ge=1, le=1000)] = 1
    """Lockstep: the nodes answer every so many ticks; between them their last command stands."""
    patience: Annotated[float, Field(ge=0)] = 10.0
    """s of wall time to wait for a host that is not there."""
