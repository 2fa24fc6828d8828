"""How a robot's hardware is used: its class, what it falls back to, deadlines, and options of its own."""

from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from schemas.config.settings import Settings
from schemas.config.toml_file import read_tables, validate_tables
from schemas.errors import TouchlineError
from schemas.messages.hardware import Fallback


class HardwareSettings(Settings):
    """A hardware file, `NAME.toml`; each key but `hardware` has a default."""

    hardware: str
    """The class, `module:Class`, or `dummy`, `simulated`, `replayed`."""
    fallback: Fallback = Fallback.BRAKE
    """What the motors do while there is no demand: `brake` or `coast`."""
    deadline: Annotated[float, Field(gt=0, le=10)] = 0.02
    """s of wall time that a call of the hardware may take; longer ones are counted."""
    watchdog: Annotated[float, Field(gt=0, le=10)] = 0.2
    """s without a new demand, or of a call that does not return, after which the robot falls back."""
    jump: Annotated[float, Field(gt=0, le=100)] = 0.5
    """m by which a pose may differ from where the robot can have driven; farther ones are refused."""
    relocation: Annotated[float, Field(gt=0, le=60)] = 1.0
    """s for which poses elsewhere must agree with each other to be believed: the robot was carried."""
    clearance: Annotated[float | None, Field(ge=0, le=5)] = None
    """m to keep from bodies and the boundary: demands are changed as little as that takes. By default no filter."""
    options: dict[str, Any] = Field(default_factory=dict)
    """What the class receives besides the model of the robot, such as the port of a serial line."""


def hardware_settings(given: str) -> HardwareSettings:
    """The settings that `--hardware` names: a file that ends in `.toml`, or a class.

    Raises:
        TouchlineError: the file cannot be read, or has an invalid value.
    """
    if not given.endswith(".toml"):
        return HardwareSettings(hardware=given)
    settings = validate_tables(HardwareSettings, read_tables(Path(given), "a hardware file"), given, {})
    if settings.hardware.endswith(".toml"):
        raise TouchlineError(f'{given}: hardware is "{settings.hardware}"; name a class, module:Class')
    return settings
