"""The fields of a world that are drawn: the positions of its bodies, and what determines their appearance.

They are read for each recorded tick, so only these fields are decoded.
"""

from typing import Any

import msgspec


class DrawnRobot(msgspec.Struct, frozen=True, gc=False):
    """Position in m and heading in rad in the field frame, and why the robot is off the field."""

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
    """The drawn fields of `schemas.messages.world.World`."""

    robots: dict[str, DrawnRobot]
    ball: DrawnBall | None
    possession: str | None = None
    obstacles: dict[str, Any] = {}
    sensors: dict[str, dict[str, dict[str, Any]]] = {}


decode_world = msgspec.json.Decoder(DrawnWorld).decode
"""Decodes a payload; raises `ValueError` if it is not a world."""
