"""What the engine reports of a body, of two bodies that are near each other, and of the ball's contacts."""

from typing import NamedTuple

from sim_host.physics.vectors import Quaternion, Vector


class BodyState(NamedTuple):
    """What determines a body's future: position m, orientation quaternion xyzw, velocity m/s, spin rad/s."""

    position: Vector
    orientation: Quaternion
    velocity: Vector
    spin: Vector


class Gap(NamedTuple):
    """Two bodies where they are nearest."""

    on_one: Vector
    """m."""
    on_other: Vector
    """m."""
    normal: Vector
    """From the other to the one, of unit length."""
    width: float
    """m; negative where they overlap."""


class BallContacts(NamedTuple):
    """Robots that touch the ball, in roster order, and how deep it is pressed into others than ground and holder, m."""

    robots: list[int]
    depth: float


NO_CONTACTS = BallContacts([], 0.0)
