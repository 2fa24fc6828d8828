"""Live parameters: the numbers of a match's profile, read, set and reset while it runs."""

from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.wire.message import Message, Source
from schemas.wire.part import Part

ParameterName = Annotated[str, Meta(pattern=r"^[a-z_0-9]+(\.[a-z_0-9]+)*\Z", max_length=120)]
"""Name in the profile, `ball.rolling_deceleration`; the name of a section stands for all of its parameters."""

Value = int | float | str | list[int | float]
"""A number in the parameter's unit, a word, or a list of numbers."""
Setting = Value | None
"""The value of a parameter; None where a type of robot has the value of the standard robot again."""


class ParameterOperation(StrEnum):
    """What to do with parameters."""

    LIST = "list"
    GET = "get"
    SET = "set"
    RESET = "reset"


class ParametersRequest(Message):
    """A request to read parameters, or to change them between two ticks: all that are named, or none."""

    operation: ParameterOperation
    """What to do."""
    names: Annotated[list[ParameterName], Meta(max_length=200)] = []
    """Parameters or whole sections; for `reset`, an empty list stands for all that can be changed."""
    values: Annotated[dict[ParameterName, Value], Meta(max_length=200)] = {}
    """For `set`: parameter → its new value."""
    source: Source = "operator"
    """Name of the sender, for display."""


class Parameter(Part):
    """One parameter in its current state."""

    name: ParameterName
    """Name in the profile, `ball.rolling_deceleration`."""
    description: str
    """What it means."""
    unit: str
    """Its unit; `1` for a dimensionless number, empty for a word."""
    low: float | None = None
    """The least sensible value, in its unit; None without a bound."""
    high: float | None = None
    """The greatest sensible value, in its unit; None without a bound."""
    options: list[str] = []
    """Valid values of a parameter that is a word."""
    origin: str = ""
    """Source of the initial value."""
    value: Value
    """Value in force from the next tick on."""
    initial: Value
    """Value at the start of the match: the profile's, or the match file's."""
    live: bool = True
    """It can be changed while the match runs."""
    fixed_reason: str = ""
    """Why it cannot be changed; empty where it can."""


class ParametersReply(Message):
    """The host's reply."""

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; then nothing was changed."""
    parameters: list[Parameter] = []
    """The parameters that were named, as they are from the next tick on."""
