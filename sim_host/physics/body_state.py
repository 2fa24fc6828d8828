"""The reports of the engine: the state of a body, the gap between two bodies, and the contacts of the ball."""

from typing import NamedTuple

from sim_host.physics.vectors import Quaternion, Vector


class BodyState(NamedTuple):
    """The state that determines a body's future: position m, orientation xyzw, velocity m/s, spin rad/s."""

    position: Vector
    orientation: Quaternion
    velocity: Vector
    spin: Vector


class Gap(NamedTuple):
    """The nearest points of two bodies."""

    on_one: Vector
    """m."""
    on_other: Vector
    """m."""
    normal: Vector
    """Unit vector from the other body to the first."""
    width: float
    """m; negative where they overlap."""


class BallContacts(NamedTuple):
    """Robots that touch the ball, in the order of the roster, and the depth in m to which it is pressed into a body.

    Depth in the ground, and in the robot that holds the ball, does not count.
    """

    robots: list[int]
    depth: float


NO_CONTACTS = BallContacts([], 0.0)
