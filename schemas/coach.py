"""What a coach tells a side: the paper's coach record in SI units, sequence-numbered."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field, StringConstraints

from schemas.game import Point
from schemas.message import Message, Name


class CoachMode(StrEnum):
    """What the team shall do while the game allows it."""

    PLAY = "play"
    HOLD = "hold"
    PARK = "park"
    TEST = "test"


class CoachOrder(Message):
    """A standing order; the newest counts, and each robot acknowledges it by its number. Points in the team frame."""

    sequence: Annotated[int, Field(ge=1)]
    """Larger than that of every order before it."""
    mode: CoachMode = CoachMode.PLAY
    tactic: Annotated[str, StringConstraints(max_length=80)] = ""
    """A word that the team's own code understands."""
    point_a: Point | None = None
    point_b: Point | None = None
    angle_a: float | None = None
    angle_b: float | None = None
    robot_a: Name | None = None
    robot_b: Name | None = None
    kick_speed: Annotated[float, Field(gt=0, le=40)] | None = None
    max_speed: Annotated[float, Field(gt=0, le=20)] | None = None
    max_turn_rate: Annotated[float, Field(gt=0, le=50)] | None = None
