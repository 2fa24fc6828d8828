"""The claim of a robot by an agent. The host alone decides it: a robot has one agent at a time."""

from typing import Annotated

from msgspec import Meta

from schemas.side import Side
from schemas.wire.message import Message, Name, Source


class AgentClaim(Message):
    """A request of an agent to play a robot.

    The agent declares the liveliness token `alive/session/{session}` before. The robot is its own until that token is
    gone. A claim may be repeated.
    """

    robot: Name
    """Name of the robot."""
    session: Name
    """Name of the agent's liveliness token, which no other agent has."""
    launch_token: Annotated[str, Meta(max_length=64)] | None = None
    """Secret of the launch, from the environment variable TOUCHLINE_LAUNCH_TOKEN; None without one."""
    match: Name | None = None
    """Name of the match that the agent was started for; None for any."""
    side: Side | None = None
    """Side that the agent was started for; None for any."""
    program: Source = ""
    """Name and version of the agent's program, for display: `touchline 0.1.0`."""
    source: Source = ""
    """Where the agent runs, for display: `process 4711 on lab3`."""


class AgentClaimReply(Message):
    """The host's reply to a claim."""

    accepted: bool
    """Whether the robot is the agent's."""
    reason: str = ""
    """Why it is not; empty if it is."""
