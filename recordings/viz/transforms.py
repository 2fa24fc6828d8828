"""Where everything is, as `foxglove.FrameTransforms`: each robot's and the ball's frame in `map`, the field frame.

Written some fifty times a second of simulated time, so the bytes are put together by hand.
"""

import struct
from math import cos, sin

from recordings.viz.drawn_world import DrawnWorld
from recordings.viz.foxglove import timestamp
from recordings.viz.protobuf_wire import BYTES, content, tag, varint

MAP = "map"
"""The field frame."""
BALL = "ball"
BALL_SHADOW = "ball/ground"
"""On the ground below the ball."""
_PER_M = 2.0**14
_TO_WHOLE = 1.5 * 2.0**52
"""Added and taken away, rounds a number below 2^51 as `round` does: beside it a double has no places for a fraction."""
STEP_M = 1 / _PER_M
"""Places are written in steps of 0.06 mm, and turns as finely: numbers of a few digits pack well."""

_PLACE_AND_TURN = struct.Struct("<BBBdBdBdBBBdBd")
"""Fields 4, translation, and 5, rotation about z, of a transform with their tags and lengths."""


def base(robot: str) -> str:
    """The frame of a robot: in the centre of its body, x in the kicking direction."""
    return f"{robot}/base_link"


class Transforms:
    """Writes the transforms of one match."""

    def __init__(self) -> None:
        self._robots: list[str] = []
        self._begins: dict[int, list[tuple[bytes, bytes]]] = {}
        """Length of the stamp → frame by frame, what stands before the stamp of a transform, and behind it."""

    def encode(self, world: DrawnWorld, log_ns: int) -> bytes:
        """The transforms of a world."""
        now = content(1, timestamp(log_ns))
        robots, ball = world.robots, world.ball
        numbers: list[float] = []
        for robot in robots.values():
            half = robot.heading / 2
            numbers += (robot.x, robot.y, robot.z, sin(half), cos(half))
        numbers += (ball.x, ball.y, ball.z, 0.0, 1.0)
        numbers += (ball.x, ball.y, 0.0, 0.0, 1.0)
        rounded = iter([(number * _PER_M + _TO_WHOLE - _TO_WHOLE) * STEP_M for number in numbers])
        out: list[bytes] = []
        begins = self._begins_of(list(robots), len(now))
        for (begin, names), x, y, z, sine, cosine in zip(begins, *[rounded] * 5, strict=True):
            turn = _PLACE_AND_TURN.pack(0x22, 27, 0x09, x, 0x11, y, 0x19, z, 0x2A, 18, 0x19, sine, 0x21, cosine)
            out += (begin, now, names, turn)
        return b"".join(out)

    def _begins_of(self, robots: list[str], length: int) -> list[tuple[bytes, bytes]]:
        if robots != self._robots:
            self._robots, self._begins = robots, {}
        begins = self._begins.get(length)
        if begins is None:
            frames = [*map(base, robots), BALL, BALL_SHADOW]
            begins = self._begins[length] = [_begin(frame, length) for frame in frames]
        return begins


def _begin(frame: str, length: int) -> tuple[bytes, bytes]:
    names = content(2, MAP) + content(3, frame)
    whole = length + len(names) + _PLACE_AND_TURN.size
    return tag(1, BYTES) + varint(whole), names
