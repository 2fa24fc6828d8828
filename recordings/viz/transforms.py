"""Where everything is, as `foxglove.FrameTransforms`: each robot's and the ball's frame in `map`, the field frame.

Written some fifty times a second of simulated time, so the message is made once, and filled in for each world.
"""

from math import cos, sin

from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

from recordings.viz.drawn_world import DrawnWorld
from recordings.viz.foxglove import set_time

MAP = "map"
"""The field frame."""
BALL = "ball"
BALL_SHADOW = "ball/ground"
"""On the ground below the ball."""
_PER_M = 2.0**14
_TO_WHOLE = 1.5 * 2.0**52
"""Added and subtracted, rounds a number below 2^51 as `round` does: a double of that size has no fraction."""
STEP_M = 1 / _PER_M
"""Places are written in steps of 0.06 mm, and turns as finely: numbers of a few digits pack well."""


def base(robot: str) -> str:
    """The frame of a robot: in the centre of its body, x in the kicking direction."""
    return f"{robot}/base_link"


class Transforms:
    """Writes the transforms of one match."""

    def __init__(self) -> None:
        self._robots: list[str] = []
        self._frames(self._robots)

    def encode(self, world: DrawnWorld, log_ns: int) -> bytes:
        """The transforms of a world."""
        robots, ball = world.robots, world.ball
        names = list(robots)
        if names != self._robots:
            self._frames(names)
        numbers: list[float] = []
        for robot in robots.values():
            half = robot.heading / 2
            numbers += (robot.x, robot.y, robot.z, sin(half), cos(half))
        numbers += (ball.x, ball.y, ball.z, 0.0, 1.0)
        numbers += (ball.x, ball.y, 0.0, 0.0, 1.0)
        rounded = iter([(number * _PER_M + _TO_WHOLE - _TO_WHOLE) * STEP_M for number in numbers])
        for (timestamp, place, turn), x, y, z, sine, cosine in zip(self._parts, *[rounded] * 5, strict=True):
            set_time(timestamp, log_ns)
            place.x, place.y, place.z = x, y, z
            turn.z, turn.w = sine, cosine
        return self._message.SerializeToString()

    def _frames(self, robots: list[str]) -> None:
        """Make the message for these robots."""
        self._robots = robots
        self._message = FrameTransforms()
        for frame in (*map(base, robots), BALL, BALL_SHADOW):
            self._message.transforms.add(parent_frame_id=MAP, child_frame_id=frame)
        self._parts = [(one.timestamp, one.translation, one.rotation) for one in self._message.transforms]
