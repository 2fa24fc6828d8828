"""The robot behind the serial line: motors, body, ball, localisation and camera, with numbers of its own.

`python -m robot_agent.hardware.simulated.board` reads its settings from standard input, prints the path of its serial
line, and runs in real time until its input ends. It shares nothing with the simulation of the host.
"""

import json
import math
import os
import random
import select
import struct
import sys
import time
import tty
from collections import deque
from dataclasses import asdict, dataclass, field
from typing import Any

from robot_agent.hardware.simulated import frames
from robot_agent.hardware.simulated.frames import FrameReader, Kind, Motion, Seen
from schemas.config.wheels import Wheels
from schemas.frames import rotate, to_body, wrap

_STEP = 0.001
"""s of one step of the body."""
_LOOP = 0.004
"""s of wall time between two looks at the line."""
_BALL_LOSS = 0.4
"""m/s² that a rolling ball loses."""
_BALL_RADIUS = 0.11
"""m."""


@dataclass(frozen=True)
class BoardNumbers:
    """The true numbers of the body, which no profile has; noise is Gaussian and given as standard deviations."""

    max_speed: float = 3.2
    """m/s of the body in any direction."""
    acceleration: float = 2.2
    """m/s²; change of the velocity in the body frame, also to rest."""
    turn_acceleration: float = 9.0
    """rad/s²."""
    latency: float = 0.03
    """s from a demand on the line until the motors follow it."""
    position_noise: float = 0.01
    """m, of x and y each."""
    heading_noise: float = 0.008
    """rad."""
    velocity_noise: float = 0.03
    """m/s, of vx and vy each; in rad/s, of the turn rate."""
    motion_rate: float = 100.0
    """Poses per second in Hz."""
    camera_rate: float = 25.0
    """Pictures per second in Hz."""
    picture_delay: float = 0.08
    """s from taking a picture until it is on the line; the board does not know it."""
    camera_noise: float = 0.02
    """m, of x and y each."""
    watchdog: float = 0.2
    """s without a demand after which the board brakes."""
    radius: float = 0.26
    """m; of the body, and of the posts."""
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """x, y, heading in the field frame, in m and rad."""
    ball: tuple[float, float] | None = None
    """Where the ball lies in the field frame, in m; None without one."""
    posts: tuple[tuple[float, float], ...] = ()
    """Bodies that stand still, in the field frame, in m."""
    seed: int = 1


