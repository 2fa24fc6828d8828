"""What a robot's own process reports about its hardware."""

from enum import StrEnum
from typing import Annotated

from msgspec import Meta

from schemas.messages.health import MAX_FAULT
from schemas.wire.message import Message, Name
from schemas.wire.part import Part
from schemas.wire.units import Seconds


class HardwareState(StrEnum):
    """What hardware is ready for."""

    UNCONFIGURED = "unconfigured"
    """Nothing is open."""
    INACTIVE = "inactive"
    """Sensors are read; motors, kicker and dribbler get nothing."""
    ACTIVE = "active"
    """Sensors are read, and demands are carried out."""
    ERROR = "error"
    """It has failed, and is not used any more."""


class Fallback(StrEnum):
    """What the motors do while there is no demand for them."""

    BRAKE = "brake"
    """Come to rest at the deceleration of the profile, and hold."""
    COAST = "coast"
    """Roll freely, without power."""


class DeviceHealth(Part):
    """One source of readings; counts are since the process began."""

    readings: int = 0
    """Readings that were taken over."""
    refused: int = 0
    """Readings that were refused: not finite, from the future, or a jump that the robot cannot make."""
    rate: float = 0.0
    """Readings per second over the last second, in Hz."""
    age: Seconds | None = None
    """Time since the newest reading was taken, in s; None before the first."""


class CallHealth(Part):
    """One method of the hardware's class; counts are since the process began."""

    calls: int = 0
    """Calls."""
    late: int = 0
    """Calls that took longer than the deadline."""
    mean_ms: float = 0.0
    """Mean wall time of a call, in ms."""
    worst_ms: float = 0.0
    """Longest wall time of a call, in ms."""


class HardwareHealth(Message):
    """State of one robot's hardware."""

    time: Seconds
    """Time since the robot's process began, in s."""
    robot: Name
    """The robot."""
    state: HardwareState
    """What the hardware is ready for."""
    armed: bool
    """A person has allowed the motors to move."""
    fallback: Fallback
    """What the motors do while there is no demand for them."""
    fell_back: int = 0
    """Times at which demands ended and the fallback began."""
    clamped: int = 0
    """Demands beyond the limits of the profile, which were shortened."""
    filtered: int = 0
    """Demands that the filter for clearance has changed."""
    reason: Annotated[str, Meta(max_length=MAX_FAULT)] = ""
    """Why there are no demands, or what has failed; empty while all is well."""
    devices: dict[str, DeviceHealth] = {}
    """`motion`, `camera`, a sensor of the profile, or `line` for what could not be read → what was read."""
    calls: dict[str, CallHealth] = {}
    """`configure`, `activate`, `sense`, `actuate`, `deactivate` → what the calls took."""
