"""What a robot's program shows its authors: values by name, and shapes drawn over the field.

It is sent with a command, and has no effect on the match: the host publishes it to the robot's own coach, the operator
and recorders alone.
"""

from typing import Annotated, Any, ClassVar, Self, TypeVar

import msgspec
from msgspec import Meta

from schemas.wire.checked import Checked
from schemas.wire.faults import Fault, FaultError, FaultKind
from schemas.wire.message import Message, Name, ShortText
from schemas.wire.part import Part, encode
from schemas.wire.units import Finite

MAX_VALUES = 64
"""Values in one command."""
MAX_SHAPES = 64
"""Shapes of each kind in one command."""
MAX_CORNERS = 32
"""Corners of a polygon."""
MAX_BYTES = 8192
"""Bytes of all values and shapes of one command as JSON."""
SHOWN_S = 0.5
"""Simulated time in s for which a drawing is shown, unless the robot's next one replaces it earlier."""
COLOURS = {
    "white": "#ffffff",
    "black": "#000000",
    "grey": "#808080",
    "red": "#ff0000",
    "orange": "#ffa500",
    "yellow": "#ffff00",
    "lime": "#00ff00",
    "cyan": "#00ffff",
    "blue": "#0000ff",
    "magenta": "#ff00ff",
}
"""Colour by name, as in CSS → the same colour as `#rrggbb`."""

DebugColour = Annotated[
    str,
    Meta(
        pattern=rf"^(#[0-9a-fA-F]{{6}}|{'|'.join(COLOURS)})\Z",
        description=f"#rrggbb, or one of {', '.join(COLOURS)}",
    ),
]
Coordinate = Annotated[float, Meta(ge=-100, le=100, extra={"unit": "m"})]
Radius = Annotated[float, Meta(gt=0, le=100, extra={"unit": "m"})]
ValueName = Annotated[str, Meta(min_length=1, max_length=40)]


class DebugPoint(Part, metaclass=Checked):
    """A marked point."""

    x: Coordinate
    """x in the team frame, in m."""
    y: Coordinate
    """y in the team frame, in m."""
    colour: DebugColour = "yellow"
    """Colour of the mark."""


class DebugLine(Part, metaclass=Checked):
    """A straight line between two points."""

    x1: Coordinate
    """x of the first point in the team frame, in m."""
    y1: Coordinate
    """y of the first point in the team frame, in m."""
    x2: Coordinate
    """x of the second point in the team frame, in m."""
    y2: Coordinate
    """y of the second point in the team frame, in m."""
    colour: DebugColour = "yellow"
    """Colour of the line."""


class DebugCircle(Part, metaclass=Checked):
    """A circle on the ground."""

    x: Coordinate
    """x of the centre in the team frame, in m."""
    y: Coordinate
    """y of the centre in the team frame, in m."""
    radius: Radius
    """Radius in m."""
    colour: DebugColour = "yellow"
    """Colour of the outline."""


class DebugCorner(Part, metaclass=Checked):
    """A corner of a polygon."""

    x: Coordinate
    """x in the team frame, in m."""
    y: Coordinate
    """y in the team frame, in m."""


class DebugPolygon(Part, metaclass=Checked):
    """A closed outline."""

    corners: Annotated[list[DebugCorner], Meta(min_length=2, max_length=MAX_CORNERS)]
    """The corners in order; the last is joined to the first."""
    colour: DebugColour = "yellow"
    """Colour of the outline."""


class DebugText(Part, metaclass=Checked):
    """Text at a point."""

    x: Coordinate
    """x of the text's centre in the team frame, in m."""
    y: Coordinate
    """y of the text's centre in the team frame, in m."""
    text: ShortText
    """One line of text."""
    colour: DebugColour = "yellow"
    """Colour of the text."""


class _Bounded(Checked):
    """The metaclass of `Debug`: a constructor call checks its size, too."""

    def __call__(cls, *args: Any, **fields: Any) -> Any:  # noqa: N805
        debug: Any = super().__call__(*args, **fields)
        size = len(encode(debug))
        if size > MAX_BYTES:
            reason = f"debug has {size} bytes as JSON; at most {MAX_BYTES}, draw less or use shorter names"
            raise FaultError(Fault((), None, reason, FaultKind.RULE))
        return debug


class Debug(Part, omit_defaults=True, metaclass=_Bounded):
    """Values and shapes of one tick, for the robot's authors."""

    values: Annotated[dict[ValueName, Finite | int | bool | ShortText], Meta(max_length=MAX_VALUES)] = {}
    """Values by name: numbers become curves."""
    points: Annotated[list[DebugPoint], Meta(max_length=MAX_SHAPES)] = []
    """Marked points."""
    lines: Annotated[list[DebugLine], Meta(max_length=MAX_SHAPES)] = []
    """Straight lines."""
    circles: Annotated[list[DebugCircle], Meta(max_length=MAX_SHAPES)] = []
    """Circles."""
    polygons: Annotated[list[DebugPolygon], Meta(max_length=MAX_SHAPES)] = []
    """Closed outlines."""
    texts: Annotated[list[DebugText], Meta(max_length=MAX_SHAPES)] = []
    """Texts."""

    def in_field_frame(self, attack: int) -> Self:
        """The same with all coordinates in the field frame, for a side that attacks `attack`, +1 or −1."""
        if attack > 0:
            return self
        return msgspec.structs.replace(
            self,
            points=[_turned(point, "x", "y") for point in self.points],
            lines=[_turned(line, "x1", "y1", "x2", "y2") for line in self.lines],
            circles=[_turned(circle, "x", "y") for circle in self.circles],
            polygons=[
                one.replace(corners=[_turned(corner, "x", "y") for corner in one.corners]) for one in self.polygons
            ],
            texts=[_turned(text, "x", "y") for text in self.texts],
        )


class RobotDebug(Message):
    """What a robot's program shows its authors, with the tick that it belongs to."""

    max_bytes: ClassVar[int] = 2 * MAX_BYTES

    tick: int
    """Tick of the sight that the program answered."""
    time: float
    """Simulated time of that sight in s: tick × control tick."""
    robot: Name
    """The robot whose program sent it."""
    debug: Debug
    """Values and shapes as in the command; coordinates are in the field frame."""


_S = TypeVar("_S", bound=Part)


def _turned(shape: _S, *coordinates: str) -> _S:
    """A shape turned by π about the centre mark; 0, never -0."""
    return msgspec.structs.replace(shape, **{name: 0.0 - getattr(shape, name) for name in coordinates})
