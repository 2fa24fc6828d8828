"""The bytes on the serial line: framed messages with checksums, and their fields as integers.

A frame is `A5 5A`, kind, length of the content, content, and CRC-16 (CCITT, initial value FFFF) of all but the first
two bytes, low byte first. All integers are little endian. A frame with a wrong checksum is left out and counted.
"""

import binascii
import struct
from collections.abc import Iterator, Sequence
from enum import IntEnum
from typing import NamedTuple

from schemas.messages.command import Kick, KickMode

_HEAD = b"\xa5\x5a"
_MODES = tuple(KickMode)
_KICK, _FLAGS, _MOTION = struct.Struct("<BH"), struct.Struct("<B"), struct.Struct("<QQQiih3hB")
_BALL, _PICTURE, _BODY = struct.Struct("<ii2h"), struct.Struct("<QB"), struct.Struct("<iiH")
_MAX_BODIES = 20
"""Bodies in a picture: more do not fit into a frame."""


class Kind(IntEnum):
    """What a frame is; those from 0x10 on come from the board."""

    POWER = 1
    """1 powers the motors, 0 takes the power away."""
    DEMAND = 2
    """Time of the driver's last look at the line before it, in µs on its clock; flags (1: roll freely, 2: dribbler on),
    then per wheel its rim speed in mm/s, as in `Wheels.rim_speeds`."""
    KICK = 3
    """Number of the mode, then speed in cm/s."""
    MOTION = 16
    """Time of measuring in µs on the board's clock; the time in the newest demand, and when that came on the board's
    clock, both 0 before the first; x, y in 0.1 mm; heading in 0.1 mrad; vx, vy of the field frame in mm/s; turn rate in
    mrad/s; flags (1: the ball is at the kicker, 2: charged)."""
    PICTURE = 17
    """Time of sending in µs on the board's clock; 1 if it shows the ball; then the ball's x, y in 0.1 mm and vx, vy in
    mm/s; then per body x, y in 0.1 mm and radius in mm, all in the body frame."""


class Frame(NamedTuple):
    """A frame that has arrived."""

    kind: int
    content: bytes


def frame(kind: Kind, content: bytes) -> bytes:
    """The bytes of a frame; the content has at most 255."""
    body = bytes((kind, len(content))) + content
    return _HEAD + body + struct.pack("<H", binascii.crc_hqx(body, 0xFFFF))


class FrameReader:
    """Finds the frames in what arrives, in pieces of any length."""

    def __init__(self) -> None:
        self.wrong = 0
        """Frames whose checksum was wrong."""
        self._rest = b""

    def feed(self, data: bytes) -> Iterator[Frame]:
        """The frames that are whole with this data."""
        self._rest += data
        while True:
            start = self._rest.find(_HEAD)
            if start < 0:
                self._rest = self._rest[-1:] if self._rest.endswith(_HEAD[:1]) else b""
                return
            self._rest = self._rest[start:]
            if len(self._rest) < 4 or len(self._rest) < (size := 6 + self._rest[3]):
                return
            body, (sent,) = self._rest[2 : size - 2], struct.unpack_from("<H", self._rest, size - 2)
            if binascii.crc_hqx(body, 0xFFFF) == sent:
                self._rest = self._rest[size:]
                yield Frame(body[0], body[2:])
            else:
                self.wrong += 1
                self._rest = self._rest[2:]


def power(on: bool) -> bytes:
    """The frame of `Kind.POWER`."""
    return frame(Kind.POWER, _FLAGS.pack(on))


def demand(time: float, rim_speeds: Sequence[float] | None, dribble: bool) -> bytes:
    """The frame of `Kind.DEMAND` after a look at a time in s: rim speeds in m/s; None to roll freely."""
    rims = [_clipped(1e3 * speed, 15) for speed in rim_speeds or ()]
    flags = (rim_speeds is None) + 2 * dribble
    return frame(Kind.DEMAND, struct.pack(f"<QB{len(rims)}h", round(1e6 * time), flags, *rims))


