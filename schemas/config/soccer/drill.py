"""What makes a scene a drill: how long it lasts, what is a success, and how the start differs from seed to seed."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field, field_validator

from schemas.config.config_model import ConfigModel
from schemas.errors import did_you_mean
from schemas.side import Side
from schemas.wire.message import Name

OCCURRENCES = {
    "goal": "the referee gave a goal; WHO has scored",
    "ball_out": "the ball left the pitch",
    "foul": "the referee called a foul; WHO committed it",
    "card": "the referee showed a card; WHO got it",
    "stop": "the referee stopped play",
    "in_play": "the ball of a restart was released; WHO took it",
    "touch": "WHO touched the ball, and had not in the tick before",
    "held_by": "WHO got hold of the ball",
    "kick": "a kick of WHO was carried out",
    "pass": "a kick of WHO was received by a teammate",
    "shot": "a kick of WHO was a shot, and its outcome is clear: goal, saved, blocked or missed",
    "save": "a shot was saved; WHO saved it",
}
"""What can happen in a scene; `goal:cyan` and `touch:cyan2` name a side or a robot as WHO, `goal` is anybody's."""

Occurred = str
"""What has happened, as it is written: `goal`, `goal:cyan`, `held_by:magenta1`."""


class DrillResult(StrEnum):
    """The result of a drill."""

    SUCCESS = "success"
    FAILURE = "failure"


class Drill(ConfigModel):
    """The end of a scene and its verdict: it ends when a condition is met; a failure comes before a success."""

    seconds: Annotated[float, Field(gt=0, le=600)]
    """Simulated time in s after which it ends in any case."""
    success: Annotated[list[Occurred], Field(max_length=20)] = Field(default_factory=list)
    """What makes it a success, such as `goal:cyan`."""
    failure: Annotated[list[Occurred], Field(max_length=20)] = Field(default_factory=list)
    """What makes it a failure, such as `ball_out` or `held_by:magenta`."""
    otherwise: DrillResult = DrillResult.FAILURE
    """The verdict when `seconds` have passed."""
    side: Side = Side.CYAN
    """The side that practises."""

    @field_validator("success", "failure")
    @classmethod
    def _check_known(cls, occurred: list[str]) -> list[str]:
        for one in occurred:
            name = one.partition(":")[0]
            if name not in OCCURRENCES:
                raise ValueError(did_you_mean(name, OCCURRENCES))
        return occurred


class Variation(ConfigModel):
    """How far a body may start from its place in the scene, to both sides; equally likely."""

    body: Name
    """The body: `ball`, or the name of a robot or an obstacle."""
    x: Annotated[float, Field(ge=0)] = 0.0
    """x in m."""
    y: Annotated[float, Field(ge=0)] = 0.0
    """y in m."""
    heading: Annotated[float, Field(ge=0)] = 0.0
    """Heading of a robot or an obstacle in rad."""
    vx: Annotated[float, Field(ge=0)] = 0.0
    """Velocity along x in m/s."""
    vy: Annotated[float, Field(ge=0)] = 0.0
    """Velocity along y in m/s."""
    vz: Annotated[float, Field(ge=0)] = 0.0
    """Velocity of the ball upward in m/s."""
