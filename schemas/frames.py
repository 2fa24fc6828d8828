"""The coordinate frames, defined once: field frame, team frame, body frame, and the transforms between them.

Field frame: fixed to the ground, origin at the centre mark, x along the field, y to the left of x, z up, heading
counter-clockwise from +x. Team frame: the field frame for the side that attacks +x, and the field frame turned by π
for the other side. Body frame: x in the kicking direction, y to the left.
"""

import math
from dataclasses import dataclass

TAU = 2.0 * math.pi
MAP = "map"
"""Name of the field frame, for viewers and ROS."""
BALL = "ball"
"""Name of the ball's frame, in its centre, whose axes are those of the field frame."""
Point = tuple[float, float]
"""x and y of a point on the ground, in m."""


def wrap(angle: float) -> float:
    """The same direction as an angle in (−π, π]."""
    turned = math.remainder(angle, TAU)
    return math.pi if turned == -math.pi else turned


def rotate(x: float, y: float, angle: float) -> tuple[float, float]:
    """The vector (x, y) rotated counter-clockwise by `angle`."""
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y


def to_body(x: float, y: float, heading: float) -> tuple[float, float]:
    """A vector of the field or team frame in the body frame of a robot with that heading."""
    return rotate(x, y, -heading)


def base(robot: str) -> str:
    """Name of a robot's frame, in the centre of its body, with x in the kicking direction."""
    return f"{robot}/base_link"


def pushed(obstacle: str) -> str:
    """Name of the frame of an obstacle that can be pushed, on the ground below its centre."""
    return f"obstacle/{obstacle}"


@dataclass(frozen=True, slots=True)
class Pose:
    """Position in m and heading in rad, in the frame that its owner names."""

    x: float
    y: float
    heading: float = 0.0

    def toward(self, other: "Pose", share: float) -> "Pose":
        """The pose at a share of the way to another one, 0 to 1; turns the shorter way."""
        x, y = self.x + share * (other.x - self.x), self.y + share * (other.y - self.y)
        return Pose(x, y, wrap(self.heading + share * wrap(other.heading - self.heading)))

    def team(self, attack: int) -> "Pose":
        """Transform between the field frame and the team frame of a side that attacks `attack` (+1 or −1); its own
        inverse."""
        if attack > 0:
            return self
        return Pose(-self.x, -self.y, wrap(self.heading + math.pi))
