"""Robots as the sensors work with them, all at once: how they move, and where each believes its team frame to lie."""

from collections.abc import Sequence
from typing import NamedTuple, Self

import numpy as np

from sim_host.sensing.streams import Floats, Vectors
from sim_host.snapshot import RobotState


class Motions(NamedTuple):
    """The true motions of all robots, in the field frame, in the order of the roster."""

    place: Vectors
    """m."""
    heading: Floats
    """rad."""
    velocity: Vectors
    """m/s."""
    omega: Floats
    """rad/s."""

    @classmethod
    def of(cls, robots: Sequence[RobotState]) -> Self:
        """Those of these robots."""
        return cls(
            place=np.array([complex(robot.x, robot.y) for robot in robots], dtype=complex),
            heading=np.array([robot.heading for robot in robots]),
            velocity=np.array([complex(robot.vx, robot.vy) for robot in robots], dtype=complex),
            omega=np.array([robot.omega for robot in robots]),
        )


class TeamFrames(NamedTuple):
    """The team frame of each robot as that robot believes it to lie: a place of the field is `sign · place + shift`.

    Things near a robot lie about its own place as they do in truth, turned by `turn` with everything else.
    """

    sign: Floats
    """1, or −1 for who attacks −x."""
    shift: Vectors
    """m."""
    turn: Vectors
    """Of unit length; turns what is seen of the field into the frame."""
    angle: Floats
    """rad; by which `turn` turns."""
