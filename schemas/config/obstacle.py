"""Obstacles on the floor: boxes and cylinders, which stand fast or can be pushed."""

import math
from collections.abc import Generator
from enum import StrEnum
from typing import Annotated, Any

from pydantic import Field, model_validator

from schemas.config.config_model import ConfigModel
from schemas.config.roster import Placement
from schemas.wire.message import Name

Length = Annotated[float, Field(ge=0.02, le=5)]
"""m; a fast ball would pass through a thinner body in one physics step."""

MAX_OBSTACLES = 100
"""Most obstacles of a match. Chosen here."""
_OF_MOVABLES = frozenset({"mass", "friction"})
"""Keys that are omitted where they are None: without them, matches are the same as before there were any."""
_FRICTION = 0.5
"""Of cardboard and wood on a hard floor. Chosen here."""


class Shape(StrEnum):
    """The shape of an obstacle."""

    CYLINDER = "cylinder"
    BOX = "box"


class ObstacleConfig(ConfigModel):
    """One body on the ground, which robots and ball bounce off; one with a mass can be pushed."""

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
    mass: Annotated[float, Field(ge=0.05, le=1000)] | None = None
    """Mass in kg of an obstacle that can be pushed; None for one that stands fast."""
    friction: Annotated[float, Field(ge=0, le=2)] | None = None
    """Coefficient of friction of an obstacle with a mass on the ground; None for 0.5."""

    @model_validator(mode="after")
    def _check_fields(self) -> "ObstacleConfig":
        is_cylinder = self.shape is Shape.CYLINDER
        whole = (self.radius is not None, self.height is not None, self.size is not None)
        if whole != (is_cylinder, is_cylinder, not is_cylinder):
            raise ValueError(
                f'obstacle "{self.name}": a cylinder has radius and height, a box has size = [x, y, z]; '
                "give these and no others"
            )
        if self.friction is not None and self.mass is None:
            raise ValueError(
                f'obstacle "{self.name}": friction is for an obstacle with a mass; give mass, or leave it out'
            )
        return self

    def __iter__(self) -> Generator[tuple[str, Any], None, None]:
        """Field and value, without `mass` and `friction` where they are None, as on the wire."""
        yield from ((key, value) for key, value in super().__iter__() if value is not None or key not in _OF_MOVABLES)

    @property
    def extents(self) -> tuple[float, float, float]:
        """Size of its bounding box along its heading, across it and upward, in m."""
        if self.size is not None:
            x, y, z = self.size
            return x, y, z
        assert self.radius is not None and self.height is not None  # as the validator checks
        return 2 * self.radius, 2 * self.radius, self.height

    @property
    def placement(self) -> Placement:
        """Where it is at first."""
        return Placement(body=self.name, x=self.place[0], y=self.place[1], heading=self.heading)

    @property
    def floor_friction(self) -> float:
        """Coefficient of friction on the ground."""
        return _FRICTION if self.friction is None else self.friction

    @property
    def reach(self) -> float:
        """Largest distance of its hull from its axis in m: the radius of the circle around it."""
        x, y, _ = self.extents
        return x / 2 if self.shape is Shape.CYLINDER else math.hypot(x, y) / 2
