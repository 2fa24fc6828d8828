"""Bodies that stand on the pitch and are no robots: boxes and cylinders that nothing moves."""

import math
from enum import StrEnum
from typing import Annotated

from pydantic import Field, model_validator

from schemas.message import Name, Part

Length = Annotated[float, Field(ge=0.02, le=5)]
"""m; thinner than the least and a fast ball goes through it in one step of the physics."""


class Shape(StrEnum):
    """What an obstacle looks like."""

    CYLINDER = "cylinder"
    BOX = "box"


class StaticObstacle(Part):
    """One body on the ground that robots and ball bounce off and nobody moves."""

    name: Name
    """Name of the obstacle; no other body of the match has it."""
    shape: Shape
    """Cylinder or box."""
    place: Annotated[list[float], Field(min_length=2, max_length=2)]
    """x and y of its centre in m, field frame."""
    heading: float = 0.0
    """Direction of a box's `size` x in the field frame, in rad."""
    radius: Length | None = None
    """Radius of a cylinder in m; None for a box."""
    height: Length | None = None
    """Height of a cylinder in m; None for a box."""
    size: Annotated[list[Length], Field(min_length=3, max_length=3)] | None = None
    """Size of a box in m: x along its heading, y across, z upward; None for a cylinder."""

    @model_validator(mode="after")
    def _check_fields(self) -> "StaticObstacle":
        is_cylinder = self.shape is Shape.CYLINDER
        whole = (self.radius is not None, self.height is not None, self.size is not None)
        if whole != (is_cylinder, is_cylinder, not is_cylinder):
            raise ValueError(
                f'obstacle "{self.name}": a cylinder has radius and height, a box has size = [x, y, z]; '
                "give these and no others"
            )
        return self

    @property
    def extents(self) -> tuple[float, float, float]:
        """Size of the box that it just fits into, along its heading, across and up, m."""
        if self.size is not None:
            x, y, z = self.size
            return x, y, z
        assert self.radius is not None and self.height is not None  # the validator has seen to it
        return 2 * self.radius, 2 * self.radius, self.height

    @property
    def reach(self) -> float:
        """Largest distance of its hull from its axis, m: the radius of the circle around it."""
        x, y, _ = self.extents
        return x / 2 if self.shape is Shape.CYLINDER else math.hypot(x, y) / 2
