"""A network link with delay, jitter, loss and reordering, in user space: not every kernel has the qdisc `netem`.

As a program it forwards Ethernet frames between two TAP devices: `python link_emulator.py TAP TAP`. Each line of its
stdin is a `LinkConditions` as JSON, which holds for the frames from then on; it ends when its stdin does.
"""

import fcntl
import heapq
import json
import os
import random
import select
import struct
import sys
import time
from dataclasses import asdict, dataclass

_TUNSETIFF = 0x400454CA
_IFF_TAP, _IFF_NO_PI = 0x0002, 0x1000
_FRAME = 65_536
_BURST = 64
"""Most frames that are read from one device at once."""


@dataclass(frozen=True)
class LinkConditions:
    """What a link does to the frames of each of its two directions."""

    delay_ms: float = 0.0
    """Delay of each direction, in ms; a round trip takes twice as long."""
    jitter_ms: float = 0.0
    """Most that a frame's delay differs from `delay_ms`, in ms, uniformly; frames keep their order."""
    loss: float = 0.0
    """Share of the frames that are lost, from 0 to 1, each by itself."""
    reordering: float = 0.0
    """Share of the frames that overtake others, because they are not delayed, from 0 to 1."""
    is_cut: bool = False
    """Whether all frames are lost."""
    seed: int = 1
    """Of all draws."""

    def line(self) -> bytes:
        """The same as a line of the program's input."""
        return json.dumps(asdict(self)).encode() + b"\n"


class Direction:
    """The frames on their way in one direction."""

    def __init__(self, number: int) -> None:
        self._number = number
        self._queue: list[tuple[float, int, bytes]] = []
        self._count = 0
        self._newest_due = 0.0
        self.set(LinkConditions())

    def set(self, conditions: LinkConditions) -> None:
        """Apply these conditions to later frames; the draws begin anew."""
        self._conditions = conditions
        self._random = random.Random(f"{conditions.seed} {self._number}")

    def take(self, frame: bytes, now: float) -> None:
        """Accept a frame at `now`, in s."""
        conditions, draw = self._conditions, self._random.random
        is_lost, is_early, jitter = draw() < conditions.loss, draw() < conditions.reordering, 2.0 * draw() - 1.0
        if is_lost or conditions.is_cut:
            return
        self._count += 1
        due = now
        if not is_early:
            delay_ms = max(0.0, conditions.delay_ms + jitter * conditions.jitter_ms)
            due = self._newest_due = max(self._newest_due, now + delay_ms / 1000.0)
        heapq.heappush(self._queue, (due, self._count, frame))

    def due(self, now: float) -> list[bytes]:
        """Remove and return the frames that arrive by `now`, in order."""
        frames = []
        while self._queue and self._queue[0][0] <= now:
            frames.append(heapq.heappop(self._queue)[2])
        return frames

    def next_due(self) -> float | None:
        """When the next frame arrives; None without any."""
        return self._queue[0][0] if self._queue else None


def _open_tap(name: str) -> int:
    device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, _TUNSETIFF, struct.pack("16sH22x", name.encode(), _IFF_TAP | _IFF_NO_PI))
    return device


def _read(device: int) -> list[bytes]:
    frames: list[bytes] = []
    try:
        while len(frames) < _BURST:
            frames.append(os.read(device, _FRAME))
    except OSError:  # no more frames, or the device is down
        pass
    return frames


def _forward(devices: list[int], orders: int) -> None:
    """Forward until `orders` ends."""
    ways = [Direction(0), Direction(1)]
    while True:
        due = min((at for way in ways if (at := way.next_due()) is not None), default=None)
        timeout = None if due is None else max(0.0, due - time.monotonic())
        readable, _, _ = select.select([*devices, orders], [], [], timeout)
        if orders in readable:
            lines = os.read(orders, _FRAME).splitlines()
            if not lines:
                return
            for way in ways:
                way.set(LinkConditions(**json.loads(lines[-1])))
        now = time.monotonic()
        for index, way in enumerate(ways):
            if devices[index] in readable:
                for frame in _read(devices[index]):
                    way.take(frame, now)
            for frame in way.due(now):
                try:
                    os.write(devices[1 - index], frame)
                except OSError:  # the device is down or its queue is full: the frame is lost
                    continue


if __name__ == "__main__":
    _forward([_open_tap(name) for name in sys.argv[1:3]], sys.stdin.fileno())
