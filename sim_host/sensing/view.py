"""The fields of view of cameras that do not see all round."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from schemas.config.sections import CameraView
from sim_host.sensing.random_streams import Floats, Vectors
from sim_host.sensing.sight_lines import Flags

_ALL_ROUND = -2.0
"""In place of a cosine: every direction is in view, and rounding errors do not matter."""


@dataclass(frozen=True, slots=True)
class View:
    """The fields of view of all robots, each centred on the kick axis."""

    edges: Floats
    """Per robot, (robots, 1): cosine of the angle between kick axis and edge of view."""

    @classmethod
    def of(cls, cameras: Sequence[CameraView]) -> Self | None:
        """The fields of view of these cameras, or None if all of them see all round."""
        angles = [camera.field_of_view for camera in cameras]
        if all(angle >= math.tau for angle in angles):
            return None
        return cls(np.array([[_ALL_ROUND if angle >= math.tau else math.cos(angle / 2)] for angle in angles]))

    def has(self, places: Vectors, distance: Floats, headings: Floats) -> Flags:
        """Whether the centre of each thing is in a robot's field of view, edges included, (robots, things).

        `places` of the things as seen from each robot, m, in the directions of the field, and their `distance`.
        """
        axes = np.exp(1j * headings)[:, None]
        ahead = places.real * axes.real + places.imag * axes.imag
        found: Flags = ahead >= self.edges * distance
        return found
