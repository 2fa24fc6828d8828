"""Robots and ball as plain numbers in the team frame, and their extrapolation in time."""

import math
from typing import NamedTuple, Protocol

from schemas.config.rolling import Rolling
from schemas.messages.setup import Setup


class Moving(Protocol):
    """A robot as skills take it, `Body` or `schemas.messages.radio.Motion`: m, rad, m/s, rad/s."""

    @property
    def x(self) -> float: ...
    @property
    def y(self) -> float: ...
    @property
    def heading(self) -> float: ...
    @property
    def vx(self) -> float: ...
    @property
    def vy(self) -> float: ...
    @property
    def omega(self) -> float: ...


class Body(NamedTuple):
    """A robot: m, rad, m/s, rad/s."""

    x: float
    y: float
    heading: float
    vx: float = 0.0
    vy: float = 0.0
    omega: float = 0.0

    def after(self, time: float) -> "Body":
        """The body `time` s later at constant velocity."""
        x, y, heading, vx, vy, omega = self
        return Body(x + vx * time, y + vy * time, heading + omega * time, vx, vy, omega)


class Ball(NamedTuple):
    """The ball on the ground: m, m/s."""

    x: float
    y: float
    vx: float = 0.0
    vy: float = 0.0

    def after(self, time: float, rolling: Rolling) -> "Ball":
        """The ball `time` s later, untouched."""
        x, y, vx, vy = self
        speed = math.hypot(vx, vy)
        if speed < 1e-6 or time == 0.0:
            return self
        left, distance = rolling.after(speed, time)
        way, kept = distance / speed, left / speed
        return Ball(x + vx * way, y + vy * way, vx * kept, vy * kept)


class DriveLimits(NamedTuple):
    """Limits of the drive, and the tick that a demand takes to act."""

    speed: float
    turn_rate: float
    acceleration: float
    deceleration: float
    turn_acceleration: float
    tick: float
    sideways: bool = True
    """The robot moves in any direction, whatever its heading; False on two wheels."""

    @classmethod
    def of(cls, setup: Setup) -> "DriveLimits":
        """The limits of the robot whose model the setup has; the setup of a briefing has the robot's own."""
        drive = setup.drive
        return cls(
            drive.max_speed,
            drive.max_turn_rate,
            drive.acceleration,
            drive.deceleration,
            drive.turn_acceleration,
            setup.time.tick,
            drive.sideways,
        )

    def capped(self, speed: float | None = None, turn_rate: float | None = None) -> "DriveLimits":
        """The same limits with lower speeds."""
        return self._replace(
            speed=self.speed if speed is None else min(self.speed, speed),
            turn_rate=self.turn_rate if turn_rate is None else min(self.turn_rate, turn_rate),
        )
