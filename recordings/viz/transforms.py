"""Positions as `foxglove.FrameTransforms`: the frames of what moves in `map`, the field frame.

They are written fifty times per simulated second, so one message is reused and filled in for each world.
"""

from math import cos, sin

from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

from recordings.viz.drawn_world import DrawnWorld
from recordings.viz.foxglove import set_time
from schemas.frames import BALL, MAP, base, pushed

BALL_SHADOW = "ball/ground"
"""The frame on the ground below the ball."""
_PER_M = 2.0**14
_TO_WHOLE = 1.5 * 2.0**52
"""Adding and subtracting it rounds numbers below 2^51 like `round`: a double of this size has no fraction."""
STEP_M = 1 / _PER_M
"""Step of positions, 0.06 mm, and of rotations: numbers with few digits compress well."""


class Transforms:
    """Encodes the transforms of one match."""

    def __init__(self) -> None:
        self._frames([])

    def encode(self, world: DrawnWorld, log_ns: int) -> bytes:
        """The transforms of a world."""
        robots, ball = world.robots, world.ball
        movables = {pushed(name): one for name, one in world.obstacles.items() if "pushed" in one}
        names = [*map(base, robots), *movables] + [BALL, BALL_SHADOW] * (ball is not None)
        if names != self._names:
            self._frames(names)
        numbers: list[float] = []
        for robot in robots.values():
            half = robot.heading / 2
            numbers += (robot.x, robot.y, robot.z, sin(half), cos(half))
        for one in movables.values():
            numbers += (one["x"], one["y"], 0.0, sin(one["heading"] / 2), cos(one["heading"] / 2))
        if ball is not None:
            numbers += (ball.x, ball.y, ball.z, 0.0, 1.0)
            numbers += (ball.x, ball.y, 0.0, 0.0, 1.0)
        rounded = iter([(number * _PER_M + _TO_WHOLE - _TO_WHOLE) * STEP_M for number in numbers])
        for (timestamp, place, turn), x, y, z, sine, cosine in zip(self._parts, *[rounded] * 5, strict=True):
            set_time(timestamp, log_ns)
            place.x, place.y, place.z = x, y, z
            turn.z, turn.w = sine, cosine
        return self._message.SerializeToString()

    def _frames(self, names: list[str]) -> None:
        """Build the message for these frames."""
        self._names = names
        self._message = FrameTransforms()
        for frame in names:
            self._message.transforms.add(parent_frame_id=MAP, child_frame_id=frame)
        self._parts = [(one.timestamp, one.translation, one.rotation) for one in self._message.transforms]