@dataclass
class Board:
    """The body at one time, which bytes go to and come from."""

    wheels: Wheels
    numbers: BoardNumbers
    time: float = 0.0
    """s since the board was switched on."""
    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0
    twist: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """vx, vy, omega in the body frame."""
    ball: list[float] | None = None
    """x, y, vx, vy in the field frame."""
    holding: bool = False
    powered: bool = False
    reader: FrameReader = field(default_factory=FrameReader)
    _wanted: tuple[float, float, float] | None = (0.0, 0.0, 0.0)
    """The twist that the motors follow; None while they roll freely."""
    _dribbles: bool = False
    _heard: float = -math.inf
    """When the newest demand arrived."""
    _demanded: float = 0.0
    """When it was sent, on the driver's clock."""
    _due: deque[tuple[float, tuple[float, float, float] | None]] = field(default_factory=deque)
    """Demands on their way to the motors, and when they are there."""
    _pictures: deque[tuple[float, Seen]] = field(default_factory=deque)
    """Pictures that were taken, and when they are on the line."""
    _motions: int = 0
    _taken: int = 0

    def __post_init__(self) -> None:
        self.x, self.y, self.heading = self.numbers.start
        if self.numbers.ball is not None:
            self.ball = [*self.numbers.ball, 0.0, 0.0]
        self._random = random.Random(self.numbers.seed)

    def receive(self, data: bytes) -> None:
        """Bytes from the line; a frame whose content has another length than its kind is left out."""
        for kind, content in self.reader.feed(data):
            try:
                self._obey(kind, content)
            except (struct.error, IndexError, ValueError):
                self.reader.wrong += 1

    def advance(self, until: float) -> bytes:
        """Move on to a time in s; returns what is on the line then."""
        sent = b""
        while self.time + _STEP <= until + 1e-9:
            self.time = round(self.time + _STEP, 6)
            self._move()
            sent += self._measure()
        return sent

    def _obey(self, kind: int, content: bytes) -> None:
        if kind == Kind.POWER:
            self.powered = bool(content[0])
            self._due.clear()
            self._wanted = (0.0, 0.0, 0.0)
        elif kind == Kind.DEMAND and self.powered:
            self._demanded, rims, self._dribbles = frames.read_demand(content)
            self._due.append((self.time + self.numbers.latency, None if rims is None else self.wheels.twist(rims)))
            self._heard = self.time
        elif kind == Kind.KICK and self.powered and self.holding and self.ball is not None:
            kick = frames.read_kick(content)
            self.ball[2:] = rotate(kick.speed, 0.0, self.heading)
            self.ball[:2] = self._ahead(self.numbers.radius + 1.5 * _BALL_RADIUS)
            self.holding = False

    def _move(self) -> None:
        """One step."""
        n, (vx, vy, omega) = self.numbers, self.twist
        while self._due and self._due[0][0] <= self.time:
            self._wanted = self._due.popleft()[1]
        if self.powered and self.time - self._heard > n.watchdog:
            self._wanted = (0.0, 0.0, 0.0)
        if self._wanted is not None and self.powered:
            wx, wy, turn = self._wanted
            scale = n.max_speed / max(n.max_speed, math.hypot(wx, wy))
            dx, dy = wx * scale - vx, wy * scale - vy
            share = n.acceleration * _STEP / max(n.acceleration * _STEP, math.hypot(dx, dy))
            most = n.turn_acceleration * _STEP
            vx, vy, omega = vx + share * dx, vy + share * dy, omega + max(-most, min(most, turn - omega))
        else:  # it rolls freely, and loses a little
            vx, vy, omega = (number * (1.0 - 0.5 * _STEP) for number in (vx, vy, omega))
        self.twist = vx, vy, omega
        fx, fy = rotate(vx, vy, self.heading + omega * _STEP / 2)
        self.x, self.y = self.x + fx * _STEP, self.y + fy * _STEP
        self.heading = wrap(self.heading + omega * _STEP)
        if self.ball is not None:
            self._roll(self.ball, fx, fy)

    def _roll(self, ball: list[float], fx: float, fy: float) -> None:
        """One step of the ball, which the dribbler holds and the body pushes."""
        ahead, aside = to_body(ball[0] - self.x, ball[1] - self.y, self.heading)
        gap = self.numbers.radius + _BALL_RADIUS
        self.holding = self.powered and 0.0 < ahead < gap + 0.05 and abs(aside) < 0.1
        if self.holding and self._dribbles:
            ball[:] = *self._ahead(gap), fx, fy
            return
        away = math.hypot(ahead, aside)
        if away < gap:
            nx, ny = rotate(ahead / away, aside / away, self.heading)
            ball[:2] = self.x + nx * gap, self.y + ny * gap
            push = max(0.0, (fx - ball[2]) * nx + (fy - ball[3]) * ny)
            ball[2:] = ball[2] + push * nx, ball[3] + push * ny
        speed = math.hypot(ball[2], ball[3])
        kept = max(0.0, 1.0 - _BALL_LOSS * _STEP / max(speed, 1e-9))
        ball[:] = ball[0] + ball[2] * _STEP, ball[1] + ball[3] * _STEP, ball[2] * kept, ball[3] * kept

    def _ahead(self, distance: float) -> tuple[float, float]:
        dx, dy = rotate(distance, 0.0, self.heading)
        return self.x + dx, self.y + dy

    def _measure(self) -> bytes:
        """What the sensors send at this time."""
        n, sent = self.numbers, b""
        if self.time * n.camera_rate >= self._taken - 1e-6:
            self._taken += 1
            self._pictures.append((self.time + n.picture_delay, self._seen()))
        if self.time * n.motion_rate >= self._motions - 1e-6:
            self._motions += 1
            fx, fy = rotate(*self.twist[:2], self.heading)
            x, y = self._noisy(n.position_noise, self.x, self.y)
            heading = wrap(*self._noisy(n.heading_noise, self.heading))
            vx, vy, omega = self._noisy(n.velocity_noise, fx, fy, self.twist[2])
            clock = self.time, self._demanded, max(0.0, self._heard)
            sent += frames.motion(Motion(*clock, x, y, heading, vx, vy, omega, self.holding, True))
        while self._pictures and self._pictures[0][0] <= self.time:
            sent += frames.picture(self._pictures.popleft()[1]._replace(time=self.time))
        return sent

    def _seen(self) -> Seen:
        ball = None
        if self.ball is not None:
            x, y, vx, vy = self.ball
            ball = (*self._place(x, y), *to_body(vx, vy, self.heading))
        return Seen(0.0, ball, [(*self._place(x, y), self.numbers.radius) for x, y in self.numbers.posts])

    def _place(self, x: float, y: float) -> tuple[float, float]:
        place = self._noisy(self.numbers.camera_noise, *to_body(x - self.x, y - self.y, self.heading))
        return place[0], place[1]

    def _noisy(self, deviation: float, *numbers: float) -> list[float]:
        return [number + self._random.gauss(0.0, deviation) for number in numbers]


def settings_line(wheels: Wheels, numbers: BoardNumbers) -> bytes:
    """What the board reads from its input."""
    return json.dumps({"wheels": asdict(wheels), "numbers": asdict(numbers)}).encode() + b"\n"


def board_of(line: bytes | str) -> Board:
    """The board of a line of settings."""
    content: dict[str, Any] = json.loads(line)
    return Board(Wheels(**content["wheels"]), BoardNumbers(**content["numbers"]))


def main() -> None:
    """Run a board until its input ends."""
    board = board_of(sys.stdin.readline())
    line, other_end = os.openpty()
    tty.setraw(other_end)
    os.set_blocking(line, False)
    print(os.ttyname(other_end), flush=True)  # noqa: T201 - the path is what this program is asked for
    began = time.perf_counter()
    while True:
        ready, _, _ = select.select([line, sys.stdin], [], [], _LOOP)
        if sys.stdin in ready and not sys.stdin.readline():
            return
        sent = board.advance(time.perf_counter() - began)
        if line in ready:
            board.receive(os.read(line, 4096))
        try:
            os.write(line, sent)
        except BlockingIOError:
            continue  # nobody reads the line: what is measured meanwhile is lost


if __name__ == "__main__":
    main()
