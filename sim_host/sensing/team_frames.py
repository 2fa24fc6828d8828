"""Robots as the sensors work with them, all at once: how they move, and where each believes its team frame to lie."""

from collections.abc import Sequence
from itertools import chain
from typing import NamedTuple, Self

import numpy as np

from sim_host.sensing.streams import Floats, Vectors
from sim_host.snapshot import RobotState

_NUMBERS = len(RobotState._fields)


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
        numbers = np.fromiter(chain.from_iterable(robots), float, _NUMBERS * len(robots))
        place, height_heading, velocity, omega_holding = numbers.view(complex).reshape(-1, _NUMBERS // 2).T
        return cls(place, height_heading.imag, velocity, omega_holding.real)


class TeamFrames(NamedTuple):
    """The team frame of each robot as that robot believes it to lie: a place of the field is `sign · place + shift`.

    Things near a robot lie about its own place as they do in truth, turned by `turn` with everything else.
    """

    sign: Vectors
    """1, or −1 for who attacks −x; complex as what it is multiplied with."""
    shift: Vectors
    """m."""
    turn: Vectors
    """Of unit length; turns what is seen of the field into the frame."""
    angle: Floats
    """rad; by which `turn` turns."""
