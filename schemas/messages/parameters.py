"""Live parameters: the numbers of a match's profile, asked for, set and reset while it runs."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field, StrictFloat, StrictInt, StringConstraints

from schemas.message import Message, Part, Source

ParameterName = Annotated[str, StringConstraints(pattern=r"^[a-z_0-9]+(\.[a-z_0-9]+)*$", max_length=120)]
"""As the profile names it, `ball.rolling_deceleration`; a section's name alone stands for all that is in it."""

Value = StrictInt | StrictFloat | str | list[StrictFloat | StrictInt]
"""A number in the parameter's unit, a word, or a list of numbers."""
Setting = Value | None
"""What a parameter is set to; nothing for a number of a type of robots that is the standard robot's again."""


class ParameterOperation(StrEnum):
    """What is asked for."""

    LIST = "list"
    GET = "get"
    SET = "set"
    RESET = "reset"


class ParametersRequest(Message):
    """Asks for parameters, or changes them between two ticks: all that are named, or none."""

    operation: ParameterOperation
    """What is asked for."""
    names: Annotated[list[ParameterName], Field(max_length=200)] = Field(default_factory=list)
    """Parameters or whole sections; for `reset` none stands for all that can be changed."""
    values: Annotated[dict[ParameterName, Value], Field(max_length=200)] = Field(default_factory=dict)
    """For `set`: parameter → its new value."""
    source: Source = "operator"
    """Who asks."""


class Parameter(Part):
    """One parameter as it is now."""

    name: ParameterName
    """Name in the profile, `ball.rolling_deceleration`."""
    description: str
    """What it means."""
    unit: str
    """`1` for a pure number; empty for a word."""
    low: float | None = None
    """The least value that makes sense, in its unit; None where there is no bound."""
    high: float | None = None
    """The greatest value that makes sense, in its unit; None where there is no bound."""
    options: list[str] = Field(default_factory=list)
    """Allowed values of a parameter that is a word."""
    origin: str = ""
    """Where the first value comes from."""
    value: Value
    """Value in force from the next tick on."""
    initial: Value
    """What the match began with: the profile's value, or the match file's in its place."""
    live: bool = True
    """It can be changed while the match runs."""
    fixed_reason: str = ""
    """Why it cannot."""


class ParametersReply(Message):
    """The host's answer: the parameters that were named, as they are from the next tick on."""

    accepted: bool
    """What was asked for was done."""
    reason: str = ""
    """Why it was refused; then nothing was changed."""
    parameters: list[Parameter] = Field(default_factory=list)
    """The parameters that were named, as they are from the next tick on."""
