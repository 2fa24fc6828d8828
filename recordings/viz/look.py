"""What of a world is drawn: the places of its bodies, and what decides how they look.

Read for each tick that is recorded, so nothing else of the message is taken out of it.
"""

from typing import Any

import msgspec


class RobotLook(msgspec.Struct, frozen=True, gc=False):
    """Position in m and heading in rad in the field frame, and why it is off the field."""

    x: float
    y: float
    z: float
    heading: float
    off_field: str | None = None


class BallLook(msgspec.Struct, frozen=True, gc=False):
    """Position in m in the field frame."""

    x: float
    y: float
    z: float


class Look(msgspec.Struct, frozen=True, gc=False):
    """As much of a `schemas.world.World`."""

    robots: dict[str, RobotLook]
    ball: BallLook
    possession: str | None = None
    obstacles: dict[str, Any] = {}


look_at = msgspec.json.Decoder(Look).decode
"""Reads a payload; `ValueError` where it is no world."""
