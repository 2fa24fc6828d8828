"""What one robot perceives, before it is a sight: computed from the truth in a match, from readings on hardware."""

from typing import NamedTuple

from schemas.messages.radio import Motion
from schemas.messages.sight import BallSight, Obstacle

DIGITS = 4
"""Decimal places of all perceived numbers: 0.1 mm is below any sensor's noise, and halves the bytes of a sight."""


class Percept(NamedTuple):
    """What one robot perceives, in its team frame as it believes it to lie."""

    own: list[float]
    """x, y, heading, vx, vy, omega: m, rad, m/s, rad/s."""
    ball: list[float] | None
    """x, y, z, vx, vy, in m and m/s, as last seen; None if the robot has never seen the ball."""
    ball_age: float
    """s since the picture in which the ball was last seen."""
    visible: bool
    """The ball is in the newest picture."""
    obstacles: list[Obstacle]
    """The nearest first; the same list in every tick until the next picture."""
    obstacles_age: float
    """s since the picture that shows them."""

    def motion(self) -> Motion:
        """The robot's own pose and twist, as a sight has them."""
        x, y, heading, vx, vy, omega = self.own
        return Motion(x=x, y=y, heading=heading, vx=vx, vy=vy, omega=omega)

    def ball_sight(self) -> BallSight | None:
        """The ball, as a sight has it; None if the robot has never seen it."""
        if self.ball is None:
            return None
        x, y, z, vx, vy = self.ball
        return BallSight(x=x, y=y, z=z, vx=vx, vy=vy, age=self.ball_age, visible=self.visible)
