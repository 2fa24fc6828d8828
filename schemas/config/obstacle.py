"""Static obstacles on the pitch: boxes and cylinders."""

import math
from enum import StrEnum
from typing import Annotated

from pydantic import Field, model_validator

from schemas.config.config_model import ConfigModel
from schemas.wire.message import Name

Length = Annotated[float, Field(ge=0.02, le=5)]
"""m; a fast ball would pass through a thinner body in one physics step."""


class Shape(StrEnum):
    """The shape of an obstacle."""

    CYLINDER = "cylinder"
    BOX = "box"


class StaticObstacle(ConfigModel):
    """One static body on the ground, which robots and ball bounce off."""

    name: Name
    """Name of the obstacle; unique among the bodies of the match."""
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
        """Size of its bounding box along its heading, across it and upward, in m."""
        if self.size is not None:
            x, y, z = self.size
            return x, y, z
        assert self.radius is not None and self.height is not None  # as the validator checks
        return 2 * self.radius, 2 * self.radius, self.height

    @property
    def reach(self) -> float:
        """Largest distance of its hull from its axis in m: the radius of the circle around it."""
        x, y, _ = self.extents
        return x / 2 if self.shape is Shape.CYLINDER else math.hypot(x, y) / 2
