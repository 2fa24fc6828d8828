"""What of a world is drawn: the places of its bodies, and what decides how they look.

Read for each tick that is recorded, so nothing else of the message is taken out of it.
"""

from typing import Any

import msgspec


class DrawnRobot(msgspec.Struct, frozen=True, gc=False):
    """Position in m and heading in rad in the field frame, and why it is off the field."""

    x: float
    y: float
    z: float
    heading: float
    off_field: str | None = None


class DrawnBall(msgspec.Struct, frozen=True, gc=False):
    """Position in m in the field frame."""

    x: float
    y: float
    z: float


class DrawnWorld(msgspec.Struct, frozen=True, gc=False):
    """As much of a `schemas.messages.world.World`."""

    robots: dict[str, DrawnRobot]
    ball: DrawnBall
    possession: str | None = None
    obstacles: dict[str, Any] = {}


decode_world = msgspec.json.Decoder(DrawnWorld).decode
"""Reads a payload; `ValueError` where it is no world."""