def read_demand(content: bytes) -> tuple[float, list[float] | None, bool]:
    """The time of the driver in s; rim speeds in m/s, None to roll freely; whether the dribbler is on.

    Raises:
        struct.error: the content is too short.
    """
    sent, flags, *rims = struct.unpack(f"<QB{(len(content) - 9) // 2}h", content)
    return sent / 1e6, None if flags & 1 else [speed / 1e3 for speed in rims], bool(flags & 2)


def kick(asked: Kick) -> bytes:
    """The frame of `Kind.KICK`."""
    return frame(Kind.KICK, _KICK.pack(_MODES.index(asked.mode), _clipped(1e2 * asked.speed, 16)))


def read_kick(content: bytes) -> Kick:
    """The kick; `struct.error` if the content has another length."""
    mode, speed = _KICK.unpack(content)
    return Kick(mode=_MODES[mode], speed=speed / 1e2)


class Motion(NamedTuple):
    """What `Kind.MOTION` says: s, m, rad, m/s, rad/s in the field frame."""

    time: float
    demanded: float
    heard: float
    x: float
    y: float
    heading: float
    vx: float
    vy: float
    omega: float
    holding: bool
    charged: bool


def motion(one: Motion) -> bytes:
    """The frame of `Kind.MOTION`."""
    times = (round(1e6 * number) for number in one[:3])
    x, y, heading = (round(1e4 * number) for number in one[3:6])
    rates = (_clipped(1e3 * number, 15) for number in one[6:9])
    return frame(Kind.MOTION, _MOTION.pack(*times, x, y, heading, *rates, one.holding + 2 * one.charged))


def read_motion(content: bytes) -> Motion:
    """The motion; `struct.error` if the content has another length."""
    *numbers, vx, vy, omega, flags = _MOTION.unpack(content)
    time, demanded, heard = (number / 1e6 for number in numbers[:3])
    x, y, heading = (number / 1e4 for number in numbers[3:])
    rates = vx / 1e3, vy / 1e3, omega / 1e3
    return Motion(time, demanded, heard, x, y, heading, *rates, bool(flags & 1), bool(flags & 2))


class Seen(NamedTuple):
    """What `Kind.PICTURE` says, in the body frame."""

    time: float
    """s."""
    ball: tuple[float, float, float, float] | None
    """x, y in m, vx, vy in m/s; None where the picture does not show it."""
    bodies: list[tuple[float, float, float]]
    """x, y, radius in m."""


def picture(seen: Seen) -> bytes:
    """The frame of `Kind.PICTURE`, with the first bodies if there are too many."""
    content = _PICTURE.pack(round(1e6 * seen.time), seen.ball is not None)
    if seen.ball is not None:
        x, y, vx, vy = seen.ball
        content += _BALL.pack(round(1e4 * x), round(1e4 * y), _clipped(1e3 * vx, 15), _clipped(1e3 * vy, 15))
    for x, y, radius in seen.bodies[:_MAX_BODIES]:
        content += _BODY.pack(round(1e4 * x), round(1e4 * y), round(1e3 * radius))
    return frame(Kind.PICTURE, content)


def read_picture(content: bytes) -> Seen:
    """The picture; `struct.error` if the content has another length."""
    time, has_ball = _PICTURE.unpack_from(content)
    rest, ball = content[_PICTURE.size :], None
    if has_ball:
        x, y, vx, vy = _BALL.unpack_from(rest)
        ball, rest = (x / 1e4, y / 1e4, vx / 1e3, vy / 1e3), rest[_BALL.size :]
    bodies = [(x / 1e4, y / 1e4, radius / 1e3) for x, y, radius in _BODY.iter_unpack(rest)]
    return Seen(time / 1e6, ball, bodies)


def _clipped(number: float, bits: int) -> int:
    """A whole number that fits into so many bits besides the sign."""
    most: int = (1 << bits) - 1
    return max(-most, min(most, round(number)))
