"""The reports of the engine: the state of a body, the gap between two bodies, and the contacts of the ball."""

from collections.abc import Mapping
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
    """The ball's contacts in one step, other than with the ground."""

    forces: Mapping[int, float]
    """Robot, in the order of the roster → normal force in N between its hull and the ball; 0 for a hull that is near
    enough for a contact and does not press."""
    depth: float
    """m; depth to which the ball is pressed into a body other than the robot that holds it."""


NO_CONTACTS = BallContacts({}, 0.0)
