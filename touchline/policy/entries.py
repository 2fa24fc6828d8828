"""The entries of an observation: each has a name, a unit, and the values that become numbers near −1 to 1."""

import math
from typing import NamedTuple, Self

from schemas.messages.radio import Motion

NEAR = 5.0
"""m; the distance that is 1 in an observation: most of what decides happens within it."""
FAST = 5.0
"""m/s; the speed of the ball that is 1."""
OLD = 1.0
"""s; the age that is 1, and the most that is told apart."""


class Entry(NamedTuple):
    """One number of an observation."""

    name: str
    """Group and quantity, such as `ball.x`."""
    unit: str
    """Unit of the quantity; `1` for a share, a cosine, or 0 and 1 for no and yes."""
    scale: float
    """The quantity that is 1, in its unit."""
    low: float
    """Least number; smaller ones are raised to it."""
    high: float
    """Largest number; larger ones are lowered to it."""
    meaning: str
    """What it is, for people."""


def flag(name: str, meaning: str) -> Entry:
    """An entry that is 0 for no and 1 for yes."""
    return Entry(name, "1", 1.0, 0.0, 1.0, meaning)


def share(name: str, unit: str, scale: float, meaning: str) -> Entry:
    """An entry from 0 to 1."""
    return Entry(name, unit, scale, 0.0, 1.0, meaning)


def signed(name: str, unit: str, scale: float, limit: float, meaning: str) -> Entry:
    """An entry of either sign, with the largest quantity that is told apart."""
    return Entry(name, unit, scale, -limit / scale, limit / scale, meaning)


def place(name: str, reach: float, whose: str) -> tuple[Entry, Entry]:
    """Where something is, from the robot: ahead and to the left, up to `reach` in m."""
    return (
        signed(f"{name}.x", "m", NEAR, reach, f"{whose}: ahead of the robot, along its kick axis"),
        signed(f"{name}.y", "m", NEAR, reach, f"{whose}: to the left of it"),
    )


def velocity(name: str, scale: float, limit: float, whose: str) -> tuple[Entry, Entry]:
    """How something moves over the ground, in the body frame of the robot."""
    return (
        signed(f"{name}.vx", "m/s", scale, limit, f"{whose}: velocity along the kick axis"),
        signed(f"{name}.vy", "m/s", scale, limit, f"{whose}: velocity to the left"),
    )


def direction(name: str, whose: str) -> tuple[Entry, Entry]:
    """An angle."""
    return (
        signed(f"{name}.cos", "1", 1.0, 1.0, f"{whose}: cosine"),
        signed(f"{name}.sin", "1", 1.0, 1.0, f"{whose}: sine"),
    )


class BodyFrame(NamedTuple):
    """The frame of a robot in its team frame."""

    x: float
    y: float
    cos: float
    sin: float

    @classmethod
    def of(cls, me: Motion) -> Self:
        """The frame of a robot that measures itself there."""
        return cls(me.x, me.y, math.cos(me.heading), math.sin(me.heading))

    def place(self, x: float, y: float) -> tuple[float, float]:
        """A point of the team frame, m, ahead and to the left of the robot, in `NEAR`."""
        return self.vector((x - self.x) / NEAR, (y - self.y) / NEAR)

    def vector(self, x: float, y: float) -> tuple[float, float]:
        """A vector of the team frame, in the body frame."""
        return x * self.cos + y * self.sin, y * self.cos - x * self.sin
