"""Where everything is, as `foxglove.FrameTransforms`: each robot's and the ball's frame in `map`, the field frame.

Written some fifty times a second of simulated time, so the bytes are put together by hand.
"""

import math
import struct
from collections.abc import Mapping
from typing import Any

from recordings.exchange.protobuf.wire import BYTES, content, tag, varint
from recordings.viz.foxglove import stamp

MAP = "map"
"""The field frame."""
BALL = "ball"
BALL_SHADOW = "ball/ground"
"""On the ground below the ball."""
STEP_M = 2.0**-14
"""Places are written in steps of 0.06 mm, and turns as finely: numbers of a few digits pack well."""

_PLACE_AND_TURN = struct.Struct("<BBBdBdBdBBBdBd")
"""Fields 4, translation, and 5, rotation about z, of a transform with their tags and lengths."""
_LENGTH = _PLACE_AND_TURN.size
_EACH = tag(1, BYTES)


def base(robot: str) -> str:
    """The frame of a robot: in the centre of its body, x in the kicking direction."""
    return f"{robot}/base_link"


class Transforms:
    """Writes the transforms of one match."""

    def __init__(self) -> None:
        self._names: dict[str, bytes] = {}

    def encode(self, world: Mapping[str, Any], log_ns: int) -> bytes:
        """The transforms of a `World` in plain values.

        Raises:
            KeyError, TypeError, ValueError, OverflowError: it is none.
        """
        now = content(1, stamp(log_ns))
        out: list[bytes] = []
        for name, robot in world["robots"].items():
            half = robot["heading"] / 2
            self._add(out, now, base(name), robot["x"], robot["y"], robot["z"], math.sin(half), math.cos(half))
        ball = world["ball"]
        self._add(out, now, BALL, ball["x"], ball["y"], ball["z"], 0.0, 1.0)
        self._add(out, now, BALL_SHADOW, ball["x"], ball["y"], 0.0, 0.0, 1.0)
        return b"".join(out)

    def _add(self, out: list[bytes], now: bytes, child: str, *numbers: float) -> None:
        names = self._names.get(child)
        if names is None:
            names = self._names[child] = content(2, MAP) + content(3, child)
        x, y, z, sine, cosine = [round(number / STEP_M) * STEP_M for number in numbers]
        out += (
            _EACH,
            varint(len(now) + len(names) + _LENGTH),
            now,
            names,
            _PLACE_AND_TURN.pack(0x22, 27, 0x09, x, 0x11, y, 0x19, z, 0x2A, 18, 0x19, sine, 0x21, cosine),
        )
